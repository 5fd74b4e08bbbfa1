/// What `hts info` says of a roughness whose correlation is not Gaussian or which was stated for a band.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "spectral/energy/rough_surface.hpp"

namespace hts::cli {

/// What light of one wavelength sees of a roughness, along the normal.
struct SeenRoughness {
    double wavelength;  ///< [um]
    /// sigma_rel [um], of the frequencies up to 1/lambda, which scatter into real directions
    double rms_roughness;
    double rms_slope;  ///< along the steeper axis, of the same frequencies
    double scattered;  ///< TIS, 1 - exp(-(4 pi sigma_rel/lambda)^2), of what a flat surface reflects
};
[[nodiscard]] SeenRoughness seen_roughness(const Surface& surface, double wavelength_um);

/// Of the first axis.
[[nodiscard]] double azimuth_in_degrees(const Surface& surface);
/// "sigma0 0.28 um, tau 1.77 um; rms slope 0.224 (12.6 deg), …".
[[nodiscard]] std::string surface_text(const Surface& surface);
/// Lines of `hts info`, none of a Gaussian correlation that is stated for all frequencies.
///   wavelengths   [um], increasing, of which the ends are shown
[[nodiscard]] std::string roughness_text(const spectral::RoughSurface& surface,
                                         const std::vector<double>& wavelengths);
/// Adds the keys "correlation", "rms_band_um", "rms_roughness_of_band_um" and "seen", a list over
/// wavelengths, where there is text.
void add_roughness(nlohmann::ordered_json& to, const spectral::RoughSurface& surface,
                   const std::vector<double>& wavelengths);

}  // namespace hts::cli
