/// Files that name files: paths as they must stand in a file so that they lead back from its folder,
/// also through symbolic links.
#pragma once

#include <string>

namespace hts::cli {

/// A file as the file `output` must name it: relative where there is a way, else absolute. hts::Error if it
/// is none that stays, as a pipe is not.
[[nodiscard]] std::string reference_from(const std::string& output, const std::string& file);

/// A material file's text, read as it will be from `output`: hts::Error where that fails.
[[nodiscard]] std::string verified(const std::string& output, std::string text);

/// The same of a text whose keys "file" begin in the working folder, which become references from `output`.
[[nodiscard]] std::string material_for(const std::string& output, const std::string& text);

}  // namespace hts::cli
