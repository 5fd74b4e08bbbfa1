/// ASAM OpenMATERIAL 3D: a material (.xomp) with its optical constants and BRDF as tables beside it
/// (_optical.xompt, _brdf.xompt). Lengths are metres, angles radians.
///
/// Its surfaceHeightRms and surfaceCorrelationLength, where the autocorrelation has dropped to 1/e, are
/// sigma_0 and tau of a Gaussian: with optical constants such a file is a material of model he. Azimuths of
/// views are those from the incident direction; the schema does not say whether that is the light's side,
/// which is taken here, so that the mirror direction is at pi.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::tables {

[[nodiscard]] bool is_open_material(std::string_view text);

/// What a material file holds.
struct OpenMaterial {
    /// A material file of model he; "" without both roughness and optical constants.
    std::string material;
    std::string brdf_table;  ///< path of its first BRDF; "" where it names none
    std::vector<std::string> notes;
};

/// hts::Error "path: key …" for what the schema does not allow, and for tables that cannot be read.
[[nodiscard]] OpenMaterial open_material(const std::string& text, const std::filesystem::path& path);

/// Whether a file is a table of a BRDF and not a material.
[[nodiscard]] bool is_open_material_brdf(std::string_view text);

/// The points of such a table.
///   wavelengths      of one whose rows have null there
///   mirror_azimuth   where the file has the mirror direction [deg], 0 or 180
/// hts::Error "path: key …".
[[nodiscard]] ScatterPoints points_of_open_material(
    const std::string& text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelengths, double mirror_azimuth = 180);

/// A material file, the table of its BRDF and, of surfaces that have them, its roughness and the table of its
/// optical constants.
///   path   must end in .xomp, else hts::Error, as for surfaces with a grain
[[nodiscard]] Exported exported_open_material(const spectral::Reflectance& brdf,
                                              const std::filesystem::path& path, double mirror_azimuth = 180);

}  // namespace hts::tables
