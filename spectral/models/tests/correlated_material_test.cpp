#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/terms.hpp"
#include "hts/unified/unified_terms.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/material.hpp"

namespace hts::spectral {
namespace {

using testing::relative_error;
using testing::WorstCase;

double square(double x) {
    return x * x;
}

Material material(const std::string& keys, const std::string& model = "he") {
    return material_from_text(
        "{\"model\": \"" + model + "\", \"index\": {\"n\": 0.8, \"k\": 6}, " + keys + "}", "m.json");
}

const std::string polished =
    R"("rms_roughness_um": 0.003, "rms_band_um": [0.6328, "infinity"],
       "correlation": {"type": "k_correlation", "B_um": 5.02655, "C": 3, "psd": "2d"})";

double brdf(const Material& of, double wavelength, const DirectionPair& pair) {
    return of.at(Wavelength::from_micrometres(wavelength)).brdf(pair).front();
}

}  // namespace

TEST_CASE("Correlated material: the TIS of 3 nm over 0 to 1/632.8 nm at 300 nm is about 0.017") {
    const auto surface = *material(polished).properties().surface;
    // sigma^2 of all frequencies is that of the band over 1 - (1 + (B/lambda)^2)^(-1/2)
    const double b = 5.02655;
    const double share = 1 - 1 / std::sqrt(1 + square(b / 0.6328));
    CHECK(relative_error(square(surface.rms_roughness()), square(0.003) / share) < 1e-7);
    const double seen = surface.rms_roughness() * std::sqrt(surface.variance_share(0, 1 / 0.3));
    const double tis = -std::expm1(-square(4 * std::numbers::pi * seen / 0.3));
    CHECK(tis == Approx(0.017).margin(5e-4));
    // what the lobe scatters of it falls short only by the obliquity of large angles
    const auto silver = material_from_text(
        R"({"model": "he", "index": {"n": 0.001, "k": 1000}, )" + polished + "}", "m.json");
    const auto terms = silver.at(Wavelength::from_micrometres(0.3)).albedo(Direction::from_degrees(0, 0), 0);
    CHECK(terms.directional_diffuse == Approx(tis).epsilon(0.03));
}

TEST_CASE("Correlated material: both conventions of K-correlation are their integrals") {
    const double pi = std::numbers::pi, b = 4, c = 2.4, a = 1e-6;
    const auto integral = [&](double power, bool plane) {
        // in ln f by the trapezoidal rule
        double sum = 0;
        for (double log_f = -30; log_f < 90; log_f += 0.01) {
            const double f = std::exp(log_f);
            sum += 0.01 * a * std::exp(-power / 2 * std::log1p(square(b * f))) * f * (plane ? 2 * pi * f : 1);
        }
        return sum;
    };
    const auto rms = [&](const std::string& psd) {
        const auto read =
            material(R"("correlation": {"type": "k_correlation", "B_um": 4, "C": 2.4, "A": 1e-6, "psd": ")" +
                     psd + "\"}");
        return read.properties().surface->rms_roughness();
    };
    CHECK(relative_error(square(rms("1d one-sided")), integral(c, false)) < 1e-6);
    CHECK(relative_error(square(rms("2d")), integral(c, true)) < 1e-6);
    // the profile's spectrum is the integral over the other frequency of the surface's:
    // 4 times that over f_y > 0
    const auto surface =
        *material(R"("correlation": {"type": "k_correlation", "B_um": 4, "C": 2.4, "A": 1e-6, "psd": "1d )"
                  R"(one-sided"})")
             .properties()
             .surface;
    const auto density = [&](double f) {
        const double length = surface.correlation_length();
        return 2 * pi * square(surface.rms_roughness() * length) *
               std::exp(surface.correlation()->log_spectrum(2 * pi * f * length));
    };
    double profile = 0;
    for (double log_f = -30; log_f < 30; log_f += 0.01) {
        const double f = std::exp(log_f);
        profile += 4 * 0.01 * f * density(std::hypot(f, 0.2));
    }
    CHECK(relative_error(profile, a * std::pow(1 + square(b * 0.2), -c / 2)) < 1e-6);
}

TEST_CASE("Correlated material: a fractal has its spectrum between its periods, by either convention") {
    const double pi = std::numbers::pi;
    const auto surface = [](const std::string& keys) {
        return *material(R"("rms_roughness_um": 0.002, "correlation": )"
                         R"({"type": "fractal", "periods_um": [0.5, 100], )" +
                         keys + "}")
                    .properties()
                    .surface;
    };
    const Surface flat = surface(R"("C": 1.4, "psd": "1d one-sided")"),
                  plane = surface(R"("C": 2.4, "psd": "2d")");
    CHECK(*flat.correlation() == *plane.correlation());
    CHECK(flat.correlation_length() == plane.correlation_length());
    // the share of the variance below f by quadrature of the formula, in ln f
    const auto below = [&](double end) {
        double sum = 0;
        for (double log_f = -20; log_f < std::log(end); log_f += 1e-3) {
            const double f = std::exp(log_f);
            sum += 1e-3 * 2 * pi * f * f * std::pow(1 + square(100 * f), -1.2);
        }
        return sum;
    };
    for (const double f : {0.003, 0.01, 0.1, 1.0})
        CHECK(plane.variance_share(0, f) / plane.variance_share(0, 1.5) ==
              Approx(below(f) / below(1.5)).epsilon(3e-3));
    CHECK(plane.variance_share(0, 3) == Approx(1).epsilon(1e-6));
    CHECK(plane.variance_share(0, 1.5) < 0.999);
    CHECK(plane.rms_roughness() == 0.002);
}

TEST_CASE("Correlated material: smooth surfaces are Rayleigh-Rice with the spectrum") {
    // f = 16 pi^2/lambda^4 c_i c_r |b|^2 S2(f), |b|^2 half the sum of the elements of Bragg's matrix
    for (const char* const model : {"he_unified"}) {
        const std::string keys =
            R"("rms_roughness_um": 1e-5, "correlation": {"type": "k_correlation", "B_um": 5, "C": 2.2, )"
            R"("psd": "2d"})";
        const Material smooth = material(keys, model);
        const auto surface = *smooth.properties().surface;
        WorstCase worst{std::string{model} + " against Rayleigh-Rice", 2e-6};
        Random random{5};
        for (int i = 0; i < 100; ++i) {
            const DirectionPair pair{random.direction(0.1), random.direction(0.1)};
            const double lambda = 0.5;
            const double q = 2 * std::numbers::pi / lambda * surface.correlation_length() *
                             wave_vector_change(pair.in, pair.out).horizontal;
            const double density = 2 * std::numbers::pi *
                                   square(surface.rms_roughness() * surface.correlation_length()) * 2 * 0.1 /
                                   std::pow(1 + q * q, 1.1);
            const JonesMatrix b = bragg_jones(pair.in, pair.out, {0.8, 6}, 0);
            const double sum = (std::norm(b.ss) + std::norm(b.sp) + std::norm(b.ps) + std::norm(b.pp)) / 2;
            const double expected = 16 * square(std::numbers::pi) / square(square(lambda)) *
                                    pair.in.cos_theta() * pair.out.cos_theta() * sum * density;
            worst.note(relative_error(brdf(smooth, lambda, pair), expected),
                       [&] { return "pair " + std::to_string(i); });
        }
        worst.check();
    }
}

TEST_CASE(
    "Correlated material: a Gaussian through the general path is the Gaussian, but for slopes cut at "
    "1/lambda") {
    const double lambda = 0.5;
    for (const char* const model : {"he", "he_unified"}) {
        const Material plain = material(R"("rms_roughness_um": 0.2, "correlation_length_um": 3)", model);
        const Material general = material(
            R"("rms_roughness_um": 0.2, "correlation": {"type": "sum", "of": [[1, {"type": "gaussian", )"
            R"("length_um": 3}]]})",
            model);
        WorstCase worst{std::string{model} + ": Gaussian", 3e-6};
        Random random{9};
        for (int i = 0; i < 200; ++i) {
            const DirectionPair pair{random.direction(0.3), random.direction(0.3)};
            const double expected = brdf(plain, lambda, pair);
            if (expected < 1e-3 * brdf(plain, lambda, {pair.in, pair.in.mirror()})) continue;
            worst.note(relative_error(brdf(general, lambda, pair), expected),
                       [&] { return "pair " + std::to_string(i); });
        }
        worst.check();
    }
}

TEST_CASE("Correlated material: reciprocal, and two lengths stretch any shape") {
    const Material brushed = material(
        R"("rms_roughness_um": 0.1, "correlation_length_um": [4, 1], "azimuth_deg": 30, "correlation": )"
        R"("exponential")",
        "he_unified");
    const Material turned = material(
        R"("rms_roughness_um": 0.1, "correlation_length_um": [1, 4], "azimuth_deg": -60, "correlation": )"
        R"("exponential")",
        "he_unified");
    Random random{4};
    for (int i = 0; i < 50; ++i) {
        const DirectionPair pair{random.direction(), random.direction()};
        const double f = brdf(brushed, 0.6, pair);
        CHECK(relative_error(brdf(brushed, 0.6, {pair.out, pair.in}), f) < 1e-11);
        CHECK(relative_error(brdf(turned, 0.6, pair), f) < 1e-11);
    }
}

TEST_CASE("Correlated material: directions are drawn with the density they say") {
    for (const char* const keys :
         {R"("rms_roughness_um": 0.08, "correlation_length_um": 1.5, "correlation": "exponential")",
          R"("rms_roughness_um": 0.1, "correlation": {"type": "sum", "of": [[0.8, {"type": "gaussian", )"
          R"("length_um": 5}], [0.2, {"type": "exponential", "length_um": 0.5}]]})"}) {
        const Reflectance of = material(keys).at(Wavelength::from_micrometres(0.55));
        const auto sampler = of.sampler(0);
        const Direction in = Direction::from_degrees(40, 25);
        Random random{21};
        double sum = 0, squares = 0;
        constexpr int draws = 40000;
        for (int i = 0; i < draws; ++i) {
            const Draw draw = sampler.sample(in, random.uniforms());
            sum += draw.weight;
            squares += square(draw.weight);
        }
        const double mean = sum / draws, error = std::sqrt(squares / draws - square(mean)) / std::sqrt(draws);
        const double albedo = of.albedo(in, 0).total();
        INFO(keys << ": mean weight " << mean << " +- " << error << ", albedo " << albedo);
        CHECK(std::abs(mean - albedo) < 4 * error);
        CHECK(error < 0.01);
    }
}

namespace {

struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("hts-correlated-" + std::to_string(std::random_device{}()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    void write(const std::string& name, const std::string& text) const { std::ofstream{path / name} << text; }
    [[nodiscard]] Material read(const std::string& keys) const {
        return material_from_text(R"({"model": "he", "index": "Al", )" + keys + "}", path / "m.json");
    }
};

}  // namespace

TEST_CASE("Correlated material: spectra in CSV and in FRED's layout are one surface") {
    const Folder folder;
    std::string csv = "frequency_per_um,psd_um4\n", fred = "scan of a mirror\nfrequency psd\n",
                acf = "distance_um,autocorrelation\n0,1\n";
    for (int i = 0; i <= 60; ++i) {
        const double f = std::pow(10, -3 + i / 10.0), density = 1e-7 * std::pow(1 + square(5 * f), -1.4);
        csv += shortest(f) + "," + shortest(density) + "\n";
        fred += shortest(f * 1e3) + " " + shortest(density * 1e-12) + "\n";
    }
    for (int i = 0; i <= 120; ++i) {
        const double x = std::pow(10, -2 + i / 30.0);
        if (x > 12) break;
        acf += shortest(x) + "," + shortest(std::exp(-x)) + "\n";
    }
    folder.write("a.csv", csv);
    folder.write("a.txt", fred);
    folder.write("acf.csv", acf);
    const auto a = *folder.read(R"("correlation": {"type": "psd", "file": "a.csv"})").properties().surface;
    const auto b =
        *folder.read(R"("correlation": {"type": "psd", "file": "a.txt", "psd": "2d"})").properties().surface;
    CHECK(relative_error(a.rms_roughness(), b.rms_roughness()) < 1e-9);
    CHECK(relative_error(a.correlation_length(), b.correlation_length()) < 1e-9);
    REQUIRE(a.band());
    CHECK(a.band()->from == 1e-3);
    // integral of 1e-7 (1 + 25 f^2)^-1.4 2 pi f df = 1e-7 pi/25/0.4 (1 - (1 + 25 f^2)^-0.4)
    const double whole = 1e-7 * std::numbers::pi / 10 * (1 - std::pow(1 + 25e6, -0.4));
    CHECK(relative_error(square(a.rms_roughness()), whole) < 2e-3);
    const auto c =
        *folder
             .read(
                 R"("rms_roughness_um": 0.1, "correlation": {"type": "autocorrelation", "file": "acf.csv"})")
             .properties()
             .surface;
    CHECK(relative_error(c.correlation_length(), 1) < 1e-2);
}

TEST_CASE("Correlated material: what is wrong is said with its key or line") {
    using Catch::Matchers::Contains;
    const auto wrong = [](const std::string& keys, const std::string& text) {
        CHECK_THROWS_WITH(material(keys), Contains(text));
    };
    const std::string rms = R"("rms_roughness_um": 0.1, )";
    wrong(rms + R"("correlation_length_um": 1, "correlation": "fractal")", "must be an object");
    wrong(rms + R"("correlation_length_um": 1, "correlation": "factal")", R"(did you mean "fractal"?)");
    const auto fractal = [&](const std::string& keys, const std::string& text) {
        wrong(rms + R"("correlation": {"type": "fractal", )" + keys + "}", text);
    };
    fractal(R"("C": 2.4, "psd": "2d", "periods_um": [500, 0.5])",
            R"(key "correlation.periods_um": the shortest period, 500, must be below the longest, 0.5)");
    fractal(R"("C": 2.4, "psd": "2d", "periods_um": [0.5, "infinity"])", "periods_um[2]");
    fractal(R"("C": 12, "psd": "2d", "periods_um": [0.5, 500])",
            "slope of a fractal spectrum 12: must be from");
    fractal(R"("C": 2.4, "periods_um": [0.5, 500])", "psd");
    fractal(R"("C": 2.4, "psd": "2d", "periods_um": [1e-9, 500])", "must be from 2 to 1e+07");
    wrong(rms + R"("correlation_length_um": 1, "correlation": "matern")", "must be an object");
    wrong(rms + R"("correlation_length_um": 1, "correlation": {"type": "matern", "nu": 0})",
          R"(key "correlation.nu": nu of a Matern)");
    wrong(rms + R"("correlation_length_um": 1, "correlation": {"type": "matern", "nu": 1, "mu": 2})", "mu");
    wrong(rms + R"("correlation": {"type": "k_correlation", "B_um": 5, "C": 1, "psd": "1d one-sided"})",
          "infinite");
    wrong(rms + R"("correlation": {"type": "k_correlation", "B_um": 5, "C": 2, "psd": "2d"})",
          "from 2.1 to 102");
    wrong(rms + R"("correlation": {"type": "k_correlation", "B_um": 5, "C": 3, "psd": "1d"})",
          R"(must be "1d one-sided" or "2d")");
    wrong(rms + R"("correlation": {"type": "k_correlation", "B_um": 5, "C": 3})", "psd");
    wrong(rms + R"("correlation": {"type": "k_correlation", "A": 1, "B_um": 5, "C": 3, "psd": "2d"})",
          R"(key "rms_roughness_um": must be left out)");
    wrong(rms + R"("correlation_length_um": 2, "correlation": {"type": "k_correlation", "B_um": 5, "C": 3, )"
                R"("psd": "2d"})",
          R"(key "correlation_length_um": must be left out)");
    wrong(R"("correlation": {"type": "k_correlation", "B_um": 5, "C": 3, "psd": "2d"})", "rms_roughness_um");
    wrong(rms + R"("correlation": {"type": "sum", "of": [[-1, {"type": "exponential", "length_um": 1}]]})",
          "a weight must be > 0");
    wrong(rms + R"("correlation": {"type": "sum", "of": [[1, {"type": "exponential"}]]})", "length_um");
    wrong(rms + R"("correlation": {"type": "sum", "of": []})", "must be a list of one or more");
    wrong(rms + R"("correlation_length_um": 1, "rms_band_um": [5, 2])",
          R"(key "rms_band_um": the shortest period, 5, must be below the longest, 2)");
    wrong(rms + R"("correlation_length_um": 1, "rms_band_um": [0, 2])",
          R"(key "rms_band_um[1]": the shortest period must be > 0)");
    wrong(rms + R"("correlation_length_um": 1, "rms_band_um": [1e-9, 2e-9])", "none at these periods");
    const Folder folder;
    const auto refused = [&](const std::string& rows, const std::string& text) {
        folder.write("p.csv", "frequency_per_um,psd_um4\n" + rows);
        CHECK_THROWS_WITH(folder.read(R"("correlation": {"type": "psd", "file": "p.csv"})"), Contains(text));
    };
    refused("0.1,1\n0.2,-1\n0.3,1\n", R"(p.csv:3: column "psd_um4": -1 must be > 0)");
    refused("0.1,1\n0.3,1\n0.2,1\n",
            R"(p.csv:4: column "frequency_per_um": 0.2 must be above 0.3 before it)");
    refused("0,1\n0.3,1\n0.4,1\n", R"(p.csv:2: column "frequency_per_um": 0 must be > 0)");
    refused("0.1,1\n", "must be 3 or more");
    folder.write("p.csv", "frequency_per_um,psd_um4\n0.1,1\n0.2,0.9\n0.3,0.8\n");
    CHECK_THROWS_WITH(
        folder.read(R"("correlation": {"type": "psd", "file": "p.csv", "outside": "power_law"})"),
        Contains("variance of heights is infinite"));
    CHECK_THROWS_WITH(folder.read(R"("correlation": {"type": "psd", "file": "none.csv"})"),
                      Contains("none.csv"));
}

TEST_CASE("Correlated material: what has no theory is refused by name") {
    using Catch::Matchers::Contains;
    const std::string keys =
        R"("rms_roughness_um": 0.1, "correlation_length_um": 1, "correlation": "exponential")";
    const auto at = [&](const Material& of, const EvaluationOptions& how) {
        return of.at(Wavelength::from_micrometres(0.5), how);
    };
    CHECK_THROWS_WITH(at(material(keys), {.lobe = DiffuseLobe::rough_limit}),
                      Contains("rough_limit of a correlation that is not gaussian"));
    CHECK_THROWS_WITH(at(material(keys + R"(, "mirror": "second_order")", "he_unified"), {}),
                      Contains("second-order mirror term of a surface whose correlation is not gaussian"));
    CHECK_THROWS_WITH(
        at(material(R"("rms_roughness_um": 500, "correlation_length_um": 900, "correlation": "exponential")"),
           {}),
        Contains("must be at most 795 wavelengths"));
}

}  // namespace hts::spectral
