# Writes a C++ source that holds text files as raw string literals:
#   cmake -DOUTPUT=built_in_data.cpp "-DFILES=a.yml;b.yml" -P embed_data.cmake
set(source "// Written by embed_data.cmake from spectral/data/.\n#include \"spectral/built_in_data.hpp\"\n\n")
string(APPEND source "namespace hts::spectral {\nnamespace {\n\nconstexpr BuiltInFile files[] = {\n")
foreach(file IN LISTS FILES)
    get_filename_component(name "${file}" NAME_WLE)
    file(READ "${file}" text)
    string(APPEND source "{\"${name}\", R\"data(${text})data\"},\n")
endforeach()
string(APPEND source "};\n\n}  // namespace\n\n")
string(APPEND source "std::span<const BuiltInFile> built_in_files() noexcept {\n    return files;\n}\n\n")
string(APPEND source "}  // namespace hts::spectral\n")
file(WRITE "${OUTPUT}" "${source}")
