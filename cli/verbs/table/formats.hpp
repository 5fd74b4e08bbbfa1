/// The files of other programs that `hts table export` writes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::cli {

using spectral::Reflectance;

/// A format: what is written, and how the project's own reader reads it.
struct TableFormat {
    std::string name;         ///< as --format takes it
    std::string what;         ///< a line of help
    std::string wavelengths;  ///< [um] where the user gives none, as WavelengthGrid::parse takes them
    /// What is to stand in the file, and in those beside it, for tables::write_with_sidecar.
    std::function<tables::Exported(const Reflectance& brdf, const std::string& path)> exported;
    std::function<Reflectance(const std::string& path)> read;
    /// What of a reflectance the file can hold at all, which is written and compared: none for all of it, or,
    /// say, red, green and blue.
    std::function<Reflectance(const Reflectance& brdf)> as_held{};
};

/// A line per format.
[[nodiscard]] const std::vector<TableFormat>& table_formats();

}  // namespace hts::cli
