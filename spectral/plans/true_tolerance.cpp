#include "spectral/plans/true_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "hts/error.hpp"
#include "spectral/energy/expected_distance.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

/// Polar angles of light that are looked at, up to the scene's greatest [deg].
std::vector<double> angles_of(const Scene& scene) {
    constexpr double step = 15;
    const double most = scene.largest_theta_i * 180 / std::numbers::pi;
    std::vector<double> angles;
    for (double theta = 0; theta < most - 1e-9; theta += step) angles.push_back(theta);
    angles.push_back(most);
    return angles;
}

/// What counts in a scene.
double distance_in(const Scene& scene, const TrueDecibels& of) {
    return scene.polarised ? std::max(of.te, of.tm) : of.unpolarised;
}

/// Of a material, where it is greatest.
struct Expected {
    double model = 0, other = 0;  ///< distances of its own model, and of the other one there
    std::string where;
};

Expected expected_of(const Material& material, const Scene& scene) {
    const RoughSurface& surface = *material.properties().surface;
    const Reflectance prepared = material.at(scene.wavelengths, {.outside = scene.outside_range});
    Expected greatest;
    for (const SpectralSample& sample : prepared.samples()) {
        for (const double theta : angles_of(scene)) {
            const ExpectedDistance at = expected_distance(surface, sample, Direction::from_degrees(theta, 0));
            const std::string where =
                brief(theta, 3) + " deg, " + brief(sample.wavelength.micrometres(), 4) + " um";
            if (!at.studied) {
                throw Error{in_quotes(material.name()) + " at " + where +
                            ": outside what was solved exactly, so its distance from exact scattering is "
                            "unknown: must be " +
                            distance_study(surface, sample.index.substrate()).range + " (see hts info)"};
            }
            double model = distance_in(scene, at.distance.he),
                   other = distance_in(scene, at.distance.unified);
            if (surface.unified()) std::swap(model, other);
            if (model > greatest.model) greatest = {model, other, where};
        }
    }
    return greatest;
}

}  // namespace

double tolerance_beside_model(const Scene& scene, double true_db) {
    double greatest = 0;
    for (const Material& material : scene.materials) {
        if (!material.properties().surface) {
            throw Error{
                "materials must be of model he or he_unified, whose distance from exact scattering is "
                "known; " +
                in_quotes(material.name()) + " has model " + material.model_name()};
        }
        const Expected of = expected_of(material, scene);
        if (of.model >= true_db) {
            const bool unified = material.properties().surface->unified().has_value();
            throw Error{shortest(true_db) + ": must be above " + brief(of.model, 2) + " dB, which " +
                        material.model_name() + " of " + in_quotes(material.name()) +
                        " is expected to be from exact scattering at " + of.where + " (" +
                        (unified ? "he" : "he_unified") + ": " + brief(of.other, 2) + " dB)"};
        }
        greatest = std::max(greatest, of.model);
    }
    return std::min(std::expm1((true_db - greatest) * std::numbers::ln10 / 10),
                    hts::accuracy::coarsest_tolerance);
}

}  // namespace hts::spectral
