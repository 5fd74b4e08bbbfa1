#include "validation/scattering/gaussian_surface.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

using namespace hts::validation;

namespace {

constexpr double sigma = 0.3, tau = 2;

/// Mean of a product over many profiles with its standard error.
struct Estimate {
    double value, error;
};
Estimate over_profiles(const std::function<double(const RandomProfile&)>& quantity) {
    constexpr int count = 200;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double one =
            quantity(random_profile({sigma, tau}, 0.25, 512, seed_of(1, 1, static_cast<std::uint64_t>(i))));
        sum += one;
        squares += one * one;
    }
    const double mean = sum / count;
    return {mean, std::sqrt((squares / count - mean * mean) / (count - 1))};
}

double mean_product(const std::vector<double>& a, const std::vector<double>& b, std::size_t apart) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[(i + apart) % b.size()];
    return sum / static_cast<double>(a.size());
}

void check_is(const Estimate& found, double expected) {
    INFO(found.value << " +- " << found.error << ", expected " << expected);
    CHECK(std::fabs(found.value - expected) < 4 * found.error);
    CHECK(found.error < 0.02 * sigma * sigma);
}

}  // namespace

TEST_CASE("random profiles have the heights, the autocorrelation and the slopes they ought to") {
    for (const std::size_t apart : {0U, 2U, 6U, 8U, 16U}) {
        const double x = 0.25 * static_cast<double>(apart) / tau;
        check_is(
            over_profiles([=](const RandomProfile& p) { return mean_product(p.height, p.height, apart); }),
            sigma * sigma * std::exp(-x * x));
        // <z z'> = sigma^2 C'(x) and <z' z'> = -sigma^2 C''(x)
        check_is(
            over_profiles([=](const RandomProfile& p) { return mean_product(p.height, p.slope, apart); }),
            -sigma * sigma * 2 * x / tau * std::exp(-x * x));
        check_is(over_profiles([=](const RandomProfile& p) { return mean_product(p.slope, p.slope, apart); }),
                 sigma * sigma * (2 - 4 * x * x) / (tau * tau) * std::exp(-x * x));
    }
    check_is(
        over_profiles([](const RandomProfile& p) { return mean_product(p.height, p.second_derivative, 0); }),
        -2 * sigma * sigma / (tau * tau));
}

TEST_CASE("K-correlated profiles have the spectrum they ought to, cut where it is") {
    using boost::math::quadrature::gauss_kronrod;
    const double pi = std::numbers::pi;
    for (const double nu : {0.5, 1.5}) {
        const RoughnessStatistics of{0.1, 0.7, nu};
        const auto spectrum = [&of, nu, pi](double f) {
            const double scaled = 2 * pi * f * of.correlation_length;
            return std::pow(1 + scaled * scaled, -nu - 0.5);
        };
        const auto integral = [&](const auto& factor) {
            return gauss_kronrod<double, 61>::integrate([&](double f) { return spectrum(f) * factor(f); },
                                                        0.0, most_frequency, 15, 1e-12);
        };
        const double all = integral([](double) { return 1; });
        const auto correlation = profile_correlation(of, 1.0 / 16, 4096);
        CHECK(correlation.size() == 2049);
        CHECK(correlation[0] == Approx(1).epsilon(1e-12));
        for (const std::size_t lag : {1U, 5U, 16U, 40U}) {
            const double x = static_cast<double>(lag) / 16;
            const double expected = integral([=](double f) { return std::cos(2 * pi * f * x); }) / all;
            CHECK(std::fabs(correlation[lag] - expected) < 2e-3);  // its period is finite
        }
        double heights = 0, slopes = 0, apart = 0;
        constexpr int count = 200;
        for (int i = 0; i < count; ++i) {
            const auto p = random_profile(of, 1.0 / 16, 1024, seed_of(5, 1, static_cast<std::uint64_t>(i)));
            heights += mean_product(p.height, p.height, 0) / count;
            slopes += mean_product(p.slope, p.slope, 0) / count;
            apart += mean_product(p.height, p.height, 8) / count;
        }
        const double variance = of.rms_roughness * of.rms_roughness;
        CHECK(heights == Approx(variance).epsilon(0.03));
        CHECK(apart == Approx(variance * correlation[8]).epsilon(0.06));
        const double square_slope = variance * integral([=](double f) { return 4 * pi * pi * f * f; }) / all;
        CHECK(slopes == Approx(square_slope).epsilon(0.03));
    }
    CHECK_THROWS_WITH(random_field({0.1, 1, 0.5}, 0.25, 64, 1),
                      "a random field: must be of a Gaussian correlation");
}

TEST_CASE("derivatives of random surfaces are those of their heights") {
    const double h = 0.05;
    const RandomProfile p = random_profile({sigma, tau}, h, 2000, 3);
    const RandomField f = random_field({sigma, tau}, h, 300, 3);
    double worst = 0;
    for (std::size_t i = 2; i + 2 < p.height.size(); ++i) {
        const auto slope = [&](const std::vector<double>& z) {
            return (8 * (z[i + 1] - z[i - 1]) - (z[i + 2] - z[i - 2])) / (12 * h);
        };
        worst = std::fmax(worst, std::fabs(slope(p.height) - p.slope[i]));
        worst = std::fmax(worst, std::fabs(slope(p.slope) - p.second_derivative[i]));
    }
    for (std::size_t j = 2; j + 2 < f.samples; ++j) {
        for (std::size_t i = 2; i + 2 < f.samples; ++i) {
            const auto slope = [&](std::size_t apart) {
                const double* z = f.height.data() + j * f.samples + i;
                return (8 * (z[apart] - *(z - apart)) - (z[2 * apart] - *(z - 2 * apart))) / (12 * h);
            };
            worst = std::fmax(worst, std::fabs(slope(1) - f.slope_x[j * f.samples + i]));
            worst = std::fmax(worst, std::fabs(slope(f.samples) - f.slope_y[j * f.samples + i]));
        }
    }
    CHECK(worst > 0);
    CHECK(worst < 1e-4);
}

TEST_CASE("random fields are isotropic, with the rms height and slopes they ought to have") {
    double heights = 0, along = 0, across = 0, diagonal = 0;
    constexpr int count = 60;
    for (int s = 0; s < count; ++s) {
        const RandomField f =
            random_field({sigma, tau}, 0.5, 64, seed_of(2, 1, static_cast<std::uint64_t>(s)));
        const auto n = static_cast<double>(f.height.size());
        for (std::size_t i = 0; i < f.height.size(); ++i) {
            heights += f.height[i] * f.height[i] / n / count;
            along += f.slope_x[i] * f.slope_x[i] / n / count;
            across += f.slope_y[i] * f.slope_y[i] / n / count;
            const std::size_t j = i / 64, next = (j + 2) % 64 * 64 + (i + 2) % 64;  // (1, 1) away
            diagonal += f.height[i] * f.height[next] / n / count;
        }
    }
    // some 256 independent patches a field
    CHECK(heights == Approx(sigma * sigma).epsilon(0.04));
    CHECK(along == Approx(2 * sigma * sigma / (tau * tau)).epsilon(0.04));
    CHECK(across == Approx(2 * sigma * sigma / (tau * tau)).epsilon(0.04));
    CHECK(diagonal == Approx(sigma * sigma * std::exp(-0.5)).epsilon(0.05));
}

TEST_CASE("seeds differ by study, part and realisation") {
    std::set<std::uint64_t> seeds;
    for (std::uint64_t a = 0; a < 10; ++a) {
        for (std::uint64_t b = 0; b < 10; ++b) {
            for (std::uint64_t c = 0; c < 10; ++c) seeds.insert(seed_of(a, b, c));
        }
    }
    CHECK(seeds.size() == 1000);
}
