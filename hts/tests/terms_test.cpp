#include "hts/terms.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"

using hts::Direction;
using hts::Mueller;
using hts::PairFactors;
using hts::RefractiveIndex;
using hts::Stokes;
using hts::Surface;
using hts::view;
using hts::Wavelength;
using hts::testing::Random;
using hts::testing::ReferenceTable;
using hts::testing::relative_error;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;

/// One row of model.csv, or any single evaluation.
struct Query {
    Surface surface;
    RefractiveIndex index;
    Wavelength wavelength;
    Direction in, out;

    [[nodiscard]] PairFactors pair() const { return {surface, view(surface, in), view(surface, out)}; }
    [[nodiscard]] hts::DirectionalDiffuse term() const {
        return hts::directional_diffuse(pair(), wavelength, index);
    }
    [[nodiscard]] double specular() const {
        return hts::specular_reflectance(surface, view(surface, in), wavelength, index).value();
    }
};

Query query_of(const ReferenceTable& table, std::size_t row) {
    return {{table(row, "rms_roughness_um"), table(row, "correlation_length_um")},
            {table(row, "n"), table(row, "k")},
            Wavelength::from_micrometres(table(row, "wavelength_um")),
            Direction::from_degrees(table(row, "theta_i_deg"), table(row, "phi_i_deg")),
            Direction::from_degrees(table(row, "theta_r_deg"), table(row, "phi_r_deg"))};
}

Query random_query(Random& random) {
    const double wavelength = random.logarithmic(0.3, 13);
    const double roughness = wavelength * random.logarithmic(1e-3, 3);
    const double theta = random.uniform(0, 89);
    return {{roughness, roughness / random.logarithmic(0.01, 1)},
            {random.uniform(0.05, 3), random.uniform(0, 10)},
            Wavelength::from_micrometres(wavelength),
            Direction::from_degrees(theta, random.uniform(0, 360)),
            Direction::from_degrees(random.uniform(0, 89), random.uniform(0, 360))};
}

const std::vector<std::string> inputs{
    "wavelength_um",    "theta_i_deg",          "phi_i_deg", "theta_r_deg", "phi_r_deg", "n", "k",
    "rms_roughness_um", "correlation_length_um"};

}  // namespace

TEST_CASE("the three terms agree with 50 digits of the printed equations") {
    const ReferenceTable table{"tests/reference/model.csv"};
    WorstCase diffuse{"directional diffuse", hts::accuracy::brdf};
    WorstCase specular{"specular reflectance", hts::accuracy::specular_reflectance};
    WorstCase mueller{"Mueller element, of element 00", hts::accuracy::mueller};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const Query query = query_of(table, row);
        const auto where = [&] { return table.describe(row, inputs); };
        const auto term = query.term();
        diffuse.note(relative_error(term.brdf, table(row, "directional_diffuse")), where);
        const double expected_specular = table(row, "specular_reflectance");
        if (expected_specular > 1e-280) {
            specular.note(relative_error(query.specular(), expected_specular), where);
        }
        const Mueller m = hts::directional_diffuse_mueller(query.in, query.out, term);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                const double expected =
                    table(row, std::string{"m"}.append(std::to_string(i)).append(std::to_string(j)));
                mueller.note(std::abs(m(i, j) - expected) / table(row, "m00"), where);
            }
        }
        CHECK(hts::uniform_diffuse(table(row, "albedo")) ==
              Approx(table(row, "uniform_diffuse")).epsilon(1e-15));
    }
    diffuse.check();
    specular.check();
    mueller.check();
}

TEST_CASE("the parts of the directional-diffuse term agree with 50 digits") {
    const ReferenceTable table{"tests/reference/model.csv"};
    WorstCase worst{"g, sigma, S, |F|^2", 5e-15};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const Query query = query_of(table, row);
        const auto where = [&] { return table.describe(row, inputs); };
        const auto term = query.term();
        worst.note(relative_error(term.phase_variance, table(row, "g")), where);
        worst.note(relative_error(query.pair().effective_roughness(), table(row, "effective_roughness_um")),
                   where);
        worst.note(relative_error(query.pair().shadowing(), table(row, "shadowing")), where);
        worst.note(relative_error(term.amplitudes.unpolarised_reflectance(), table(row, "fresnel")), where);
    }
    worst.check();
}

TEST_CASE("short wavelengths meet the Beckmann microfacet BRDF") {
    // f -> F S D_B / (4 cos theta_i cos theta_r), alpha = 2 sigma / tau, D_B of [Walter07 (25)]
    Random random{21};
    WorstCase worst{"against Beckmann's microfacets", 4e-7};
    while (worst.count() < 2000) {
        Query query = random_query(random);
        query.wavelength = Wavelength::from_micrometres(query.surface.rms_roughness() * 1e-5);
        const PairFactors pair = query.pair();
        const double alpha = 2 * pair.effective_roughness() / query.surface.correlation_length();
        const double tan_h = pair.change().horizontal / pair.change().vertical;
        const double cos_h = pair.change().vertical / std::sqrt(pair.change().squared());
        if (tan_h > 6 * alpha) continue;
        const double beckmann =
            std::exp(-std::pow(tan_h / alpha, 2)) / (pi * alpha * alpha * std::pow(cos_h, 4));
        const double microfacets = hts::fresnel(pair.cos_theta_d(), query.index).unpolarised_reflectance() *
                                   pair.shadowing() * beckmann /
                                   (4 * query.in.cos_theta() * query.out.cos_theta());
        worst.note(relative_error(query.term().brdf, microfacets),
                   [&] { return "g = " + std::to_string(query.term().phase_variance); });
    }
    worst.check();
}

TEST_CASE("the approach to geometric optics is that of 50 digits") {
    // f / (F S D_B / 4 cos cos) = 1 + (q^2/2 - 2 q + 1)/g + O(1/g^2), q = t/g
    const ReferenceTable table{"tests/reference/limits.csv"};
    WorstCase worst{"directional diffuse at large g", hts::accuracy::brdf};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto term = query_of(table, row).term();
        worst.note(relative_error(term.brdf, table(row, "directional_diffuse")),
                   [&] { return table.describe(row, inputs); });
        const double g = term.phase_variance;
        const double q = term.lobe_argument / g;
        const double approach = 1 + (q * q / 2 - 2 * q + 1) / g;
        const double beyond = 1.3 * (1 + std::pow(q, 4) / 8) / (g * g);
        CHECK(term.brdf / table(row, "geometric_optics_limit") == Approx(approach).margin(beyond + 1e-11));
    }
    worst.check();
}

TEST_CASE("limits of the directional-diffuse term") {
    const RefractiveIndex index{0.8, 6};
    const auto half = Wavelength::from_micrometres(0.5);
    const auto at = [&](const Surface& surface, double theta_i, double theta_r, double phi,
                        Wavelength wavelength) {
        return Query{surface, index, wavelength, Direction::from_degrees(theta_i, 0),
                     Direction::from_degrees(theta_r, phi)}
            .term()
            .brdf;
    };
    const Surface rough{0.28, 1.77};
    // the horizon: 0, approached from above
    CHECK(at(rough, 80, 90, 180, half) == 0);
    CHECK(at(rough, 90, 90, 180, half) == 0);
    CHECK(at(rough, 80, 89.9999999999, 180, half) < at(rough, 80, 89.99, 180, half));
    // exact backscatter, also at the normal: what its neighbours have
    for (const double theta : {0.0, 30.0, 80.0}) {
        CHECK(at(rough, theta, theta, 0, half) == Approx(at(rough, theta, theta, 1e-7, half)).epsilon(1e-7));
        CHECK(at(rough, theta, theta, 0, half) > 0);
    }
    // an uncorrelated surface scatters nothing coherently, an endlessly correlated one only
    // into the mirror direction
    CHECK(at({0.28, 1e-20}, 30, 40, 180, half) < 1e-30);
    CHECK(at({0.28, 1e20}, 30, 40, 180, half) == 0);
    CHECK(at({0.28, 1e20}, 30, 30, 180, half) > 1e30);
    // long waves see a mirror: 1/lambda^4, and the specular term tends to |F|^2 S
    const auto long_wave = Wavelength::from_micrometres(1e6);
    const auto longer_wave = Wavelength::from_micrometres(2e6);
    CHECK(at(rough, 30, 40, 100, long_wave) / at(rough, 30, 40, 100, longer_wave) ==
          Approx(16).epsilon(1e-6));
    const auto in = view(rough, Direction::from_degrees(60, 0));
    const double shadowing = in.visibility.shadowing * in.visibility.shadowing;
    CHECK(hts::specular_reflectance(rough, in, long_wave, index).value() ==
          Approx(hts::fresnel(in.direction.cos_theta(), index).unpolarised_reflectance() * shadowing)
              .epsilon(1e-9));
    // short waves: geometric optics, whose lobe no longer depends on the wavelength
    CHECK(at(rough, 30, 40, 170, Wavelength::from_micrometres(1e-6)) ==
          Approx(at(rough, 30, 40, 170, Wavelength::from_micrometres(1e-9))).epsilon(1e-9));
}

TEST_CASE("unpolarised light is the average over polarisations") {
    Random random{22};
    for (int i = 0; i < 1000; ++i) {
        const Query query = random_query(random);
        const auto term = query.term();
        const Mueller m = hts::directional_diffuse_mueller(query.in, query.out, term);
        const double s = (m * Stokes::s_polarised()).intensity();
        const double p = (m * Stokes::p_polarised()).intensity();
        CHECK(m(0, 0) == Approx(term.brdf).epsilon(1e-13));
        CHECK((s + p) / 2 == Approx(term.brdf).epsilon(1e-13));
        CHECK((m * Stokes::s_polarised()).degree_of_polarisation() == Approx(term.brdf > 0).epsilon(1e-12));
        const Mueller mirror = hts::specular_mueller(query.surface, view(query.surface, query.in),
                                                     query.wavelength, query.index);
        CHECK(mirror(0, 0) == Approx(query.specular()).epsilon(1e-13));
    }
}

TEST_CASE("the model is reciprocal") {
    Random random{23};
    WorstCase worst{"f(in, out) against f(out, in)", 1e-12};
    for (int i = 0; i < 20000; ++i) {
        Query query = random_query(random);
        const double there = query.term().brdf;
        std::swap(query.in, query.out);
        if (there > 1e-280) {
            worst.note(relative_error(query.term().brdf, there),
                       [&] { return "g = " + std::to_string(query.term().phase_variance); });
        }
    }
    worst.check();
}

TEST_CASE("what the mirror loses the lobe gains") {
    // a narrow lobe of gentle slopes, F = 1: specular + integral of f cos theta_r = |F|^2 S
    const Surface surface{0.2, 100};
    const RefractiveIndex conductor{1e9, 1e9};
    for (const double wavelength_um : {20.0, 2.0, 1.0, 0.6}) {
        const Wavelength wavelength = Wavelength::from_micrometres(wavelength_um);
        const auto normal = view(surface, Direction::from_degrees(0, 0));
        const auto ring = [&](double sine) {
            const Direction out = Direction::from_vector({sine, 0, std::sqrt(1 - sine * sine)});
            const PairFactors pair{surface, normal, view(surface, out)};
            return 2 * pi * sine * hts::directional_diffuse(pair, wavelength, conductor).brdf;
        };
        const double reach =
            8 * wavelength_um / (pi * 100) * std::sqrt(2 + std::pow(4 * pi * 0.2 / wavelength_um, 2));
        const double diffuse = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
            ring, 0, std::min(0.999, reach), 8, 1e-10);
        const double specular = hts::specular_reflectance(surface, normal, wavelength, conductor).value();
        CHECK(specular + diffuse == Approx(1).epsilon(0.01));
        CHECK(specular == Approx(std::exp(-std::pow(4 * pi * 0.2 / wavelength_um, 2))).epsilon(1e-8));
    }
}

TEST_CASE("a mirror has no lobe and all of Fresnel's reflectance") {
    const Surface mirror{0, 2};
    const RefractiveIndex index{1.5, 0};
    const auto wavelength = Wavelength::from_micrometres(0.5);
    const auto in = view(mirror, Direction::from_degrees(40, 0));
    const auto out = view(mirror, Direction::from_degrees(40, 180));
    CHECK(hts::directional_diffuse({mirror, in, out}, wavelength, index).brdf == 0);
    CHECK(hts::specular_reflectance(mirror, in, wavelength, index).value() ==
          Approx(hts::fresnel(in.direction.cos_theta(), index).unpolarised_reflectance()).epsilon(1e-15));
}

TEST_CASE("the specular coefficient is no number") {
    const auto adds = []<class T>(T) {
        return requires(T t) {
            t + 1.0;
        };
    };
    CHECK(adds(1.0));
    CHECK_FALSE(adds(hts::SpecularReflectance{0.5}));
}

TEST_CASE("uniform diffuse is albedo over pi and depolarises") {
    CHECK(hts::uniform_diffuse(0.9) == Approx(0.9 / pi).epsilon(1e-15));
    CHECK((hts::uniform_diffuse_mueller(0.9) * Stokes::s_polarised()).degree_of_polarisation() == 0);
    CHECK_THROWS_WITH(hts::uniform_diffuse(1.1), "diffuse albedo 1.1: must be from 0 to 1");
    CHECK_THROWS_AS(hts::uniform_diffuse(-0.1), hts::Error);
}
