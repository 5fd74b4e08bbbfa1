// Tables of scattering integrals in files. Not installed.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "hts/correlation/lobe_table.hpp"

namespace hts::correlation_detail {

/// The table of a shape, read from the folder or else made and left there.
///   folder   empty: made
[[nodiscard]] std::shared_ptr<const LobeTable> kept_table(const std::filesystem::path& folder,
                                                          const ShapePointer& shape);

/// The file of a shape in a folder.
[[nodiscard]] std::filesystem::path table_path(const std::filesystem::path& folder, const HeightShape& shape);

}  // namespace hts::correlation_detail
