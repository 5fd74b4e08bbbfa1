#include "spectral/energy/band.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "temporary_folder.hpp"

using Catch::Matchers::Contains;
using hts::spectral::Band;
using hts::spectral::PiecewiseLinear;
using hts::spectral::planck_shape;
using hts::spectral::WavelengthGrid;
using hts::testing::Random;
using hts::testing::WorstCase;

namespace {

/// Share of a black body's radiation below a wavelength, by the series of exp(-n x).
double share_below(double um, double kelvin) {
    const double x = 14387.76877 / (um * kelvin);
    double sum = 0;
    for (int n = 1; n <= 2000; ++n)
        sum += std::exp(-n * x) *
               (x * x * x / n + 3 * x * x / (n * n) + 6 * x / std::pow(n, 3) + 6 / std::pow(n, 4));
    return sum * 15 / std::pow(std::numbers::pi, 4);
}

double mean(const Band& band, const WavelengthGrid& grid, double (*value)(double)) {
    const auto weights = band.weights(grid);
    double sum = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) sum += weights[i] * value(grid.micrometres()[i]);
    return sum;
}

PiecewiseLinear triangle() {
    return PiecewiseLinear{{{3, 0}, {4, 2}, {6, 0}}};
}

}  // namespace

TEST_CASE("Band: Planck's law peaks where Wien says, and falls to nothing without a NaN") {
    const double peak = 2897.771955;  // um K, CODATA 2018
    for (const double kelvin : {3.0, 300.0, 5800.0}) {
        const double um = peak / kelvin;
        CHECK(planck_shape(um, kelvin) > planck_shape(um * 1.001, kelvin));
        CHECK(planck_shape(um, kelvin) > planck_shape(um * 0.999, kelvin));
    }
    CHECK(planck_shape(0.01, 10) == 0);
    CHECK(planck_shape(1e9, 300) > 0);
    CHECK(planck_shape(1e9, 300) < 1e-20);
}

TEST_CASE("Band: what a range holds of a black body's radiation") {
    WorstCase worst{"share of a black body's radiation", 1e-10};
    Random random{1};
    for (int i = 0; i < 200; ++i) {
        const double kelvin = random.logarithmic(50, 6000);
        const double first = random.logarithmic(300, 4000) / kelvin;
        const double last = first * random.logarithmic(1.01, 20);
        const double covered = Band{{}, kelvin}.covered(WavelengthGrid::from_micrometres({first, last}));
        worst.note(std::abs(covered - (share_below(last, kelvin) - share_below(first, kelvin))),
                   [&] { return std::to_string(kelvin) + " K"; });
    }
    worst.check();
    CHECK(Band{{}, 300}.covered(WavelengthGrid::from_micrometres({0.5, 5000})) == Approx(1).epsilon(1e-6));
}

TEST_CASE("Band: means of a constant, of a straight line and of what lies outside") {
    const auto one = [](double) { return 1.0; };
    const auto line = [](double um) { return 3 * um - 2; };
    const WavelengthGrid grid = WavelengthGrid::from_micrometres({2, 3.3, 5, 8}),
                         fine = WavelengthGrid::linear(2, 8, 301);
    for (const Band& band : {Band{triangle(), {}}, Band{triangle(), 500}, Band{{}, 500}}) {
        CHECK(mean(band, grid, one) == Approx(1).epsilon(1e-14));
        CHECK(mean(band, grid, line) == Approx(mean(band, fine, line)).epsilon(1e-9));
    }
    // the centre of a triangle is the mean of its corners
    CHECK(mean(Band{triangle(), {}}, grid, line) == Approx(3 * (3. + 4 + 6) / 3 - 2).epsilon(1e-12));
    CHECK(Band{triangle(), {}}.covered(grid) == Approx(1).epsilon(1e-12));
    CHECK(Band{triangle(), {}}.covered(WavelengthGrid::from_micrometres({4, 9})) ==
          Approx(2. / 3).epsilon(1e-10));
    CHECK(Band{triangle(), 400}.covered(WavelengthGrid::from_micrometres({7, 9})) == 0);
    // a response that is flat where there is light changes nothing
    const Band flat{PiecewiseLinear{{{1, 5}, {9, 5}}}, 700};
    CHECK(mean(flat, grid, line) == Approx(mean(Band{{}, 700}, grid, line)).epsilon(1e-12));
    // against a sum of many rectangles
    const Band both{triangle(), 650};
    double above = 0, below = 0;
    for (int i = 0; i < 300000; ++i) {
        const double um = 3 + 3 * (i + 0.5) / 300000;
        const double w = triangle()(um) * planck_shape(um, 650);
        above += w * line(um);
        below += w;
    }
    CHECK(mean(both, grid, line) == Approx(above / below).epsilon(1e-8));
}

TEST_CASE("Band: a response is read in either unit") {
    const hts::testing::TemporaryFolder folder;
    const auto um =
        hts::spectral::read_response(folder.write("um.csv", "wavelength_um,response\n0.4,0.5\n0.7,1\n"));
    const auto nm =
        hts::spectral::read_response(folder.write("nm.csv", "wavelength_nm;response\n400;0,5\n700;1\n"));
    for (const double at : {0.4, 0.55, 0.7}) CHECK(um(at) == nm(at));
    CHECK_THROWS_WITH(hts::spectral::read_response(folder.write("b.csv", "wavelength_nm,response\n-1,1\n")),
                      Contains("b.csv:2: column \"wavelength_nm\""));
}

TEST_CASE("Band: bad input is refused by name") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH((Band{{}, 0.0}), Contains("temperature 0 K: must be from 1 to 1e+06 K"));
    CHECK_THROWS_WITH((Band{{}, nan}), Contains("temperature"));
    CHECK_THROWS_WITH((Band{{}, {}}), Contains("must have a response or a temperature"));
    CHECK_THROWS_WITH((Band{PiecewiseLinear{{{1, 1}, {2, -1}}}, {}}), Contains("response -1: must be >= 0"));
    CHECK_THROWS_WITH((Band{PiecewiseLinear{{{1, 0}, {2, 0}}}, {}}), Contains("must be > 0 somewhere"));
    CHECK_THROWS_WITH((Band{{}, 300}.weights(WavelengthGrid::from_micrometres({10}))),
                      Contains("at least two"));
    CHECK_THROWS_WITH((Band{triangle(), {}}.weights(WavelengthGrid::from_micrometres({7, 8}))),
                      Contains("nothing of it lies at the wavelengths, 7 to 8 um"));
}
