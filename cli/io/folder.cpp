#include "cli/io/folder.hpp"

#include <system_error>

#include "hts/error.hpp"

namespace hts::cli {

void make_folder(const std::filesystem::path& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (!problem && std::filesystem::is_directory(folder, problem)) return;
    throw Error{folder.string() + ": cannot be made: must be a folder that can be written"};
}

}  // namespace hts::cli
