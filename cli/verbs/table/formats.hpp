/// The files of other programs that `hts table export` writes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::cli {

using spectral::Reflectance;

enum class SpecularSpread {
    facets,   ///< as a lobe of facets, whose edge is at the same half vectors for every light
    box,      ///< about the mirror direction
    patches,  ///< by the writer itself, over its patches
};

/// How a user wants a file.
struct ExportDetails {
    /// Over which the specular delta is spread in the reflectance or by the writer [sr]; 0 for none.
    double specular_solid_angle = 0;
    double slope = 0;  ///< of the lobe without it (tables/formats/lobe.hpp)
};

/// A format: what is written, and how programs that know it read it.
struct TableFormat {
    std::string name;         ///< as --format takes it
    std::string what;         ///< a line of help
    std::string wavelengths;  ///< [um] where the user gives none, as WavelengthGrid::parse takes them
    /// What is to stand in the file, and in those beside it, for tables::write_with_sidecar.
    std::function<tables::Exported(const Reflectance& brdf, const std::string& path,
                                   const ExportDetails& details)>
        exported;
    /// What a reader makes of those files, with the interpolation of the programs that read them.
    std::function<Reflectance(const tables::Exported& files)> read;
    /// What of a reflectance the file can hold at all, which is written and compared: none for all of it, or,
    /// say, red, green and blue.
    std::function<Reflectance(const Reflectance& brdf)> as_held{};
    /// How the specular delta is spread, as the format's grid can hold it.
    SpecularSpread spread = SpecularSpread::facets;
};

/// A line per format.
[[nodiscard]] const std::vector<TableFormat>& table_formats();

}  // namespace hts::cli
