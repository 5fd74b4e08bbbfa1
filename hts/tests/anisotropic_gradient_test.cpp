// Derivatives of the model over surfaces of two correlation lengths against differences at 50 digits.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/he_torrance_gradient.hpp"

using hts::Direction;
using hts::Gradient;
using hts::Surface;
using hts::testing::ReferenceTable;
using hts::testing::WorstCase;

namespace {

const auto one_um = hts::Wavelength::from_micrometres(1);

struct Row {
    const ReferenceTable& table;
    std::size_t row;

    [[nodiscard]] double operator()(const char* column) const { return table(row, column); }
    [[nodiscard]] Surface surface() const {
        return Surface::anisotropic((*this)("sigma"), {(*this)("along"), (*this)("across")},
                                    Direction::from_degrees(90, (*this)("azimuth")));
    }
    [[nodiscard]] Direction in() const {
        return Direction::from_degrees((*this)("theta_i"), (*this)("phi_i"));
    }
    [[nodiscard]] Direction out() const {
        return Direction::from_degrees((*this)("theta_r"), (*this)("phi_r"));
    }
    [[nodiscard]] hts::RefractiveIndex index() const { return {(*this)("n"), (*this)("k")}; }
    [[nodiscard]] std::string describe() const {
        return table.describe(
            row, {"sigma", "along", "across", "azimuth", "theta_i", "phi_i", "theta_r", "phi_r", "n", "k"});
    }
};

/// Of the azimuth, within which the lobe changes [rad].
double lobe_width(const Row& row) {
    const double longest = std::max(row("along"), row("across"));
    const double g = hts::PairFactors{row.surface(), row.in(), row.out()}.phase_variance(one_um);
    return std::min(1.0, std::sqrt(2 * std::max(1.0, g)) / (2 * std::numbers::pi * longest));
}

}  // namespace

TEST_CASE("derivatives of anisotropic surfaces agree with 50 digits") {
    const ReferenceTable points{"tests/reference/anisotropic.csv"};
    const ReferenceTable derivatives{"tests/reference/anisotropic_gradient.csv"};
    REQUIRE(derivatives.size() == points.size());
    WorstCase lobe{"derivatives of the lobe, anisotropic", hts::accuracy::brdf_gradient};
    WorstCase mueller{"element 00 of the Mueller matrix's", hts::accuracy::mueller_gradient};
    WorstCase mirror{"derivatives of the specular term, anisotropic", hts::accuracy::specular_gradient};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Row row{points, i};
        const Surface s = row.surface();
        const hts::PairGradient pair{s, row.in(), row.out()};
        const auto f = directional_diffuse_gradient(pair, one_um, row.index());
        const auto matrix = directional_diffuse_mueller_gradient(pair, one_um, row.index());
        const auto specular =
            specular_reflectance_gradient(s, view_gradient(s, row.in()), one_um, row.index());
        // a length p times the derivative beside the value, and an angle's beside the
        // value over the lobe's width
        const double width = lobe_width(row);
        const std::array<std::pair<const char*, double>, 7> parameters{{{"sigma", row("sigma")},
                                                                        {"along", row("along")},
                                                                        {"across", row("across")},
                                                                        {"azimuth", width},
                                                                        {"theta_i", width},
                                                                        {"theta_r", width},
                                                                        {"phi", width}}};
        const auto in_order = [](const auto& by, auto&& value) {
            return std::array{value(by.rms_roughness),
                              value(by.correlation_length_x),
                              value(by.correlation_length_y),
                              value(by.azimuth),
                              value(by.theta_i),
                              value(by.theta_r),
                              value(by.phi)};
        };
        const auto numbers = [](double d) { return d; };
        const auto of_lobe = in_order(f.by, numbers), of_mirror = in_order(specular.by, numbers);
        const auto of_matrix = in_order(matrix.by, [](const hts::Mueller& m) { return m(0, 0); });
        for (std::size_t p = 0; p < parameters.size(); ++p) {
            const std::string name = parameters[p].first;
            const double scale = parameters[p].second;
            const auto where = [&] { return name + " at " + row.describe(); };
            const auto note = [&](WorstCase& worst, double value, double found, const std::string& column,
                                  double unit) {
                const double expected = derivatives(i, column + name);
                worst.note(unit * std::abs(found - expected) / (unit * std::abs(expected) + value), where);
            };
            note(lobe, f.value, of_lobe[p], "lobe_", scale);
            note(mueller, f.value, of_matrix[p], "lobe_", scale);
            if (p < 5 && specular.value.value() > 1e-270)
                note(mirror, specular.value.value(), of_mirror[p], "mirror_", p < 3 ? scale : 1);
        }
        // in proportion, both lengths are one
        const double together =
            (row("along") * f.by.correlation_length_x + row("across") * f.by.correlation_length_y) /
            s.correlation_length();
        CHECK(f.by.correlation_length == Approx(together).epsilon(1e-10).margin(1e-10 * f.value));
    }
    lobe.check();
    mueller.check();
    mirror.check();
}

TEST_CASE("a Mueller matrix turns with the surface") {
    // all elements by the azimuth: against differences of the matrix itself
    const ReferenceTable points{"tests/reference/anisotropic.csv"};
    WorstCase worst{"Mueller elements by the azimuth, from differences", 5e-8};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Row row{points, i};
        const Surface s = row.surface();
        const auto matrix = [&](const Surface& of) {
            return directional_diffuse_mueller(
                row.in(), row.out(), directional_diffuse({of, row.in(), row.out()}, one_um, row.index()));
        };
        const double width = lobe_width(row), step = 3e-3 * width;
        const auto turned = [&](double by) {
            return matrix(
                Surface::anisotropic(s.rms_roughness(), s.correlation_lengths(),
                                     Direction::from_angles(std::numbers::pi / 2, s.azimuth() + by)));
        };
        const hts::Mueller here = matrix(s);
        const std::array around{turned(-2 * step), turned(-step), turned(step), turned(2 * step)};
        const auto found =
            directional_diffuse_mueller_gradient({s, row.in(), row.out()}, one_um, row.index()).by.azimuth;
        for (std::size_t e = 0; e < 16; ++e) {
            const auto at = [&](std::size_t k) { return around[k].elements()[e]; };
            const double expected = (8 * (at(2) - at(1)) - (at(3) - at(0))) / (12 * step);
            worst.note(width * std::abs(found.elements()[e] - expected) /
                           (width * std::abs(found(0, 0)) + here(0, 0)),
                       [&] { return row.describe(); });
        }
    }
    worst.check();
}
