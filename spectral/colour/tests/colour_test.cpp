#include "spectral/colour/colour.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "colour_comparison.hpp"
#include "comparison.hpp"
#include "hts/error.hpp"
#include "spectral/colour/colour_data.hpp"

using namespace hts::spectral;
using namespace hts::testing;
using Catch::Matchers::Message;

namespace {

/// Straight lines through the samples, end values held; on purpose not the code under test.
double joined(const std::vector<double>& x, const std::vector<double>& y, double at) {
    if (at <= x.front()) return y.front();
    std::size_t i = 1;
    while (i < x.size() && x[i] < at) ++i;
    if (i == x.size()) return y.back();
    return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

// Test spectra over the wavelength in nm.
double edge(double nm) {
    return 1 / (1 + std::exp(-(nm - 600) / 8));
}
double blue(double nm) {
    return 1 / (1 + std::exp((nm - 480) / 8));
}
double peak(double nm) {
    return std::exp(-std::pow((nm - 540) / 25, 2));
}
double fringes(double nm) {
    return 0.5 + 0.5 * std::cos(2 * std::numbers::pi * 3000 / nm);
}

}  // namespace

// ---- observer and illuminants

TEST_CASE("observer and illuminants are linear between nodes and 0 outside", "[colour]") {
    CHECK(colour_matching(0.600).X == Approx(1.0622).epsilon(1e-12));
    CHECK(colour_matching(0.6025).X == Approx((1.0622 + 1.0456) / 2).epsilon(1e-12));
    CHECK(relative_power(0.3625, Illuminant::D65) == Approx((46.6383 + 49.3637) / 2).epsilon(1e-12));
    CHECK(relative_power(0.4567, Illuminant::E) == 100);
    CHECK(colour_matching(0.36).X == Approx(0.0001299));
    CHECK(colour_matching(0.83).X == Approx(0.000001251141));
    for (const double outside : {0.3599, 0.8301, -1., 1e300, std::nan("")}) {
        CHECK(worst_of(colour_matching(outside), {0, 0, 0}) == 0);
        CHECK(relative_power(outside, Illuminant::D65) == 0);
    }
}

TEST_CASE("white points are the published ones", "[colour]") {
    const Chromaticity e = chromaticity(white_point(Illuminant::E));
    const Chromaticity d65 = chromaticity(white_point(Illuminant::D65));
    check_at_most("chromaticity of the whites",
                  std::max({std::abs(e.x - 1. / 3), std::abs(e.y - 1. / 3), std::abs(d65.x - 0.31272),
                            std::abs(d65.y - 0.32903)}),
                  hts::accuracy::white_chromaticity);
    CHECK(chromaticity({0, 0, 0}).x == 0);
}

// ---- tristimulus

TEST_CASE("the perfect white has Y = 1", "[colour]") {
    for (const Illuminant illuminant : both) {
        for (const auto& wavelengths : {grid(0.4, 0.7, 2), grid(0.38, 0.78, 41), grid(0.2, 2.5, 1000)}) {
            const std::vector<double> ones(wavelengths.size(), 1);
            const Xyz white = tristimulus(wavelengths, ones, illuminant);
            CHECK(worst_of(white, white_point(illuminant)) < 1e-13);
            CHECK(white.Y == Approx(1).epsilon(1e-13));
        }
    }
}

TEST_CASE("tristimulus values agree with the CIE's sum at 1 nm", "[colour]") {
    struct Case {
        double (*reflectance)(double);
        Illuminant illuminant;
        Xyz reference;
    };
    // sum S x_bar R / sum S y_bar over 360, 361, ... 830 nm, x_bar from the 1 nm table (as in
    // ArgyllCMS 2.3.1), D65 linear between its 5 nm values as the CIE prescribes; Python.
    const std::vector<Case> cases = {
        {edge, Illuminant::E, {0.385687, 0.186265, 0.000132}},
        {edge, Illuminant::D65, {0.336362, 0.163993, 0.000121}},
        {blue, Illuminant::E, {0.152979, 0.033919, 0.831592}},
        {blue, Illuminant::D65, {0.163726, 0.038467, 0.898169}},
        {peak, Illuminant::E, {0.133351, 0.364247, 0.016646}},
        {peak, Illuminant::D65, {0.137468, 0.382335, 0.017973}},
        {fringes, Illuminant::E, {0.583237, 0.494928, 0.478460}},
        {fringes, Illuminant::D65, {0.540220, 0.483790, 0.491978}},
    };
    const std::vector<double> wavelengths = grid(0.36, 0.83, 471);
    double worst = 0;
    for (const Case& c : cases) {
        const auto reflectance = sampled(wavelengths, [&](double um) { return c.reflectance(1000 * um); });
        worst = std::max(worst, worst_of(tristimulus(wavelengths, reflectance, c.illuminant), c.reference));
    }
    check_at_most("XYZ against sums at 1 nm", worst, hts::accuracy::tristimulus);
}

TEST_CASE("the weights integrate the stated product exactly on an irregular grid", "[colour]") {
    const std::vector<double> coarse = {0.3,   0.3999, 0.4,  0.4123, 0.47, 0.4701,
                                        0.555, 0.6,    0.61, 0.7,    0.77, 0.9};
    const std::vector<double> values = {9, 0.3, 0.1, 0.8, 0.2, 0.9, 0, 1, 0.4, 0.7, 0.1, 5};
    for (const Illuminant illuminant : both) {
        const Xyz colour = tristimulus(coarse, values, illuminant);

        // The same straight lines, sampled at more points.
        std::vector<double> fine = grid(0.31, 0.89, 997);
        fine.insert(fine.end(), coarse.begin(), coarse.end());
        std::sort(fine.begin(), fine.end());
        fine.erase(std::unique(fine.begin(), fine.end()), fine.end());
        const auto fine_values = sampled(fine, [&](double um) { return joined(coarse, values, um); });
        CHECK(worst_of(tristimulus(fine, fine_values, illuminant), colour) < 1e-13);

        // Midpoint sums over the rows of the table.
        Xyz sum{0, 0, 0};
        double white = 0;
        constexpr int steps = 1000;
        for (std::size_t i = 1; i < colour_rows.size(); ++i) {
            const double from = colour_rows[i - 1].wavelength();
            const auto at_node = [&](double um) {
                return relative_power(um, illuminant) * colour_matching(um);
            };
            const Xyz left = at_node(from), right = at_node(colour_rows[i].wavelength());
            for (int j = 0; j < steps; ++j) {
                const double t = (j + 0.5) / steps;
                const Xyz product = (1 - t) * left + t * right;
                white += product.Y;
                sum = sum + joined(coarse, values, from + 0.005 * t) * product;
            }
        }
        CHECK(worst_of(1 / white * sum, colour) < 1e-6);
    }
}

TEST_CASE("a colour is linear in its spectrum, and weights can be shared", "[colour]") {
    Random random{20241};
    const std::vector<double> wavelengths = grid(0.37, 0.79, 30);
    for (const Illuminant illuminant : both) {
        const TristimulusWeights weights = tristimulus_weights(wavelengths, illuminant);
        CHECK(weights.illuminant() == illuminant);
        CHECK(weights.weights().size() == wavelengths.size());
        Xyz total{0, 0, 0};
        for (const Xyz& w : weights.weights()) total = total + w;
        CHECK(worst_of(total, white_point(illuminant)) < 1e-13);

        const auto a = sampled(wavelengths, [&](double) { return random.uniform(0, 1); });
        const auto b = sampled(wavelengths, [&](double) { return random.uniform(0, 1); });
        std::vector<double> mixed;
        for (std::size_t i = 0; i < a.size(); ++i) mixed.push_back(0.3 * a[i] - 2 * b[i]);
        CHECK(worst_of(weights(mixed), 0.3 * weights(a) + -2 * weights(b)) < 1e-14);
        CHECK(worst_of(weights(a), tristimulus(wavelengths, a, illuminant)) == 0);
    }
}

TEST_CASE("end values are held, and what lies beyond the least coverage is small", "[colour]") {
    const std::vector<double> visible = grid(0.4, 0.7, 31), wide = grid(0.3, 0.9, 61);
    const auto slope = [](double um) { return std::clamp((um - 0.4) / 0.3, 0., 1.); };
    const std::vector<double> steps = {0.36, 0.39999, 0.4, 0.7, 0.70001, 0.83};
    const std::vector<double> beyond = {1, 1, 0, 0, 1, 1};
    for (const Illuminant illuminant : both) {
        CHECK(worst_of(tristimulus(visible, sampled(visible, slope), illuminant),
                       tristimulus(wide, sampled(wide, slope), illuminant)) < 1e-13);
        const Xyz outside = tristimulus(steps, beyond, illuminant);
        const Xyz white = white_point(illuminant);
        CHECK(outside.X / white.X < 0.003);
        CHECK(outside.Y / white.Y < 0.0006);
        CHECK(outside.Z / white.Z < 0.006);
    }
}

TEST_CASE("the colour of a BRDF is that of pi times it", "[colour]") {
    const std::vector<double> wavelengths = grid(0.38, 0.78, 9);
    const TristimulusWeights weights = tristimulus_weights(wavelengths, Illuminant::D65);
    const std::vector<double> diffuser(wavelengths.size(), 1 / std::numbers::pi);
    CHECK(worst_of(weights.of_brdf(diffuser), white_point(Illuminant::D65)) < 1e-13);
    CHECK(weights.luminance_factor(diffuser) == Approx(1).epsilon(1e-13));
    const std::vector<double> gloss(wavelengths.size(), 25);
    CHECK(weights.luminance_factor(gloss) == Approx(25 * std::numbers::pi).epsilon(1e-13));
}

TEST_CASE("hue runs from blue over green to red as a band moves to long wavelengths", "[colour]") {
    for (const Illuminant illuminant : both) {
        const Chromaticity white = chromaticity(white_point(illuminant));
        for (int nm = 440; nm < 640; nm += 5) {
            const Chromaticity a = chromaticity(band(nm, illuminant)),
                               b = chromaticity(band(nm + 5, illuminant));
            INFO(nm);
            CHECK((a.x - white.x) * (b.y - white.y) < (a.y - white.y) * (b.x - white.x));  // clockwise
        }
    }
}

// ---- failures

TEST_CASE("what has no colour is refused with the reason", "[colour]") {
    const auto weights = [](std::vector<double> um) { return tristimulus_weights(um, Illuminant::E); };
    CHECK_THROWS_MATCHES(illuminant_named("F2"), hts::Error,
                         Message("illuminant \"F2\": must be one of E, D65"));
    CHECK_THROWS_MATCHES(illuminant_named("d65"), hts::Error,
                         Message("illuminant \"d65\": must be one of E, D65"));
    CHECK_THROWS_MATCHES(weights({}), hts::Error,
                         Message("number of wavelengths 0: must be at least 2 for a colour"));
    CHECK_THROWS_MATCHES(weights({0.55}), hts::Error,
                         Message("number of wavelengths 1: must be at least 2 for a colour"));
    CHECK_THROWS_MATCHES(weights({0.38, 0.6, 0.5, 0.78}), hts::Error,
                         Message("wavelength 0.5 um: must be above the one before it, 0.6 um"));
    CHECK_THROWS_MATCHES(weights({0.38, 0.6, 0.6, 0.78}), hts::Error,
                         Message("wavelength 0.6 um: must be above the one before it, 0.6 um"));
    CHECK_THROWS_MATCHES(weights({0.38, std::nan(""), 0.78}), hts::Error,
                         Message("wavelength nan um: must be finite"));
    CHECK_THROWS_MATCHES(weights({0.41, 0.78}), hts::Error,
                         Message("wavelengths 0.41 to 0.78 um: must cover 0.4 to 0.7 um for a colour"));
    CHECK_THROWS_MATCHES(weights({0.38, 0.69}), hts::Error,
                         Message("wavelengths 0.38 to 0.69 um: must cover 0.4 to 0.7 um for a colour"));
    CHECK_THROWS_MATCHES(weights({380, 780}), hts::Error,
                         Message("wavelengths 380 to 780 um: must cover 0.4 to 0.7 um for a colour"));
    const std::vector<double> two = {0.5, 0.5};
    CHECK_THROWS_MATCHES(weights({0.38, 0.5, 0.78})(two), hts::Error,
                         Message("number of spectral values 2: must be 3, the number of wavelengths"));
}

TEST_CASE("illuminants go by their names", "[colour]") {
    for (const Illuminant illuminant : both) CHECK(illuminant_named(name(illuminant)) == illuminant);
    const std::vector<double> nearly = {0.4 + 1e-16, 0.5, 0.7 - 1e-15};
    CHECK_NOTHROW(tristimulus_weights(nearly, Illuminant::D65));
}
