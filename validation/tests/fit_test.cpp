#include "validation/fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <limits>

#include "hts/error.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/tests/comparison.hpp"
#include "spectral/material_files.hpp"
#include "spectral/reflector.hpp"
#include "tables/spectral_brdf.hpp"

namespace {

using namespace hts;
using namespace hts::validation;
using Catch::Contains;
using hts::testing::Random;

const auto one_micron = spectral::WavelengthGrid::from_micrometres({1.0});

/// Pairs in the plane of incidence, as goniometers measure them.
std::vector<DirectionPair> in_plane() {
    std::vector<DirectionPair> pairs;
    for (const double theta_i : {10.0, 30.0, 50.0, 70.0}) {
        for (double theta_r = -75; theta_r < 80; theta_r += 5) {
            pairs.push_back({Direction::from_degrees(theta_i, 0),
                             Direction::from_degrees(std::abs(theta_r), theta_r < 0 ? 0 : 180)});
        }
    }
    return pairs;
}

/// Pairs all over the hemisphere.
std::vector<DirectionPair> all_around(int count) {
    Random random{5};
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < count; ++i) {
        pairs.push_back({Direction::from_degrees(random.uniform(0, 75), random.uniform(0, 360)),
                         Direction::from_degrees(random.uniform(0, 75), random.uniform(0, 360))});
    }
    return pairs;
}

/// A standard normal number.
double gaussian(Random& random) {
    return std::sqrt(-2 * std::log(random.uniform(1e-12, 1))) *
           std::cos(random.uniform(0, 6.283185307179586));
}

/// What an instrument with noise in proportion to the value would show.
FitData seen(const spectral::AnyReflector& reflector, const std::vector<DirectionPair>& pairs, double noise,
             const spectral::WavelengthGrid& grid = one_micron) {
    Random random{11};
    const auto brdf = tables::model_brdf(reflector, grid);
    std::vector<FitSample> samples;
    std::vector<double> spectrum(grid.size());
    for (const DirectionPair& pair : pairs) {
        brdf->brdf(pair, spectrum);
        for (std::size_t w = 0; w < grid.size(); ++w) {
            const double value = spectrum[w] * (1 + noise * gaussian(random));
            samples.push_back({pair, w, value, noise * spectrum[w]});
        }
    }
    return fit_data("synthetic", grid, samples);
}

spectral::AnyReflector he(double rms, double length, double albedo) {
    return spectral::AnyReflector{spectral::Reflector{
        "synthetic", {rms, length}, spectral::built_in_material("Al"), spectral::DiffuseAlbedo{albedo}}};
}

void print(const Fit& fit) {
    for (const auto& p : fit.parameters) {
        std::cout << "  " << fit.model << ' ' << p.name << " = " << p.value << " +- " << p.standard_error
                  << ' ' << p.unit << " (" << name(p.outcome) << ")\n";
    }
    std::cout << "  rms log " << fit.statistics.rms_log << ", starts " << fit.starts_at_best << " of "
              << fit.starts.size() << "\n";
    for (const auto& s : fit.statements) std::cout << "  " << s << '\n';
}

}  // namespace

TEST_CASE("He-Torrance parameters come back from noisy data") {
    for (const auto& [rms, length, albedo] :
         {std::array{0.05, 0.8, 0.02}, std::array{0.2, 1.5, 0.1}, std::array{0.45, 3.0, 0.3}}) {
        const auto data = seen(he(rms, length, albedo), in_plane(), 0.01);
        const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = Residual::relative}, data);
        print(fit);
        CHECK(fit.parameter("sigma0").value == Approx(rms).epsilon(0.01));
        CHECK(fit.parameter("tau").value == Approx(length).epsilon(0.01));
        CHECK(fit.parameter("a").value == Approx(albedo).epsilon(0.01));
    }
}
