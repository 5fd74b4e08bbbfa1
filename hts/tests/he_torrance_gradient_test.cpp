#include "hts/he_torrance_gradient.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "gradient_points.hpp"

using hts::Direction;
using hts::Mueller;
using hts::PairFactors;
using hts::PairGradient;
using hts::RefractiveIndex;
using hts::Surface;
using hts::view_gradient;
using hts::Wavelength;
using hts::testing::parameters;
using hts::testing::Point;
using hts::testing::Random;
using hts::testing::random_point;
using hts::testing::ReferenceTable;
using hts::testing::WorstCase;

namespace {

constexpr double representable = 1e-270;

const std::vector<std::string> inputs{
    "wavelength_um",    "theta_i_deg",          "phi_i_deg", "theta_r_deg", "phi_r_deg", "n", "k",
    "rms_roughness_um", "correlation_length_um"};

/// A row of a reference file as the engine takes it.
struct Row {
    Surface surface;
    RefractiveIndex index;
    Wavelength wavelength;
    Direction in, out;
    double width;  // of the lobe, as accuracy::brdf_gradient has it

    Row(const ReferenceTable& table, std::size_t row)
        : surface{table(row, "rms_roughness_um"), table(row, "correlation_length_um")},
          index{table(row, "n"), table(row, "k")},
          wavelength{Wavelength::from_micrometres(table(row, "wavelength_um"))},
          in{Direction::from_degrees(table(row, "theta_i_deg"), table(row, "phi_i_deg"))},
          out{Direction::from_degrees(table(row, "theta_r_deg"), table(row, "phi_r_deg"))} {
        const PairFactors pair{surface, in, out};
        const double inverse_m =
            -hts::phi_gradient(pair.phase_variance(wavelength), pair.lobe_argument(wavelength)).log_d_t;
        width = std::fmin(
            1, std::sqrt(2 / inverse_m) / (wavelength.wave_number() * surface.correlation_length()));
    }

    /// |p d| + f and its like: what an error of d times p is measured beside.
    [[nodiscard]] double error(const std::string& parameter, double computed, double expected, double value,
                               double angle) const {
        double unit = 1, scale = value;
        if (parameter == "rms_roughness") unit = surface.rms_roughness();
        if (parameter == "correlation_length") unit = surface.correlation_length();
        if (parameter == "n" || parameter == "k") unit = std::hypot(index.n(), index.k());
        if (parameter == "theta_i" || parameter == "theta_r" || parameter == "phi") scale = value / angle;
        return unit * std::abs(computed - expected) / (unit * std::abs(expected) + scale);
    }
};

double step_of(const Point& p, const hts::testing::Parameter<double>& by) {
    const double lobe = p.wavelength / p.correlation_length;
    return by.name == "theta_i" || by.name == "theta_r" || by.name == "phi" ? 1e-3 * std::fmin(1, lobe)
                                                                            : 1e-3 * p.*by.of_point;
}

/// The derivative by the rms roughness of many points, beside that with the sums of Phi for its table: finds
/// the worst of the table's polynomials, which few reference points meet.
template <class Derivative>
void search_table(WorstCase& worst, const Derivative& derivative) {
    Random random{60};
    for (int i = 0; i < 200000; ++i) {
        const Point p = random_point(random);
        const PairGradient pair = p.pair();
        const double g = pair.factors().phase_variance(p.lambda());
        const auto phi = hts::phi_gradient(g, pair.factors().lobe_argument(p.lambda()));
        const double log_slope =
            2 * (1 + pair.log_roughness_by_log_slope()) * g * phi.log_d_g + pair.log_geometry_by_log_slope();
        const auto [value, by] = derivative(p, pair);
        if (!(value > representable)) continue;
        worst.note(std::abs(p.rms_roughness * by - value * log_slope) / (value * (1 + std::abs(log_slope))),
                   [&] { return "search, g = " + std::to_string(g); });
    }
}

}  // namespace

TEST_CASE("derivatives of the lobe and of the specular term agree with differences at 80 digits") {
    const ReferenceTable table{"tests/reference/gradient.csv"};
    WorstCase lobe{"gradient of the directional-diffuse term", hts::accuracy::brdf_gradient};
    WorstCase mirror{"gradient of the specular reflectance", hts::accuracy::specular_gradient};
    for (std::size_t r = 0; r < table.size(); ++r) {
        const Row row{table, r};
        const PairGradient pair{row.surface, row.in, row.out};
        const auto f = hts::directional_diffuse_gradient(pair, row.wavelength, row.index);
        const auto s = hts::specular_reflectance_gradient(row.surface, view_gradient(row.surface, row.in),
                                                          row.wavelength, row.index);
        const double brdf = table(r, "directional_diffuse"), reflectance = table(r, "specular_reflectance");
        for (const auto& by : parameters<double>()) {
            const auto where = [&] { return by.name + ", " + table.describe(r, inputs); };
            if (brdf > representable)
                lobe.note(row.error(by.name, f.by.*by.of_gradient,
                                    table(r, "directional_diffuse_by_" + by.name), brdf, row.width),
                          where);
            if (by.name == "theta_r" || by.name == "phi") {
                CHECK(s.by.*by.of_gradient == 0);
            } else if (reflectance > representable) {
                mirror.note(row.error(by.name, s.by.*by.of_gradient, table(r, "specular_by_" + by.name),
                                      reflectance, 1),
                            where);
            }
        }
    }
    search_table(lobe, [](const Point& p, const PairGradient& pair) {
        const auto f = hts::directional_diffuse_gradient(pair, p.lambda(), p.index());
        return std::pair{f.value, f.by.rms_roughness};
    });
    lobe.check();
    mirror.check();
}

TEST_CASE("derivatives of the Mueller matrices agree with differences at 80 digits") {
    const ReferenceTable table{"tests/reference/mueller_gradient.csv"};
    WorstCase lobe{"gradient of the directional-diffuse Mueller matrix", hts::accuracy::mueller_gradient};
    WorstCase mirror{"gradient of the specular Mueller matrix", hts::accuracy::specular_mueller_gradient};
    for (std::size_t r = 0; r < table.size(); ++r) {
        const Row row{table, r};
        const PairGradient pair{row.surface, row.in, row.out};
        const auto m = hts::directional_diffuse_mueller_gradient(pair, row.wavelength, row.index);
        const auto s = hts::specular_mueller_gradient(row.surface, view_gradient(row.surface, row.in),
                                                      row.wavelength, row.index);
        for (const auto& by : parameters<Mueller>()) {
            const auto where = [&] { return by.name + ", " + table.describe(r, inputs); };
            const auto note = [&](WorstCase& worst, const char* name, const char* value,
                                  const Mueller& computed, std::size_t i, std::size_t j, double angle) {
                const std::string column = std::string{name} + std::to_string(i) + std::to_string(j);
                if (table(r, value) > representable)
                    worst.note(row.error(by.name, computed(i, j), table(r, column + "_by_" + by.name),
                                         table(r, value), angle),
                               [&] { return column + " by " + where(); });
            };
            for (std::size_t e = 0; e < 16; ++e)
                note(lobe, "m", "m00", m.by.*by.of_gradient, e / 4, e % 4, row.width);
            const Mueller& of_mirror = s.by.*by.of_gradient;
            if (by.name == "theta_r" || by.name == "phi") {
                CHECK(of_mirror.elements() == Mueller{}.elements());
                continue;
            }
            note(mirror, "s", "s00", of_mirror, 0, 0, 1);
            note(mirror, "s", "s00", of_mirror, 0, 1, 1);
            note(mirror, "s", "s00", of_mirror, 2, 2, 1);
            note(mirror, "s", "s00", of_mirror, 2, 3, 1);
            CHECK(of_mirror(1, 0) == of_mirror(0, 1));
            CHECK(of_mirror(3, 2) == -of_mirror(2, 3));
            CHECK(of_mirror(3, 3) == of_mirror(2, 2));
            CHECK(of_mirror(0, 2) == 0);
        }
    }
    search_table(lobe, [](const Point& p, const PairGradient& pair) {
        const auto m = hts::directional_diffuse_mueller_gradient(pair, p.lambda(), p.index());
        return std::pair{m.value(0, 0), m.by.rms_roughness(0, 0)};
    });
    lobe.check();
    mirror.check();
}

TEST_CASE("values beside the derivatives are those of the model") {
    Random random{61};
    WorstCase worst{"values with and without gradient", 3e-13};
    for (int i = 0; i < 2000; ++i) {
        const Point p = random_point(random);
        const auto where = [&] { return "lambda = " + std::to_string(p.wavelength); };
        const double brdf = p.brdf();
        if (brdf < representable) continue;
        worst.note(hts::testing::relative_error(p.gradient().value, brdf), where);
        worst.note(hts::testing::relative_error(p.mueller_gradient().value(0, 0), brdf), where);
        CHECK(p.specular_gradient().value.value() == Approx(p.specular()).epsilon(1e-14));
    }
    worst.check();
}

TEST_CASE("derivatives agree with differences of the engine, whatever the lobe") {
    Random random{62};
    WorstCase worst{"against finite differences", 4e-6};
    for (int i = 0; i < 3000; ++i) {
        const Point p = random_point(random);
        const hts::DiffuseLobe lobe = i % 4 == 0   ? hts::DiffuseLobe::first_order
                                      : i % 4 == 1 ? hts::DiffuseLobe::rough_limit
                                                   : hts::DiffuseLobe::full;
        const auto f = p.gradient(lobe);
        const auto lobe_of = hts::directional_diffuse(p.pair().factors(), p.lambda(), p.index());
        const double g = lobe_of.phase_variance, t = lobe_of.lobe_argument;
        const double steepness = lobe == hts::DiffuseLobe::first_order   ? g + t
                                 : lobe == hts::DiffuseLobe::rough_limit ? t / g
                                                                         : t / std::fmax(1, g);
        if (steepness > 20) continue;  // would need shorter steps
        for (const auto& by : parameters<double>()) {
            const double step = step_of(p, by);
            const double expected =
                difference(p, by.of_point, step, [&](const Point& q) { return q.brdf(lobe); });
            const double beside = std::abs(expected) + f.value / (1e3 * step);
            worst.note(std::abs(f.by.*by.of_gradient - expected) / beside,
                       [&] { return by.name + ", " + name(lobe) + ", case " + std::to_string(i); });
        }
    }
    worst.check();
}
