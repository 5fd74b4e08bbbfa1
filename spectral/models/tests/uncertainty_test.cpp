#include "spectral/models/uncertainty.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <numbers>

#include "hts/correlation/kept_tables.hpp"
#include "hts/sampling/random.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace hts;
using namespace hts::spectral;

UncertainMaterial material(const std::string& text, const std::vector<UncertainNumber>& given = {}) {
    return {text, "m.json", given};
}

const auto green = WavelengthGrid::from_micrometres({0.55, 0.8});
const DirectionPair off_mirror{Direction::from_degrees(40, 0), Direction::from_degrees(55, 170)};
const DirectionPair near_mirror{Direction::from_degrees(20, 0), Direction::from_degrees(22, 180)};

/// A number of standard normal distribution.
double normal(Random& random) {
    return std::sqrt(-2 * std::log1p(-random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
}

/// Lower triangle of Cholesky's, row by row.
std::vector<double> root(const std::vector<double>& matrix, std::size_t n) {
    std::vector<double> l(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = matrix[i * n + j];
            for (std::size_t k = 0; k < j; ++k) rest -= l[i * n + k] * l[j * n + k];
            l[i * n + j] = i == j ? std::sqrt(rest) : rest / l[j * n + j];
        }
    }
    return l;
}

/// Standard deviations of BRDF and specular reflectance over materials whose numbers are drawn.
std::array<double, 2> drawn(const UncertainMaterial& of, const DirectionPair& pair, int draws) {
    const std::size_t count = of.numbers().size();
    const auto l = root(of.correlations(), count);
    Random random{5};
    double sums[2]{}, squares[2]{};
    for (int k = 0; k < draws; ++k) {
        std::vector<double> u(count), off(count);
        for (double& each : u) each = normal(random);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j <= i; ++j) off[i] += l[i * count + j] * u[j];
            off[i] *= of.numbers()[i].standard_deviation;
        }
        const Reflectance reflectance = of.with(off).at(green);
        double values[2]{reflectance.brdf(pair)[0], reflectance.specular_reflectance(pair.in)[0].value()};
        for (int q = 0; q < 2; ++q) {
            sums[q] += values[q] / draws;
            squares[q] += values[q] * values[q] / draws;
        }
    }
    return {std::sqrt(squares[0] - sums[0] * sums[0]), std::sqrt(squares[1] - sums[1] * sums[1])};
}

void check_draws(const char* title, const std::string& text, const DirectionPair& pair, int draws,
                 double allowed) {
    const UncertainMaterial uncertain = material(text);
    const UncertainReflectance reflectance = uncertain.at(green);
    std::vector<double> brdf(2), specular(2);
    reflectance.brdf(pair, brdf);
    reflectance.specular_reflectance(pair.in, specular);
    const auto [brdf_drawn, specular_drawn] = drawn(uncertain, pair, draws);
    std::cout << title << ": brdf " << brdf[0] << ", of " << draws << " draws " << brdf_drawn << "; specular "
              << specular[0] << ", of draws " << specular_drawn << '\n';
    INFO(title);
    CHECK(brdf[0] == Approx(brdf_drawn).epsilon(allowed));
    // far below, the mirror term is an exponential of sigma_0^2, which no first order follows
    if (specular[0] > 1e-6) CHECK(specular[0] == Approx(specular_drawn).epsilon(allowed));
}

const std::string gaussian = R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
    "index": {"n": 0.77, "k": 6.08}, "diffuse_albedo": 0.1, "uncertainty": {"rms_roughness_um": 0.004,
    "correlation_length_um": 0.02, "n": 0.02, "k": 0.1, "diffuse_albedo": 0.003,
    "correlated": [["rms_roughness_um", "correlation_length_um", 0.7], ["n", "k", -0.4]]}})";

}  // namespace

TEST_CASE("uncertainties of a Gaussian surface are those of 10000 draws") {
    check_draws("beside the mirror direction", gaussian, off_mirror, 10'000, 0.03);
    check_draws("near the mirror direction", gaussian, near_mirror, 10'000, 0.03);
    check_draws("a smooth surface with a mirror term",
                R"({"model": "he", "rms_roughness_um": 0.03, "correlation_length_um": 1.77,
        "index": {"n": 1.5, "k": 0.1},
        "uncertainty": {"rms_roughness_um": 5e-4, "correlation_length_um": 0.02,
        "n": 0.01, "correlated": [["rms_roughness_um", "n", 0.5]]}})",
                near_mirror, 10'000, 0.03);
}

TEST_CASE("uncertainties of spectra, of the unified model and of other models are those of draws") {
    check_draws("smooth K-correlation",
                R"({"model": "he_unified", "rms_roughness_um": 0.01, "correlation": {"type": "k_correlation",
        "B_um": 5, "C": 2.5, "psd": "2d"}, "index": {"n": 1.5, "k": 0},
        "uncertainty": {"rms_roughness_um": 2e-4, "correlation/B_um": 0.1}})",
                off_mirror, 10'000, 0.03);
    check_draws("the unified model",
                R"({"model": "he_unified", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
        "index": {"n": 0.77, "k": 6.08}, "diffuse_albedo": 0.1, "uncertainty": {"rms_roughness_um": 0.004,
        "correlation_length_um": 0.02, "n": 0.02, "k": 0.1, "diffuse_albedo": 0.003,
        "correlated": [["rms_roughness_um", "correlation_length_um", 0.7]]}})",
                off_mirror, 10'000, 0.03);
    check_draws("a film",
                R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
        "index": {"n": 0.77, "k": 6.08}, "films": [{"index": {"n": 1.5, "k": 0}, "thickness_um": 0.05}],
        "uncertainty": {"rms_roughness_um": 0.004, "films/0/thickness_um": 0.002}})",
                off_mirror, 10'000, 0.03);
    check_draws("GGX",
                R"({"model": "walter", "distribution": "ggx", "alpha": 0.3, "index": {"n": 1.5, "k": 0},
        "uncertainty": {"alpha": 0.005, "n": 0.01}})",
                off_mirror, 10'000, 0.03);
    check_draws("a lobe of Kurt's",
                R"({"model": "kurt", "kd": 0.1, "lobes": [{"ks": 0.3, "f0": 0.5, "mx": 0.3,
        "my": 0.3, "alpha": 0.5}], "uncertainty": {"kd": 0.003, "lobes/0/ks": 0.01}})",
                off_mirror, 10'000, 0.03);
}

TEST_CASE("exact derivatives and differences say the same") {
    // without an effect on the surface, "films" of no thickness leave exact derivatives out of the way
    std::string with_film = gaussian;
    with_film.insert(with_film.find("\"index\""),
                     R"("films": [{"index": {"n": 1.3, "k": 0}, "thickness_um": 1e-9}], )");
    std::vector<double> exact(2), difference(2);
    for (const auto& pair : {off_mirror, near_mirror}) {
        material(gaussian).at(green).brdf(pair, exact);
        material(with_film).at(green).brdf(pair, difference);
        for (std::size_t i : {0U, 1U}) CHECK(difference[i] == Approx(exact[i]).epsilon(2e-3));
        material(gaussian).at(green).specular_reflectance(pair.in, exact);
        material(with_film).at(green).specular_reflectance(pair.in, difference);
        for (std::size_t i : {0U, 1U}) CHECK(difference[i] == Approx(exact[i]).epsilon(2e-2));
    }
}

TEST_CASE("the index of a built-in name is uncertain, too, and a bound is not crossed") {
    const std::string aluminium =
        R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": "Al"})";
    std::vector<double> by_n(2), by_k(2);
    material(aluminium, {{"n", 0.01}}).at(green).brdf(off_mirror, by_n);
    material(aluminium, {{"k", 0.01}}).at(green).brdf(off_mirror, by_k);
    CHECK(by_n[0] > 2 * by_k[0]);
    const std::string unified =
        R"({"model": "he_unified", "rms_roughness_um": 0.28, "correlation_length_um": 1.77,
        "index": {"n": 1.5, "k": 0}, "diffuse_albedo": 0})";
    material(unified, {{"k", 0.01}, {"diffuse_albedo", 0.01}}).at(green).brdf(off_mirror, by_k);
    CHECK(by_k[0] == Approx(0.01 / std::numbers::pi).epsilon(0.05));
}

namespace {

/// A material of a tabulated spectrum that falls as f^-3, each row with an error relative to it.
std::string tabulated(const std::vector<double>& relative, double factor_of_row = 1, std::size_t row = 0) {
    std::string rows;
    for (std::size_t i = 0; i < relative.size(); ++i) {
        const double f = 0.05 * std::pow(1.6, static_cast<double>(i));
        const double s = 2e-3 / (1 + std::pow(f / 0.2, 3)) * (i == row ? factor_of_row : 1);
        rows += (i == 0 ? "[" : ", [") + shortest(f) + ", " + shortest(s) + ", " + shortest(relative[i] * s) +
                "]";
    }
    return R"({"model": "he", "correlation": {"type": "psd", "psd": "2d", "table": [)" + rows +
           R"(]}, "index": {"n": 1.5, "k": 0}})";
}

}  // namespace

TEST_CASE("errors of a tabulated spectrum, row by row, are those of the reflectance") {
    std::vector<double> relative(11);
    std::vector<double> deviation(2);
    double squares = 0;
    for (const std::size_t row : {2U, 7U}) {
        relative.assign(11, 0);
        relative[row] = 0.1;
        const auto uncertain = material(tabulated(relative));
        REQUIRE(uncertain.numbers().size() == 1);
        uncertain.at(green).brdf(off_mirror, deviation);
        const auto value = [&](double factor) {
            return material_from_text(tabulated(relative, factor, row), "m.json")
                .at(green, {.tolerance = Tolerance{1e-9}})
                .brdf(off_mirror)[0];
        };
        CHECK(deviation[0] == Approx(std::abs(value(1.025) - value(0.975)) * 2).epsilon(1e-6));
        squares += deviation[0] * deviation[0];
    }
    // independent: the squares add up
    relative[2] = 0.1;
    material(tabulated(relative)).at(green).brdf(off_mirror, deviation);
    CHECK(deviation[0] == Approx(std::sqrt(squares)).epsilon(1e-9));
}

TEST_CASE("shapes that are changed by a part of an error leave no tables behind") {
    const testing::TemporaryFolder place;
    keep_correlation_tables_in(place.path());
    const struct Off {
        ~Off() { keep_correlation_tables_in({}); }
    } off;
    std::vector<double> relative(11);
    relative[3] = relative[8] = 0.07, relative[5] = 0.03;
    const std::string k_correlation = R"({"model": "he_unified", "rms_roughness_um": 0.1,
        "correlation": {"type": "k_correlation", "B_um": 5, "C": 2.345, "psd": "2d"},
        "index": {"n": 1.5, "k": 0}, "uncertainty": {"correlation/B_um": 0.1, "correlation/C": 0.05}})";
    std::vector<double> deviation(2);
    std::size_t own = 0;
    for (const std::string& text : {tabulated(relative, 1.03, 4), k_correlation}) {
        material(text).at(green).brdf(off_mirror, deviation);
        CHECK(deviation[0] > 0);
        CHECK(place.size() == ++own);  // that of the material itself
    }
}

TEST_CASE("errors of a tabulated spectrum are those of draws", "[.][exhaustive]") {
    // A deviation of N draws is itself known to 1/sqrt(2 N), more where values are skewed: three of these.
    // Errors of 5 % keep what is beyond first order far below.
    constexpr int draws = 400;
    const double allowed = 3 / std::sqrt(2. * draws);
    const std::string text = tabulated(std::vector<double>(11, 0.05));
    check_draws("spectrum in 11 rows, beside the mirror direction", text, off_mirror, draws, allowed);
    check_draws("spectrum in 11 rows, near the mirror direction", text, near_mirror, draws, allowed);
}

TEST_CASE("many rows of a spectrum are changed in bands, with the same effect", "[.][exhaustive]") {
    // every row twice as often, each with an error as much greater as one row's share is smaller
    const auto many = [](std::size_t rows, double relative) {
        std::string text;
        for (std::size_t i = 0; i < rows; ++i) {
            const double f = 0.05 * std::pow(100, static_cast<double>(i) / static_cast<double>(rows - 1));
            const double s = 2e-3 / (1 + std::pow(f / 0.2, 3));
            text += (i == 0 ? "[" : ", [") + shortest(f) + ", " + shortest(s) + ", " +
                    shortest(relative * s) + "]";
        }
        return R"({"model": "he", "correlation": {"type": "psd", "psd": "2d", "table": [)" + text +
               R"(]}, "index": {"n": 1.5, "k": 0}})";
    };
    const auto few = material(many(33, 0.05)), lots = material(many(161, 0.05 * std::sqrt(5)));
    CHECK(few.numbers().size() == 33);
    CHECK(lots.numbers().size() == 32);
    std::vector<double> of_few(2), of_lots(2);
    few.at(green).brdf(off_mirror, of_few);
    lots.at(green).brdf(off_mirror, of_lots);
    CHECK(of_lots[0] == Approx(of_few[0]).epsilon(0.2));
}

TEST_CASE("what cannot be uncertain is refused by name") {
    const auto refuses = [](const std::string& text, const std::string& message,
                            const std::vector<UncertainNumber>& given = {}) {
        INFO(text);
        CHECK_THROWS_WITH(material(text, given), Catch::Contains(message));
    };
    const auto with = [](const std::string& key) {
        return R"({"model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": "Al",
            "uncertainty": )" +
               key + "}";
    };
    refuses(with("{}"), R"(m.json: key "uncertainty": missing, or without a standard deviation)");
    refuses(with("3"), "must be an object");
    refuses(with(R"({"rms_roughness": 0.01})"),
            R"("uncertainty.rms_roughness": must name a number of the material)");
    refuses(with(R"({"rms_roughness_um": 0})"),
            R"("uncertainty.rms_roughness_um": 0: a standard deviation must be > 0)");
    refuses(with(R"({"rms_roughness_um": "much"})"), "must be a number, not a string");
    refuses(with(R"({"n": 0.1, "correlated": [["n", "k", 0.5]]})"),
            "must name two numbers that have a standard");
    refuses(with(R"({"n": 0.1, "k": 0.1, "correlated": [["n", "k", 1.5]]})"), "1.5: must be from -1 to 1");
    refuses(with(R"({"n": 0.1, "k": 0.1, "rms_roughness_um": 0.1, "correlated": [["n", "k", 0.9],
        ["n", "rms_roughness_um", 0.9], ["k", "rms_roughness_um", -0.9]]})"),
            "no errors have all these correlations");
    refuses(gaussian, "tau: must name a number", {{"tau", 0.1}});
    refuses(gaussian, "n: standard deviation -1: must be > 0", {{"n", -1}});
    const std::string walter = R"({"model": "walter", "distribution": "ggx", "alpha": 0.3, "index": "Al"})";
    CHECK_THROWS_WITH(material(walter, {{"n", 0.1}}).at(green),
                      Catch::Contains("must be {\"n\": …, \"k\": …}"));
}
