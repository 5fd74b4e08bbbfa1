/// Figures on disk: picture, script and numbers.
#pragma once

#include <filesystem>

#include "validation/report/report.hpp"

namespace hts::cli {

/// Writes STEM.csv of each table, STEM.gnuplot and the picture STEM.svg into a folder that exists; with
/// `json` the numbers as JSON too. Returns the picture's path.
std::filesystem::path write_figure(const std::filesystem::path& folder, const validation::Figure& figure,
                                   bool json = false);

}  // namespace hts::cli
