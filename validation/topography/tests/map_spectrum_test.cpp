#include "validation/topography/map_spectrum.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "hts/sampling/random.hpp"
#include "validation/topography/autocorrelation.hpp"
#include "validation/topography/map_statistics.hpp"
#include "validation/topography/spectrum_fit.hpp"

using namespace hts::validation;

namespace {

constexpr double pi = std::numbers::pi;

template <class Height>
HeightMap map_of(std::size_t columns, std::size_t rows, double step_x, double step_y, const Height& height) {
    std::vector<double> heights;
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i)
            heights.push_back(height(static_cast<double>(i) * step_x, -static_cast<double>(j) * step_y));
    }
    return {"map", columns, rows, step_x, step_y, heights};
}

}  // namespace

TEST_CASE("the power spectrum of a wave stands at its frequency and holds its mean square") {
    // 6 waves across, 4 upwards
    const auto map = map_of(60, 48, 0.5, 0.25, [](double x, double y) {
        return 0.3 * std::cos(2 * pi * (6 * x / 30 + 4 * y / 12));
    });
    const MapSpectrum spectrum = spectrum_of(map, MapWindow{map, Window::none});
    CHECK(spectrum.variance() == Approx(0.045).epsilon(1e-12));
    double at_wave = 0;
    for (std::size_t j = 0; j < spectrum.rows; ++j) {
        for (std::size_t i = 0; i < spectrum.columns; ++i) {
            const double x = spectrum.frequency_x(i), y = spectrum.frequency_y(j);
            if (std::fabs(x * y - 6. / 30 * 4 / 12) < 1e-9 && std::fabs(std::fabs(x) - 0.2) < 1e-9)
                at_wave += spectrum.power[j * spectrum.columns + i] * spectrum.cell();
        }
    }
    CHECK(at_wave == Approx(0.045).epsilon(1e-12));
    const ProfileSpectrum along = profile_spectrum(spectrum, true);
    double sum = 0;
    for (std::size_t i = 0; i < along.frequency.size(); ++i) sum += along.power[i] * spectrum.cell_x;
    CHECK(sum == Approx(0.045).epsilon(1e-12));
    CHECK(along.frequency[5] == Approx(0.2));
    CHECK(along.power[5] * spectrum.cell_x == Approx(0.045).epsilon(1e-12));
}

TEST_CASE(
    "whatever the window, the spectrum holds the mean square of the heights, and gaps have no part in it") {
    hts::Random random{5};
    const auto map = map_of(40, 36, 1, 1, [&](double, double) {
        const double z = random.uniform(-1, 1);
        return random.uniform() < 0.1 ? std::nan("") : z;
    });
    double sum = 0, squares = 0;
    for (const double z : map.heights()) {
        if (std::isnan(z)) continue;
        sum += z;
        squares += z * z;
    }
    const auto count = static_cast<double>(map.value_count());
    const double variance = squares / count - sum * sum / (count * count);
    for (const Window kind : {Window::hann, Window::none})
        CHECK(spectrum_of(map, MapWindow{map, kind}).variance() == Approx(variance).epsilon(1e-12));
    const auto whole = map_of(400, 300, 1, 1, [](double x, double) { return std::sin(x); });
    CHECK(MapWindow(whole, Window::hann).inflation == Approx(1.9444 * 1.9444).epsilon(1e-4));
}

TEST_CASE(
    "the autocorrelation is the mean over pairs of points, and lags join what the window lets through") {
    hts::Random random{6};
    const auto map = map_of(24, 20, 1, 1, [&](double x, double y) {
        return random.uniform() < 0.05 ? std::nan("")
                                       : std::sin(0.7 * x) + std::cos(0.4 * y) + random.uniform(-1, 1);
    });
    const Autocorrelation found = autocorrelation_of(map);
    // by pairs, at distance 1 and those that round to it: (1, 0), (0, 1), (1, 1)
    double products = 0, pairs = 0, squares = 0, mean = 0;
    for (const double z : map.heights())
        mean += std::isnan(z) ? 0 : z / static_cast<double>(map.value_count());
    for (std::ptrdiff_t j = 0; j < 20; ++j) {
        for (std::ptrdiff_t i = 0; i < 24; ++i) {
            const auto at = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
                return x < 0 || y < 0 || x >= 24 || y >= 20
                           ? std::nan("")
                           : map.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
            };
            const double z = at(i, j);
            if (std::isnan(z)) continue;
            squares += (z - mean) * (z - mean) / static_cast<double>(map.value_count());
            for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
                const double other = at(i + x, j + y);
                if (std::isnan(other)) continue;
                products += (z - mean) * (other - mean);
                ++pairs;
            }
        }
    }
    CHECK(found.value[0] == Approx(1).epsilon(1e-12));
    CHECK(found.value[1] == Approx(products / pairs / squares).epsilon(1e-9));

    const MapWindow window{map, Window::hann};
    double direct = 0, of_lags = 0;
    const double f = 0.21;
    for (std::size_t a = 0; a < window.weights.size(); ++a) {
        for (std::size_t b = 0; b < window.weights.size(); ++b) {
            const double r = std::hypot(static_cast<double>(a % 24) - static_cast<double>(b % 24),
                                        static_cast<double>(a / 24) - static_cast<double>(b / 24));
            direct += window.weights[a] * window.weights[b] * std::exp(-r / 3) * ::j0(2 * pi * f * r);
        }
    }
    for (const Lag& lag : window_lags(map, window))
        of_lags += lag.weight * std::exp(-lag.distance / 3) * ::j0(2 * pi * f * lag.distance);
    CHECK(of_lags == Approx(direct / window.squares).epsilon(1e-4));
}

TEST_CASE("an ellipse divides distances along its axis and multiplies frequencies") {
    const Ellipse ellipse{4, pi / 6};
    const double x = std::cos(pi / 6), y = std::sin(pi / 6);
    CHECK(ellipse.distance(3 * x, 3 * y) == Approx(1.5));
    CHECK(ellipse.distance(-3 * y, 3 * x) == Approx(6));
    CHECK(ellipse.frequency(3 * x, 3 * y) == Approx(6));
    CHECK(ellipse.frequency(-3 * y, 3 * x) == Approx(1.5));
}

TEST_CASE("spectra of the descriptions are transforms of their correlations and hold a variance of 1") {
    for (const RoughnessScales& scales : {RoughnessScales{{1, 2, HUGE_VAL}},
                                          {{1, 2, 0.5}},
                                          {{1, 0.8, 1.7}},
                                          {{0.7, 3, HUGE_VAL}, {0.3, 0.5, HUGE_VAL}}}) {
        for (const double f : {0.02, 0.1, 0.5}) {
            double sum = 0, below = 0;
            const double step = 0.002;
            for (double r = step / 2; r < 120; r += step)
                sum += correlation(scales, r) * ::j0(2 * pi * f * r) * 2 * pi * r * step;
            CHECK(sum == Approx(spectrum(scales, f)).epsilon(1e-3).margin(1e-4));
            for (double g = f / 2000; g < f; g += f / 1000)
                below += spectrum(scales, g) * 2 * pi * g * f / 1000;
            CHECK(below == Approx(share_below(scales, f)).epsilon(1e-5));
        }
        CHECK(share_below(scales, 1e9) == Approx(1).epsilon(1e-8));
    }
}

TEST_CASE("heights of independent points are Gaussian, cubes of them are not") {
    for (const bool cubed : {false, true}) {
        hts::Random random{7};
        const auto map = map_of(64, 64, 1, 1, [&](double, double) {
            double sum = -6;
            for (int k = 0; k < 12; ++k) sum += random.uniform();
            return cubed ? sum * sum * sum + sum * sum : sum;
        });
        const HeightStatistics found = statistics_of(map, autocorrelation_of(map));
        CHECK(found.gaussian() == !cubed);
        CHECK(found.skewness_error == Approx(std::sqrt(6 / 4096.)).epsilon(0.1));
    }
}
