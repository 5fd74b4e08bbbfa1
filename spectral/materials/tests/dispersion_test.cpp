#include "spectral/materials/dispersion.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "spectral/text/csv.hpp"

using hts::spectral::ConstantValue;
using hts::spectral::CsvTable;
using hts::spectral::Dispersion;
using hts::spectral::DispersionFormula;
using hts::spectral::PiecewiseLinear;
using hts::spectral::WavelengthRange;

namespace {

constexpr WavelengthRange wide{0.1, 20};

std::vector<double> numbers(const std::string& text) {
    std::istringstream stream{text};
    return {std::istream_iterator<double>{stream}, {}};
}

DispersionFormula formula(int number, const std::string& coefficients) {
    return {number, numbers(coefficients), wide};
}

}  // namespace

TEST_CASE("all nine dispersion formulas agree with 50 digits") {
    const auto table = CsvTable::read(HTS_SOURCE_DIR "/spectral/materials/tests/reference/dispersion.csv");
    hts::testing::WorstCase relative{"dispersion formulas, relative", hts::spectral::accuracy::dispersion};
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const int number = static_cast<int>(table.number(row, 0));
        const double um = table.number(row, 2);
        const double computed = formula(number, table.text(row, 1))(um);
        relative.note(hts::testing::relative_error(computed, table.number(row, 3)),
                      [&] { return "formula " + table.text(row, 0) + " at " + table.text(row, 2) + " um"; });
    }
    relative.check();
}

TEST_CASE("published indices come out") {
    // N-BK7 n_d of the SCHOTT data sheet; fused silica [Malitson 1965, Table I]; sapphire, ordinary ray
    // [Malitson and Dodge 1972]; SCHOTT's n_F, n_C.
    const auto glass =
        formula(2, "0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653");
    CHECK(glass(0.5875618) == Approx(1.51680).margin(5e-6));
    CHECK(glass(0.4861327) == Approx(1.52238).margin(5e-6));
    CHECK(glass(0.6562725) == Approx(1.51432).margin(5e-6));
    const auto silica = formula(1, "0 0.6961663 0.0684043 0.4079426 0.1162414 0.8974794 9.896161");
    CHECK(silica(0.587561) == Approx(1.458464).margin(6e-6));
    const auto sapphire = formula(1, "0 1.4313493 0.0726631 0.65054713 0.1193242 5.3414021 18.028251");
    CHECK(sapphire(0.5893) == Approx(1.7681).margin(1e-4));
    CHECK(formula(2, "0 1.1819 0.011313")(0.5876) == Approx(1.491).margin(1e-3));
}

TEST_CASE("formulas at a wavelength where the sum can be done by hand") {
    // At 2 um: l^2 = 4.
    CHECK(formula(1, "1 3 1")(2) == Approx(std::sqrt(6.0)).epsilon(1e-15));              // 1 + 1 + 3 * 4/3
    CHECK(formula(2, "1 3 1 2 2")(2) == Approx(std::sqrt(10.0)).epsilon(1e-15));         // 1 + 1 + 4 + 4
    CHECK(formula(3, "1 3 2 4 -1")(2) == Approx(std::sqrt(15.0)).epsilon(1e-15));        // 1 + 12 + 2
    CHECK(formula(4, "1 3 1 1 2")(2) == Approx(std::sqrt(3.0)).epsilon(1e-15));          // 1 + 6/3
    CHECK(formula(4, "1 0 0 0 0 3 1 2 0")(2) == Approx(std::sqrt(3.0)).epsilon(1e-15));  // 1 + 6/(4 - 1)
    CHECK(formula(5, "1 3 1 4 -2")(2) == 8);                                             // 1 + 6 + 1
    CHECK(formula(6, "1 3 1.25")(2) == 5);               // 1 + 1 + 3/(5/4 - 1/4)
    CHECK(formula(7, "1 0 0 2 3 4")(2) == 313);          // 1 + 8 + 48 + 256
    CHECK(formula(8, "0.125 0.125 2 0.03125")(2) == 2);  // (n^2 - 1)/(n^2 + 2) = 1/8 + 1/4 + 1/8
    CHECK(formula(9, "1 3 1 2 1 1")(2) == Approx(std::sqrt(3.0)).epsilon(1e-15));  // 1 + 3/3 + 2 * 1/2
}

TEST_CASE("a term without leading coefficient is absent, even where its denominator is 0") {
    // C9 = 1, C8 = 0 as the database writes an absent term, and denominators that vanish at 1 um.
    CHECK(formula(4, "2.25 0 0 0 1 0 0 0 1")(1) == 1.5);
    CHECK(formula(4, "2.25 0 0 1 1 0 0 0 0")(1) == 1.5);
    CHECK(formula(1, "1.25 0 1")(1) == 1.5);
    CHECK(formula(2, "1.25 0 1")(1) == 1.5);
    CHECK(formula(6, "0.5 0 1")(1) == 1.5);
    CHECK(formula(8, "0.25 0 1")(1) == Approx(std::sqrt(2.0)).epsilon(1e-15));
    CHECK(formula(9, "2.25 0 1 0 1 0")(1) == 1.5);
    // A leading coefficient with 0^1 in the denominator: 3 l / l^2.
    CHECK(formula(4, "1 3 1 0 1")(2) == Approx(std::sqrt(2.5)).epsilon(1e-15));
}

TEST_CASE("terms at the end may be left out, but no part of a term") {
    CHECK(formula(3, "2.25")(0.5) == 1.5);
    CHECK(formula(3, "1.25 1 0")(0.5) == 1.5);  // 1 l^0
    CHECK(formula(5, "1.5")(0.5) == 1.5);
    // the first counts that are no whole number of terms
    const std::pair<int, std::size_t> cut[]{{1, 0}, {1, 2}, {2, 4}, {3, 6}, {4, 2}, {4, 4}, {4, 8}, {4, 10},
                                            {5, 2}, {6, 4}, {7, 0}, {8, 2}, {9, 2}, {9, 4}, {9, 5}};
    for (const auto& [number, count] : cut) {
        std::string coefficients;
        for (std::size_t i = 0; i < count; ++i) coefficients += " 1";
        CHECK_THROWS_WITH(formula(number, coefficients), "formula " + std::to_string(number) + " with " +
                                                             std::to_string(count) + " coefficients: C" +
                                                             std::to_string(count + 1) +
                                                             " is missing: must end with a whole term");
    }
    CHECK(formula(7, "1.5")(0.5) == 1.5);
    CHECK(formula(7, "1.5 0 0 0 0 0 0 0")(0.5) == 1.5);  // zeros beyond the sixth do no harm
}

TEST_CASE("sums over pairs take more pairs than the database has") {
    std::string coefficients = "0";
    for (int pair = 0; pair < 20; ++pair) coefficients += " 0.1 0";
    CHECK(formula(1, coefficients)(1) == Approx(std::sqrt(3.0)).epsilon(1e-14));
}

TEST_CASE("a formula without a real value gives NaN") {
    CHECK(std::isnan(formula(3, "-1")(0.5)));
    CHECK(std::isnan(formula(1, "0 5 10")(9)));
    CHECK(std::isnan(formula(8, "2")(0.5)));
}

TEST_CASE("formulas that cannot be are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(formula(0, "1"), "dispersion formula 0: must be from 1 to 9");
    CHECK_THROWS_WITH(formula(10, "1"), "dispersion formula 10: must be from 1 to 9");
    CHECK_THROWS_WITH(formula(7, "1 1 1 1 1 1 1"), "formula 7 with 7 coefficients: must be at most 6");
    CHECK_THROWS_WITH(formula(8, "1 1 1 1 1"), "formula 8 with 5 coefficients: must be at most 4");
    CHECK_THROWS_WITH((DispersionFormula{5, {1, nan, 1}, wide}), "coefficient C2 nan: must be finite");
    CHECK_THROWS_WITH((DispersionFormula{5, {1}, {2, 1}}),
                      "end of the wavelength range 1 um: must be >= its beginning, 2 um");
    CHECK_THROWS_WITH((DispersionFormula{5, {1}, {0, 1}}),
                      "wavelength 0 um: must be > 0 (from 1e-24 to 1e+24 um)");
    CHECK_THROWS_AS((DispersionFormula{5, {1}, {1, nan}}), hts::Error);
}

TEST_CASE("every kind of curve tells its range and values") {
    const Dispersion constant = ConstantValue{1.5};
    const Dispersion table = PiecewiseLinear{{{0.4, 1.0}, {0.5, 2.0}}};
    const Dispersion curve = formula(5, "1.5");
    CHECK(range_of(constant).contains(1e-9));
    CHECK(range_of(constant).contains(1e9));
    CHECK(value_at(constant, 0.5) == 1.5);
    CHECK(range_of(table).longest == 0.5);
    CHECK(value_at(table, 0.4) == 1.0);
    CHECK(range_of(curve).longest == 20);
    CHECK(value_at(curve, 0.4) == 1.5);
}
