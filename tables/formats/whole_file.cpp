#include "tables/formats/whole_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"

namespace hts::tables {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_size(const fs::path& path, std::uint64_t size, std::uint64_t most) {
    throw out_of_range(path.string() + ": size of the file", static_cast<double>(size), "bytes",
                       "at most " + std::to_string(most) + " bytes");
}

std::string read_pipe(std::ifstream& in, const fs::path& path, std::uint64_t most) {
    std::string bytes;
    std::array<char, 65536> block{};
    while (in.read(block.data(), block.size()), in.gcount() > 0) {
        bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
        if (bytes.size() > most) refuse_size(path, bytes.size(), most);
    }
    return bytes;
}

}  // namespace

std::string read_whole_file(const fs::path& path, std::uint64_t most) {
    constexpr std::uint64_t most_of_pipe = std::uint64_t{1} << 30;
    spectral::require_file(path);
    const fs::path place = spectral::path_to_read(path);
    errno = 0;
    std::ifstream in{place, std::ios::binary};
    if (!in) throw Error{path.string() + ": cannot be read: " + std::strerror(errno)};
    std::error_code failed;
    if (!fs::is_regular_file(place, failed)) return read_pipe(in, path, std::min(most, most_of_pipe));
    const std::uint64_t size = fs::file_size(place, failed);
    if (failed) throw Error{path.string() + ": cannot be read: " + failed.message()};
    if (size > most) refuse_size(path, size, most);
    std::string bytes(size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!in) throw Error{path.string() + ": cannot be read"};
    return bytes;
}

}  // namespace hts::tables
