#include "tables/formats/whole_file.hpp"

#include <fstream>
#include <system_error>

#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"

namespace hts::tables {
namespace {

namespace fs = std::filesystem;

std::uint64_t size_of(const fs::path& path, const fs::path& place) {
    std::error_code failed;
    if (!fs::is_regular_file(place, failed)) throw Error{path.string() + ": must be a file that exists"};
    const std::uint64_t size = fs::file_size(place, failed);
    if (failed) throw Error{path.string() + ": cannot be read (" + failed.message() + ")"};
    return size;
}

}  // namespace

std::string read_whole_file(const fs::path& path, std::uint64_t most) {
    const fs::path place = spectral::path_to_read(path);
    const std::uint64_t size = size_of(path, place);
    if (size > most)
        throw out_of_range(path.string() + ": size of the file", static_cast<double>(size), "bytes",
                           "at most " + std::to_string(most) + " bytes");
    std::string bytes(size, '\0');
    std::ifstream in{place, std::ios::binary};
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!in) throw Error{path.string() + ": cannot be read"};
    return bytes;
}

}  // namespace hts::tables
