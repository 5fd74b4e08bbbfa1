/// The readers behind curve_import.hpp, each to the same points in this library's conventions. Private to it.
#pragma once

#include <filesystem>
#include <vector>

#include "validation/curves/curve_import.hpp"

namespace hts::validation {

/// A point and where it stood.
struct ImportedPoint {
    Band band;
    CurvePoint point;
    std::size_t line;
};

[[nodiscard]] std::vector<ImportedPoint> read_csv_points(const std::filesystem::path& path,
                                                         const ImportRecipe& recipe);
[[nodiscard]] std::vector<ImportedPoint> read_fred_points(const std::filesystem::path& path,
                                                          const ImportRecipe& recipe);
[[nodiscard]] std::vector<ImportedPoint> read_astm_points(const std::filesystem::path& path,
                                                          const ImportRecipe& recipe);

}  // namespace hts::validation
