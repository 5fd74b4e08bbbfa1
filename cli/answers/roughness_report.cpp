#include "cli/answers/roughness_report.hpp"

#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/energy/validity.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

using Json = nlohmann::ordered_json;
using spectral::brief;
using spectral::FrequencyBand;
using spectral::RoughSurface;

bool says_more(const RoughSurface& surface) {
    return surface.correlation() || surface.band();
}

double rms_of_band(const Surface& surface, const FrequencyBand& band) {
    return surface.rms_roughness() * std::sqrt(surface.variance_share(band.from, band.to));
}

std::string period_text(double frequency) {
    return frequency > 0 ? brief(1 / frequency) + " um" : "infinity";
}

std::string seen_text(const SeenRoughness& seen) {
    return "\n               at " + shortest(seen.wavelength) + " um: sigma_rel " +
           brief(seen.rms_roughness) + " um, rms slope " + brief(seen.rms_slope, 3) + " (" +
           brief(std::atan(seen.rms_slope) * 180 / std::numbers::pi, 3) + " deg), TIS " +
           brief(seen.scattered);
}

std::string slope_text(double slope) {
    return brief(slope, 3) + " (" + brief(std::atan(slope) * 180 / std::numbers::pi, 3) + " deg)";
}

std::string correlated_surface_text(const Surface& surface) {
    const auto& [along, across] = surface.correlation_lengths();
    const std::string lengths = surface.isotropic() ? brief(along) + " um"
                                                    : brief(along) + " um along the azimuth " +
                                                          brief(azimuth_in_degrees(surface)) + " deg and " +
                                                          brief(across) + " um across";
    return "sigma0 " + brief(surface.rms_roughness()) + " um, correlation " + surface.correlation()->name() +
           ", its length " + lengths;
}

}  // namespace

std::string surface_text(const Surface& surface) {
    if (surface.correlation()) return correlated_surface_text(surface);
    const std::string curvature =
        ", radius of curvature " + brief(spectral::curvature_radius(surface), 3) + " um";
    const std::string height = "sigma0 " + brief(surface.rms_roughness()) + " um, tau ";
    if (surface.isotropic()) {
        return height + brief(surface.correlation_length()) + " um; rms slope " +
               slope_text(spectral::rms_slope(surface)) + curvature;
    }
    const auto& [along, across] = surface.correlation_lengths();
    const auto slopes = spectral::rms_slopes(surface);
    return height + brief(along) + " um along the azimuth " + brief(azimuth_in_degrees(surface)) +
           " deg and " + brief(across) + " um across;\n               rms slopes " +
           slope_text(slopes.along) + " along and " + slope_text(slopes.across) + " across" + curvature;
}

double azimuth_in_degrees(const Surface& surface) {
    return surface.azimuth() * 180 / std::numbers::pi;
}

SeenRoughness seen_roughness(const Surface& surface, double wavelength_um) {
    const double rms = surface.rms_roughness() * std::sqrt(surface.variance_share(0, 1 / wavelength_um));
    const double phase = 4 * std::numbers::pi * rms / wavelength_um;
    const Surface seen = surface.seen_by(Wavelength::from_micrometres(wavelength_um));
    return {wavelength_um, rms, spectral::rms_slope(seen), -std::expm1(-phase * phase)};
}

std::string roughness_text(const RoughSurface& surface, const std::vector<double>& wavelengths) {
    if (!says_more(surface)) return "";
    std::string text = "  roughness    sigma0 " + brief(surface.rms_roughness()) + " um over all frequencies";
    if (const auto& band = surface.band()) {
        text += ", " + brief(rms_of_band(surface, *band)) + " um over periods of " + period_text(band->to) +
                " to " + period_text(band->from);
    }
    text += ";\n               frequencies up to 1/lambda scatter and shadow:";
    text += seen_text(seen_roughness(surface, wavelengths.front()));
    if (wavelengths.size() > 1) text += seen_text(seen_roughness(surface, wavelengths.back()));
    return text + "\n";
}

void add_roughness(Json& to, const RoughSurface& surface, const std::vector<double>& wavelengths) {
    if (!says_more(surface)) return;
    if (const auto& shape = surface.correlation()) to["correlation"] = shape->name();
    if (const auto& band = surface.band()) {
        to["rms_band_um"] = {1 / band->to, band->from > 0 ? Json(1 / band->from) : Json("infinity")};
        to["rms_roughness_of_band_um"] = rms_of_band(surface, *band);
    }
    Json all = Json::array();
    for (const double wavelength : wavelengths) {
        const SeenRoughness seen = seen_roughness(surface, wavelength);
        all.push_back({{"wavelength_um", seen.wavelength},
                       {"rms_roughness_um", seen.rms_roughness},
                       {"rms_slope", seen.rms_slope},
                       {"tis", seen.scattered}});
    }
    to["seen"] = all;
}

}  // namespace hts::cli
