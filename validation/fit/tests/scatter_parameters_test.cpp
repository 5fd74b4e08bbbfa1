#include "validation/fit/scatter_parameters.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <numbers>

#include "spectral/models/material.hpp"

using namespace hts;
using namespace hts::validation;

namespace {

/// A BRDF that is one of the forms itself.
class Formed final : public spectral::Evaluator {
  public:
    using Function = double (*)(double x, double cos_theta_r);
    explicit Formed(Function function)
        : spectral::Evaluator{"formed", spectral::WavelengthGrid::from_micrometres({0.6328})},
          function_{function} {}
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const Vector3 mirror = pair.in.mirror().vector(), out = pair.out.vector();
        values[0] = function_(std::hypot(out.x - mirror.x, out.y - mirror.y), out.z);
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        values[0] = 0.5;
    }

  private:
    Function function_;
};

std::vector<ScatterFit> fits_of(Formed::Function function, double theta_i, double reflectance) {
    const spectral::Reflectance brdf{std::make_shared<const Formed>(function)};
    return scatter_fits(brdf, 0, Direction::from_degrees(theta_i, 20), reflectance);
}

}  // namespace

TEST_CASE("ABg, Harvey-Shack and K-correlation give back their own parameters") {
    for (const double theta_i : {0., 30., 70.}) {
        const auto abg =
            fits_of([](double x, double) { return 2e-3 / (1e-4 + std::pow(x, 1.7)); }, theta_i, 1)[0];
        CHECK(abg.value("A") == Approx(2e-3).epsilon(1e-5));
        CHECK(abg.value("B") == Approx(1e-4).epsilon(1e-5));
        CHECK(abg.value("g") == Approx(1.7).epsilon(1e-5));
        CHECK(abg.worst_log < 1e-6);
        const auto harvey =
            fits_of([](double x, double) { return 5 * std::pow(1 + x * x / 1e-4, -0.8); }, theta_i, 1)[1];
        CHECK(harvey.value("b0") == Approx(5).epsilon(1e-5));
        CHECK(harvey.value("l") == Approx(0.01).epsilon(1e-5));
        CHECK(harvey.value("s") == Approx(-1.6).epsilon(1e-5));
        CHECK(harvey.worst_log < 1e-6);
    }
    // sigma 3 nm over 0 ... 1/0.6328 um, B 5.02655 um, s 3, a mirror of reflectance 0.9 at the normal
    constexpr double lambda = 0.6328, b = 5.02655, pi = std::numbers::pi;
    static constexpr double a = 9e-6 * b * b / (2 * pi) / (1 - 0.12490561);  // 1/(1 + (B/lambda)^2)^(1/2)
    CHECK(1 / std::sqrt(1 + b * b / (lambda * lambda)) == Approx(0.12490561).epsilon(1e-6));
    const auto k = fits_of(
        [](double x, double c) {
            return 16 * pi * pi * c * 0.9 / std::pow(lambda, 4) * a *
                   std::pow(1 + std::pow(b * x / lambda, 2), -1.5);
        },
        0, 0.9)[2];
    CHECK(k.value("rms_roughness") == Approx(0.003).epsilon(1e-5));
    CHECK(k.value("B") == Approx(b).epsilon(1e-5));
    CHECK(k.value("s") == Approx(3).epsilon(1e-5));
    CHECK(k.worst_log < 1e-6);
}

TEST_CASE("a polished optic gives back the spectrum of its material file") {
    const auto optic = spectral::read_material(HTS_SOURCE_DIR "/cli/data/polished-optic.json")
                           .at(Wavelength::from_micrometres(0.6328));
    const auto k = scatter_fits(optic, 0, Direction::from_degrees(0, 0))[2];
    std::cout << "polished optic: rms " << k.value("rms_roughness") << " um, B " << k.value("B") << " um, s "
              << k.value("s") << ", worst ln " << k.worst_log << '\n';
    // the law of smooth surfaces has no index: what Bragg's factor of aluminium does stays in the numbers
    CHECK(k.value("rms_roughness") == Approx(0.003).epsilon(0.06));
    CHECK(k.value("B") == Approx(5.02655).epsilon(0.2));
    CHECK(k.value("s") == Approx(3).epsilon(0.2));
}

TEST_CASE("what none of the forms is leaves a residual, and what is dark is refused") {
    const auto fits = fits_of([](double x, double) { return 1 + 0.9 * std::sin(20 * x); }, 30, 1);
    for (const ScatterFit& fit : fits) CHECK(fit.rms_log > 0.1);
    CHECK_THROWS_WITH(fits_of([](double, double) { return 0.0; }, 30, 1),
                      Catch::Contains("formed: reflects into 0 of 120 views"));
}
