/// Verbs that write several files take a folder.
#pragma once

#include <filesystem>
#include <string>

namespace hts::cli {

/// Makes the folder and those above it as needed; hts::Error if that is impossible.
void make_folder(const std::filesystem::path& folder);

}  // namespace hts::cli
