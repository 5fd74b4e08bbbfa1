# Writes a C++ source that holds text files as raw string literals:
#   cmake -DOUTPUT=built_in_data.cpp "-DFILES=a.yml;b.yml" -DHEADER=spectral/materials/built_in_data.hpp -DNAMESPACE=hts::spectral
#         -DTYPE=BuiltInFile -DFUNCTION=built_in_files -P embed.cmake
# HEADER declares TYPE, a name and a text, and FUNCTION, which returns a span of them.
set(source "// Written by embed.cmake.\n#include \"${HEADER}\"\n\n")
string(APPEND source "namespace ${NAMESPACE} {\nnamespace {\n\nconstexpr ${TYPE} files[] = {\n")
foreach(file IN LISTS FILES)
    get_filename_component(name "${file}" NAME_WLE)
    file(READ "${file}" text)
    string(APPEND source "{\"${name}\", R\"data(${text})data\"},\n")
endforeach()
string(APPEND source "};\n\n}  // namespace\n\n")
string(APPEND source "std::span<const ${TYPE}> ${FUNCTION}() noexcept {\n    return files;\n}\n\n")
string(APPEND source "}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUTPUT}" "${source}")
