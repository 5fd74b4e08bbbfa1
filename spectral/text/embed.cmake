# Writes a C++ source that holds text files as raw string literals:
#   cmake -DOUTPUT=built_in_files.cpp "-DFILES=a.yml;b.yml" -DHEADER=spectral/materials/built_in_data.hpp -DNAMESPACE=hts::spectral
#         -DFUNCTION=built_in_files -P embed.cmake
# HEADER declares FUNCTION, which returns a span of spectral::EmbeddedFile: a file's stem and its text.
set(source "// Written by embed.cmake.\n#include \"${HEADER}\"\n\n")
string(APPEND source "namespace ${NAMESPACE} {\nnamespace {\n\nusing namespace std::string_view_literals;  // of a known length: no compiler counts the characters\n\nconstexpr hts::spectral::EmbeddedFile files[] = {\n")
foreach(file IN LISTS FILES)
    get_filename_component(name "${file}" NAME_WLE)
    file(READ "${file}" text)
    string(APPEND source "{\"${name}\", R\"data(${text})data\"sv},\n")
endforeach()
string(APPEND source "};\n\n}  // namespace\n\n")
string(APPEND source "std::span<const hts::spectral::EmbeddedFile> ${FUNCTION}() noexcept {\n    return files;\n}\n\n")
string(APPEND source "}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUTPUT}" "${source}")
