/// A reflectance as a file of another program, read back as its readers do before anything is written.
///
///     const auto& rgl = written_format("rgl");
///     const Source source = source_to_write(material, wavelengths_to_write(material, rgl, false));
///     std::cout << write_brdf(source, rgl, {.path = "aluminium.bsdf"}).text();
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spectral/models/material.hpp"
#include "tables/formats/round_trip.hpp"
#include "tables/formats/writers/written_formats.hpp"

namespace hts::tables {

/// The format of a name; hts::Error that lists them all.
[[nodiscard]] const WrittenFormat& written_format(const std::string& name);

/// What a user asks of a file.
struct FileRequest {
    std::string path;
    bool colour = false;                      ///< three channels where the format could hold others
    std::optional<std::string> basis{};       ///< of Klems: full, half or quarter
    std::optional<int> depth{};               ///< of a tensor tree, 1 ... 8
    std::optional<double> mirror_azimuth{};   ///< of OpenMATERIAL [deg], 0 or 180
    std::optional<double> specular_spread{};  ///< of the specular term [sr]; without one it is left out
    std::size_t pairs = 100'000;              ///< to compare at
    std::uint64_t seed = 1;                   ///< of those pairs
};

/// The first of colour, basis, depth, mirror_azimuth and specular_spread that is asked for and means nothing
/// in the format.
[[nodiscard]] std::optional<std::string> not_taken(const FileRequest& request, const WrittenFormat& format);

/// A reflectance, and what its wavelengths stand for if they are none.
struct Source {
    spectral::Reflectance brdf;
    std::vector<std::string> channels{};
};

/// Those that a file of a material has unless somebody says otherwise; hts::Error where the material holds
/// channels of a colour and the file none.
[[nodiscard]] spectral::WavelengthGrid wavelengths_to_write(const spectral::Material& material,
                                                            const WrittenFormat& format, bool colour);
/// The material there; hts::Error where it is not known and the policy says error.
[[nodiscard]] Source source_to_write(const spectral::Material& material,
                                     const spectral::WavelengthGrid& wavelengths,
                                     spectral::OutsideRange policy = spectral::OutsideRange::error);

/// Writes the file and those that belong beside it, all or none, and says what readers make of them.
/// hts::Error where a reader of the spread specular term would gain or lose more than 2 % of the light, where
/// the format cannot hold the reflectance, and where a file cannot be written.
RoundTrip write_brdf(const Source& source, const WrittenFormat& format, const FileRequest& request);

}  // namespace hts::tables
