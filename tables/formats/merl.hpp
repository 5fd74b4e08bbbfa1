/// MERL's `.binary` [Matusik03]: isotropic RGB reflectance on 90 x 90 x 180 bins, which most renderers read.
///
/// Bins run over Rusinkiewicz' angles [Rusinkiewicz98]: theta_h of the half direction h, 90 bins that crowd
/// at 0 (sqrt(theta_h / (pi/2))), and theta_d (90) and phi_d (180, folded to [0, pi) by reciprocity) of the
/// light about h. The file holds BRDFs [1/sr] without the cosine, divided by 1/1500, 1.15/1500 and 1.66/1500
/// for red, green and blue; a negative number marks a bin below the horizon, which readers take for 0. Three
/// int32 90, 90, 180, then the planes of red, green, blue as float64, little-endian.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tables/formats/channels.hpp"

namespace hts::tables {

/// Size of every such file [bytes].
inline constexpr std::size_t merl_size = 34'992'012;

/// How values between the centres of bins are found.
enum class MerlLookup {
    /// Between the bins' centres, those below the horizon left out: linear in the coordinates of theta_h and
    /// phi_d, cubic in the logarithm along theta_d, where lobes rise steeply towards the horizon.
    interpolated,
    bins,  ///< the value of the bin, as most readers do
};

/// A file's bytes. Each bin holds the BRDF at its centre, or where that is below the horizon at the point of
/// the bin next to the centre that is not. Bins that lie below the horizon beside such ones hold the
/// horizon's value, for readers that interpolate.
///   brdf   isotropic, three wavelengths, of which the longest becomes red (linear_srgb_brdf makes them of a
///          spectrum); else hts::Error
[[nodiscard]] std::string merl_bytes(const spectral::Reflectance& brdf);

/// The BRDF of a file.
///   bytes         the whole file      name   its path, for messages and as the BRDF's name
///   wavelengths   what blue, green and red are called, three
/// hts::Error "path: …" where size or dimensions differ or a value is not finite, with its offset.
[[nodiscard]] spectral::Reflectance merl_brdf(std::string_view bytes, const std::string& name,
                                              const spectral::WavelengthGrid& wavelengths = rgb_wavelengths(),
                                              MerlLookup lookup = MerlLookup::interpolated);

}  // namespace hts::tables
