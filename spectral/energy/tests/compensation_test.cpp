#include "spectral/energy/compensation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "comparison.hpp"
#include "hemisphere.hpp"
#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/compensated.hpp"
#include "spectral/models/he_torrance_material.hpp"

using namespace hts::spectral;
using namespace hts::spectral::testing;
using hts::Direction;
using hts::Surface;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

namespace bound = hts::spectral::accuracy;

const Wavelength one_um = Wavelength::from_micrometres(1);

constexpr hts::Tolerance exactly{hts::accuracy::finest_tolerance};

Reflectance copper(const Surface& surface, const WavelengthGrid& grid, double albedo = 0,
                   bool compensate = true) {
    return he_torrance_material("copper", surface, built_in_optical_constants("Cu"), DiffuseAlbedo{albedo})
        .at(grid, {.tolerance = exactly, .compensate_energy = compensate});
}

/// rho_dh of the compensated lossless surface, by the plain integral.
double lossless_total(const EnergyCompensation& s, const Surface& surface, double degrees) {
    const Direction in = Direction::from_degrees(degrees, 0);
    const Surface slopes = surface.seen_by(one_um);
    const hts::View seen = view(slopes, in);
    const double theta = degrees * std::numbers::pi / 180;
    const double core = 1 / (std::numbers::pi * surface.correlation_length());
    const double width = std::min(0.1, 0.3 * std::max(core, 2 * slopes.slope_width() * std::cos(theta)));
    const double lobe = hemisphere_integral(theta, width, [&](const Direction& out) {
        const hts::PairFactors pair{surface, seen, view(slopes, out)};
        const double phi = pair.phi(pair.phase_variance(one_um), pair.lobe_argument(one_um)).value;
        return pair.lobe(phi, one_um) * s.factor(out);
    });
    const double si = s.factor(in);
    return si * (si * coherent_fraction(surface, seen, one_um) + lobe);
}

}  // namespace

TEST_CASE("a lossless surface returns what falls in, by the plain integral") {
    WorstCase worst{"compensated rho_dh of a lossless surface, from 1", bound::compensated_energy};
    const bool all = hts::testing::exhaustive();
    using List = std::vector<double>;
    for (const double slope : all ? List{0.005, 0.02, 0.05, 0.1, 0.25, 0.5, 1} : List{0.02, 0.1, 1}) {
        for (const double roughness : all ? List{0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5} : List{0.05, 0.5, 5}) {
            const Surface surface{roughness, roughness / slope};
            const EnergyCompensation s{surface, one_um};
            for (const double degrees :
                 all ? List{0, 7, 13, 25, 37, 49, 61, 70, 76, 80, 83, 85} : List{0, 17, 52, 71, 85}) {
                worst.note(std::abs(lossless_total(s, surface, degrees) - 1), [&] {
                    return "sigma0/tau " + hts::shortest(slope) + ", sigma0/lambda " +
                           hts::shortest(roughness) + ", theta " + hts::shortest(degrees);
                });
            }
        }
    }
    worst.check();
}

TEST_CASE("a lossless surface of another correlation returns what falls in") {
    const std::vector<hts::Correlation::Part> two_scales{{0.9, hts::Correlation::gaussian(), 1},
                                                         {0.1, hts::Correlation::exponential(), 0.05}};
    WorstCase worst{"compensated rho_dh of a lossless surface of another correlation, from 1",
                    bound::compensated_energy};
    double least = 2, most = 0;
    for (const auto& shape : {hts::Correlation::exponential(), hts::Correlation::matern(1.5),
                              hts::Correlation::sum(two_scales)}) {
        for (const double roughness : {0.05, 0.3}) {
            const Surface surface = Surface{roughness, 8 * roughness}.correlated(shape);
            const EnergyCompensation s{surface, one_um};
            for (const double degrees : {0.0, 40.0, 75.0}) {
                const auto where = [&] {
                    return "sigma0/lambda " + hts::shortest(roughness) + ", theta " + hts::shortest(degrees);
                };
                worst.note(std::abs(lossless_total(s, surface, degrees) - 1), where);
                const Direction in = Direction::from_degrees(degrees, 0);
                const double plain =
                    directional_hemispherical_reflectance(surface, PerfectMirror{}, one_um, in).total();
                least = std::min(least, plain);
                most = std::max(most, plain);
            }
        }
    }
    worst.check();
    std::printf("not compensated: %.4f to %.4f\n", least, most);
    CHECK(least > 0.35);  // the furnace of the model itself, without returned light
    CHECK(most < 1.2);
}

TEST_CASE("the library's own integral of the compensated surface agrees") {
    const Surface surface{0.3, 1.2};
    const EnergyCompensation s{surface, one_um};
    for (const double degrees : {0.0, 33.0, 66.0, 85.0}) {
        const auto terms = directional_hemispherical_reflectance(s, surface, PerfectMirror{}, one_um,
                                                                 Direction::from_degrees(degrees, 20));
        CHECK(terms.total() == Approx(lossless_total(s, surface, degrees)).epsilon(1e-5));
    }
}

TEST_CASE("compensation keeps reciprocity") {
    WorstCase worst{"compensated f(in, out) against f(out, in)", 1e-12};
    Random random{3};
    const auto grid = WavelengthGrid::linear(0.4, 0.7, 3);
    for (const double slope : {0.05, 0.2, 0.7}) {
        const auto reflectance = copper({0.2, 0.2 / slope}, grid, 0.1);
        std::vector<double> there(grid.size()), back(grid.size());
        for (int i = 0; i < 300; ++i) {
            const auto in = Direction::from_degrees(random.uniform(0, 89), random.uniform(0, 360));
            const auto out = Direction::from_degrees(random.uniform(0, 89), random.uniform(0, 360));
            reflectance.brdf({in, out}, there);
            reflectance.brdf({out, in}, back);
            for (std::size_t j = 0; j < grid.size(); ++j) {
                worst.note(relative_error(there[j], back[j]),
                           [&] { return "sigma0/tau " + hts::shortest(slope); });
            }
        }
    }
    worst.check();
}

TEST_CASE("only the lobes are scaled, the uniform-diffuse term is not") {
    const auto grid = WavelengthGrid::linear(0.4, 0.7, 3);
    const Surface surface{0.2, 0.5};
    const Reflectance model = copper(surface, grid, 0, false);
    const Reflectance plain = copper(surface, grid), painted = copper(surface, grid, 0.3);
    const DirectionPair pair{Direction::from_degrees(50, 10), Direction::from_degrees(70, 200)};
    std::vector<double> lobe(3), both(3), painted_lobe(3), mirror(3), batch(6);
    plain.brdf(pair, lobe);
    painted.brdf(pair, both);
    painted.directional_diffuse(pair, painted_lobe);
    plain.specular_reflectance(pair.in, mirror);
    painted.brdf(std::vector{pair, pair}, batch);
    const auto published = model.brdf(pair);
    const auto published_mirror = model.specular_reflectance(pair.in);
    std::vector<hts::Mueller> mueller(grid.size()), mirrored(grid.size());
    painted.mueller(pair, mueller);
    painted.specular_mueller(pair.in, mirrored);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const EnergyCompensation s{surface, grid[i]};
        CHECK(lobe[i] == Approx(s.factor(pair.in) * s.factor(pair.out) * published[i]).epsilon(1e-13));
        CHECK(both[i] - lobe[i] == Approx(0.3 / std::numbers::pi).epsilon(1e-12));
        CHECK(painted_lobe[i] == Approx(lobe[i]).epsilon(1e-12));
        CHECK(batch[3 + i] == both[i]);
        CHECK(mueller[i](0, 0) == Approx(both[i]).epsilon(1e-12));
        CHECK(mirror[i] ==
              Approx(std::pow(s.factor(pair.in), 2) * published_mirror[i].value()).epsilon(1e-13));
        CHECK(mirrored[i](0, 0) == Approx(mirror[i]).epsilon(1e-12));
    }
    CHECK_THROWS_WITH(compensated(model, {}),
                      "copper: 0 compensations: must be one for each of 3 wavelengths");
}

TEST_CASE("draws of a compensated surface weigh what it reflects") {
    const auto grid = WavelengthGrid::from_micrometres({0.5});
    const Reflectance rough = copper({0.3, 1}, grid, 0.1);
    const Sampler sampler = rough.sampler(0);
    Random random{7};
    const Direction in = Direction::from_degrees(60, 30);
    constexpr int count = 40'000;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double u0 = random.uniform(0, 1), u1 = random.uniform(0, 1);
        const hts::Draw drawn = sampler.sample(in, {u0, u1, random.uniform(0, 1)});
        if (drawn.lobe == hts::Lobe::directional_diffuse || drawn.lobe == hts::Lobe::uniform_diffuse) {
            CHECK(drawn.weight ==
                  Approx(rough.brdf({in, drawn.out}).front() * drawn.out.cos_theta() / drawn.pdf)
                      .epsilon(1e-9));
        }
        sum += drawn.weight;
        squares += drawn.weight * drawn.weight;
    }
    const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
    CHECK(std::abs(mean - rough.albedo(in, 0).total()) < 5 * error);
}

TEST_CASE("factors between wavelengths are interpolated, closely where they are dense") {
    const Surface surface{0.2, 1};
    const auto dense = WavelengthGrid::linear(0.4, 0.7, 11), few = WavelengthGrid::linear(0.42, 0.66, 2);
    const auto solved = EnergyCompensation::of(surface, few),
               between = EnergyCompensation::interpolated(EnergyCompensation::of(surface, dense), dense, few);
    WorstCase worst{"interpolated factor s against the solved one", 3e-5};
    for (const double degrees : {0., 30., 60., 80., 89.}) {
        const hts::spectral::CompensationPlace place{Direction::from_degrees(degrees, 0)};
        for (std::size_t i = 0; i < few.size(); ++i) {
            worst.note(relative_error(between[i].factor(place), solved[i].factor(place)),
                       [&] { return hts::shortest(degrees) + " deg"; });
        }
    }
    worst.check();
}

TEST_CASE("a lossy surface stays below 1 and gains") {
    const auto red = Wavelength::from_micrometres(0.65);
    for (const double slope : {0.1, 0.5}) {
        const Surface rough{0.3, 0.3 / slope};
        const hts::RefractiveIndex index = built_in_optical_constants("Cu").index(red);
        const EnergyCompensation s{rough, red};
        for (const double degrees : {0.0, 45.0, 80.0}) {
            const Direction in = Direction::from_degrees(degrees, 0);
            const double with = directional_hemispherical_reflectance(s, rough, index, red, in).total();
            CHECK(with < 1);
            CHECK(with > 0.85);
            CHECK(with >= directional_hemispherical_reflectance(rough, index, red, in).total() - 1e-3);
        }
    }
}

TEST_CASE("limits of compensation: a mirror, a long wavelength, an empty lobe, the horizon") {
    const EnergyCompensation mirror{{0, 1}, one_um};
    for (const double degrees : {0.0, 45.0, 89.0, 90.0})
        CHECK(mirror.factor(Direction::from_degrees(degrees, 0)) == Approx(1));
    CHECK(mirror.factor(Direction::from_vector({1, 0, -0.0})) == Approx(1));
    const Surface rough{1e-5, 2e-5};
    const EnergyCompensation deep{rough, one_um};  // sigma_0 = lambda / 100 000: a mirror at every angle
    for (const double degrees : {0.0, 60.0, 85.0}) {
        const Direction in = Direction::from_degrees(degrees, 0);
        CHECK(std::pow(deep.factor(in), 2) * coherent_fraction(rough, view(rough, in), one_um) ==
              Approx(1).epsilon(1e-4));
    }
    for (const double length : {hts::shortest_length, hts::longest_length}) {
        for (const double other : {hts::shortest_length, hts::longest_length}) {
            const EnergyCompensation extreme{{length, other}, one_um};
            for (const double degrees : {0.0, 45.0, 90.0}) {
                CHECK(extreme.factor(Direction::from_degrees(degrees, 0)) > 0);
                CHECK(std::isfinite(extreme.factor(Direction::from_degrees(degrees, 0))));
            }
        }
    }
}
