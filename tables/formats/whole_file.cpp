#include "tables/formats/whole_file.hpp"

#include <fstream>
#include <system_error>

#include "hts/error.hpp"

namespace hts::tables {
namespace {

namespace fs = std::filesystem;

std::uint64_t size_of(const fs::path& path) {
    std::error_code failed;
    if (!fs::is_regular_file(path, failed)) throw Error{path.string() + ": must be a file that exists"};
    const std::uint64_t size = fs::file_size(path, failed);
    if (failed) throw Error{path.string() + ": cannot be read (" + failed.message() + ")"};
    return size;
}

}  // namespace

std::string read_whole_file(const fs::path& path, std::uint64_t most) {
    const std::uint64_t size = size_of(path);
    if (size > most)
        throw out_of_range(path.string() + ": size of the file", static_cast<double>(size), "bytes",
                           "at most " + std::to_string(most) + " bytes");
    std::string bytes(size, '\0');
    std::ifstream in{path, std::ios::binary};
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!in) throw Error{path.string() + ": cannot be read"};
    return bytes;
}

}  // namespace hts::tables
