/// Measurements that tests of fits make up: models seen with noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "hts/tests/support/comparison.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/model_evaluator.hpp"
#include "validation/fit/fit.hpp"

namespace hts::validation::testing {

inline const auto one_micron = spectral::WavelengthGrid::from_micrometres({1.0});

/// Pairs in the plane of incidence, as goniometers measure them.
inline std::vector<DirectionPair> in_plane() {
    std::vector<DirectionPair> pairs;
    for (const double theta_i : {10.0, 30.0, 50.0, 70.0}) {
        for (double theta_r = -75; theta_r < 80; theta_r += 5) {
            pairs.push_back({Direction::from_degrees(theta_i, 0),
                             Direction::from_degrees(std::abs(theta_r), theta_r < 0 ? 0 : 180)});
        }
    }
    return pairs;
}

/// Pairs all over the hemisphere, half of them within 15 degrees of the mirror direction, where lobes are.
inline std::vector<DirectionPair> all_around(int count) {
    hts::testing::Random random{5};
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < count; ++i) {
        const double theta = random.uniform(0, 85), phi = random.uniform(0, 360);
        const bool near = i % 2 == 0;
        const double out =
            near ? std::clamp(theta + random.uniform(-15, 15), 0.0, 85.0) : random.uniform(0, 85);
        const double turn = near ? phi + 180 + random.uniform(-15, 15) : random.uniform(0, 360);
        pairs.push_back({Direction::from_degrees(theta, phi), Direction::from_degrees(out, turn)});
    }
    return pairs;
}

/// A standard normal number.
inline double gaussian(hts::testing::Random& random) {
    return std::sqrt(-2 * std::log(random.uniform(1e-12, 1))) *
           std::cos(random.uniform(0, 6.283185307179586));
}

/// What an instrument with noise in proportion to the value would show.
inline FitData seen(const spectral::Material& material, const std::vector<DirectionPair>& pairs, double noise,
                    const spectral::WavelengthGrid& grid = one_micron) {
    hts::testing::Random random{11};
    const auto reflectance = material.at(grid, {.tolerance = Tolerance{hts::accuracy::finest_tolerance}});
    std::vector<FitSample> samples;
    std::vector<double> spectrum(grid.size());
    for (const DirectionPair& pair : pairs) {
        reflectance.brdf(pair, spectrum);
        for (std::size_t w = 0; w < grid.size(); ++w) {
            const double value = spectrum[w] * (1 + noise * gaussian(random));
            samples.push_back({pair, w, value, noise * spectrum[w]});
        }
    }
    return fit_data("synthetic", grid, samples);
}

inline spectral::Material he(double rms, double length, double albedo) {
    return spectral::he_torrance_material("synthetic", {rms, length},
                                          spectral::built_in_optical_constants("Al"),
                                          spectral::DiffuseAlbedo{albedo});
}

/// A model that is the same at every wavelength.
template <ReflectanceModel Model>
spectral::Material constantly(const Model& model) {
    return spectral::material_of([=](const Wavelength&, spectral::OutsideRange) { return model; });
}

inline spectral::Material material_of(const FitModel& model, const std::vector<double>& values) {
    return spectral::material_from_text(model.material_text(values, model.name()), "");
}

inline std::string in_words(const Fit& fit) {
    std::ostringstream text;
    for (const auto& p : fit.parameters) {
        text << p.name << " = " << p.value << " +- " << p.standard_error << ' ' << p.unit << " ("
             << name(p.outcome) << ")\n";
    }
    text << "rms log " << fit.statistics.rms_log << ", starts " << fit.starts_at_best << " of "
         << fit.starts.size() << '\n';
    for (const auto& statement : fit.statements) text << statement << '\n';
    return text.str();
}

}  // namespace hts::validation::testing
