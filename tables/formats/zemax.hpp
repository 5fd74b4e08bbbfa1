/// Tabular `.bsdf` text of Zemax OpticStudio, the BSDF data interchange format of Radiant Imaging (Rykowski,
/// "Zemax Tabular BSDF data file format"), also read by libbsdf.
///
/// A file holds BRDFs [1/sr] without the cosine, of one wavelength (or of three tristimulus values), on a
/// grid of angles of incidence, and of azimuth and polar angle about the mirror direction. Readers
/// interpolate between all of these, also those below the horizon: files written here hold the horizon's
/// values there (BelowHorizon::continued). Files of others that hold 0 there are read without them. The
/// wavelength is no part of the format: files written here say it in a comment, "# wavelength_um 0.633".
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/text/output.hpp"
#include "tables/formats/points/angular_grid.hpp"

namespace hts::tables {

/// Angles that suit lobes of 5 degrees and wider: incidence every 2.5 degrees to 40, then every degree to 89;
/// azimuth every 10; polar angle from 0.1 degrees on in growing steps, at most 5, to 170.
///   box   solid angle of a box about the mirror direction (with_specular_box) that the grid has to hold
///         [sr], 0 for none: its edge gets two polar angles, so that readers who
///         interpolate lose and gain nothing
[[nodiscard]] AngularGrid zemax_grid(double box = 0);

/// A file's text for each wavelength, six digits.
///   brdf   isotropic, else hts::Error      grid   axis mirror, phi_i one value
/// "TIS" is the reflectance of each angle of incidence, integrated on a grid four times finer along the polar
/// angle, twice along the azimuth.
[[nodiscard]] std::vector<std::string> zemax_texts(const spectral::Reflectance& brdf,
                                                   AngularGrid grid = zemax_grid());

/// One text of the channels Z, Y and X (tristimulus_brdf).
[[nodiscard]] std::string zemax_colour_text(const spectral::Reflectance& xyz,
                                            AngularGrid grid = zemax_grid());

/// The BRDF of a file; one with tristimulus values has the channels Z, Y, X (see rgb_wavelengths).
///   text          the whole file      name   its path, for messages and as the BRDF's name
///   wavelengths   what the channels are called: one, for tristimulus values three; if none is given the
///                 comment, 0.46, 0.55 and 0.62 um for tristimulus values, else hts::Error
/// hts::Error "path:line: …" for anything else than reflection of an isotropic surface.
[[nodiscard]] spectral::Reflectance zemax_brdf(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

/// A file and what a user should know of it.
struct ZemaxFile {
    spectral::Reflectance brdf;
    std::vector<std::string> channels{};  ///< what its wavelengths stand for; none if they are wavelengths
    std::vector<std::string> notes{};
};
/// Of a file, or of an index of several.
///   text   the whole of what stood at `path`      wavelengths   as above; none of an index
[[nodiscard]] ZemaxFile zemax_file(std::string_view text, const std::filesystem::path& path,
                                   const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

/// Writes files: at one wavelength `path` itself unless it ends in .json; at several `path` must end in .json
/// and becomes an index, {"zemax_files": [{"wavelength_um": 0.633, "file": "NAME_633nm.bsdf"}, …]}, of files
/// beside it. hts::Error if one cannot be written.
void write_zemax(const spectral::Reflectance& brdf, const std::filesystem::path& path);
/// What that writes, the index last.
[[nodiscard]] std::vector<spectral::TextFile> zemax_files(const spectral::Reflectance& brdf,
                                                          const std::filesystem::path& path,
                                                          AngularGrid grid = zemax_grid());

/// Reads either kind; errors as of zemax_brdf.
[[nodiscard]] spectral::Reflectance read_zemax(
    const std::filesystem::path& path,
    const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt);

}  // namespace hts::tables
