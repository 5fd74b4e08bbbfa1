#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/statistics.hpp"
#include "tables/formats/glsl/glsl.hpp"

using namespace hts;
using namespace hts::spectral;
using namespace hts::tables;

namespace {

constexpr double degree = std::numbers::pi / 180;

// As a shader gets it.
Direction rounded(const Direction& direction) {
    const Vector3 v = direction.vector();
    const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return Direction::from_vector({single(v.x), single(v.y), single(v.z)});
}

Reflectance rough(double sigma, double tau, RefractiveIndex index, double wavelength, double albedo = 0) {
    return he_torrance_reflectance(
        "surface", {sigma, tau},
        {{Wavelength::from_micrometres(wavelength), index, albedo * std::numbers::inv_pi}}, Tolerance{1e-9});
}

struct Worst {
    double error = 0, sigma = 0, tau = 0, theta_i = 0, theta_r = 0, value = 0;
};

}  // namespace

TEST_CASE("the shader's arithmetic agrees with the model over surfaces, indices and directions") {
    Random random{20};
    const double lowest = std::cos(89 * degree);
    std::vector<double> errors;
    Worst worst;
    for (int surface = 0; surface < 400; ++surface) {
        const double sigma = std::pow(10, -3 + 4 * random.uniform());
        const double tau = sigma / std::pow(10, std::log10(0.003) * random.uniform());
        const double wavelength = std::pow(10, -1 + 2 * random.uniform());
        const RefractiveIndex index{std::pow(10, -1 + 1.7 * random.uniform()),
                                    surface % 3 == 0 ? 0 : std::pow(10, -3 + 5 * random.uniform())};
        const auto model = rough(sigma, tau, index, wavelength, surface % 4 == 0 ? random.uniform() : 0);
        const auto shader = shader_brdf(glsl_text(model), "shader");
        for (int pair = 0; pair < 50; ++pair) {
            const Direction in = rounded(random.direction(lowest));
            // about the mirror direction, closer and closer, and anywhere
            const Vector3 m = in.mirror().vector(), any = random.direction(lowest).vector();
            const double near = pair % 2 == 0 ? 1 : std::pow(10, -4 * random.uniform());
            const Vector3 v = near * any + (1 - near) * m;
            const Direction out = rounded(Direction::from_vector(v));
            const double peak = std::max(model.brdf({in, rounded(in.mirror())})[0], model.brdf({in, out})[0]);
            const double expected = model.brdf({in, out})[0], value = shader.brdf({in, out})[0];
            REQUIRE(std::isfinite(value));
            if (!(expected > hts::accuracy::shader_floor * peak) || expected < 1e-25) continue;
            const double error = std::abs(value / expected - 1);
            errors.push_back(error);
            if (error > worst.error)
                worst = {error,
                         sigma / wavelength,
                         tau / wavelength,
                         std::acos(in.cos_theta()) / degree,
                         std::acos(out.cos_theta()) / degree,
                         expected};
        }
    }
    const double median = quantile(errors, 0.5);
    std::printf(
        "shader, %zu pairs: worst %.2e at sigma0/lambda %.4g, tau/lambda %.4g, theta %.2f and %.2f deg, f "
        "%.3g; median %.1e\n",
        errors.size(), worst.error, worst.sigma, worst.tau, worst.theta_i, worst.theta_r, worst.value,
        median);
    CHECK(errors.size() > 8000);
    CHECK(worst.error <= hts::accuracy::shader);
    CHECK(median < 5e-5);
}

TEST_CASE("the shader in WGSL holds the same constants and functions") {
    const auto model = rough(0.28, 1.77, {0.8, 4.5}, 0.5, 0.1);
    const std::string text = wgsl_text(model);
    const auto wgsl = shader_brdf(text, "w"), glsl = shader_brdf(glsl_text(model), "g");
    Random random{5};
    for (int i = 0; i < 100; ++i) {
        const DirectionPair pair{random.direction(1e-3), random.direction(1e-3)};
        CHECK(wgsl.brdf(pair)[0] == glsl.brdf(pair)[0]);
    }
    for (const char* function : {"fn hts_brdf(wi : vec3<f32>, wo : vec3<f32>, w : i32) -> f32 {",
                                 "fn hts_phi(g : f32, t : f32) -> f32 {",
                                 "fn hts_sample(wi : vec3<f32>, u : vec3<f32>, w : i32) -> HtsDraw {",
                                 "const HTS_SIGMA0 : f32 = 0.28;"})
        CHECK(text.find(function) != std::string::npos);
    // no word that GLSL alone has, but in a comment
    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) {
        const std::string code = line.substr(0, line.find("//"));
        CAPTURE(code);
        CHECK(!std::regex_search(code, std::regex{R"(\bfloat\b|\bint\b|\bvec3\b[^<]|\?)"}));
    }
}

TEST_CASE("a shader's text holds the material, and its colour where the wavelengths have one") {
    const auto aluminium =
        he_torrance_material("aluminium\nof two lines", {0.28, 1.77}, built_in_optical_constants("Al"));
    const auto text_at = [&](const WavelengthGrid& wavelengths) {
        return glsl_text(aluminium.at(wavelengths));
    };
    const std::string text = text_at(WavelengthGrid::linear(0.4, 0.7, 8));
    CHECK(text.starts_with("// aluminium of two lines: "));
    for (const char* part :
         {"const float HTS_SIGMA0 = 0.28;", "const float HTS_TAU = 1.77;",
          "const float HTS_WAVELENGTH[8] = float[8](", "float hts_brdf(vec3 wi, vec3 wo, int w)",
          "vec3 hts_brdf_rgb(vec3 wi, vec3 wo)", "HtsDraw hts_sample(", "float hts_pdf(",
          "at most 0.001 of the model's value", "140 bytes"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(text.find("sampler") == std::string::npos);
    CHECK(text.find("#include") == std::string::npos);
    CHECK(text_at(WavelengthGrid::from_micrometres({0.46, 0.55, 0.62})).find("hts_brdf_rgb") !=
          std::string::npos);
    CHECK(text_at(WavelengthGrid::from_micrometres({2.0})).find("hts_brdf_rgb") == std::string::npos);
    const auto read = shader_brdf(text, "al.glsl");
    CHECK(read.size() == 8);
    CHECK(read.wavelengths().micrometres()[7] == Approx(0.7));
    CHECK(read.properties().specular_term);
    const Direction in = Direction::from_degrees(60, 0);
    CHECK(read.specular_reflectance(in)[7].value() ==
          Approx(aluminium.at(WavelengthGrid::linear(0.4, 0.7, 8)).specular_reflectance(in)[7].value())
              .epsilon(hts::accuracy::shader));
}

TEST_CASE("shaders are refused where the model is another, and texts that are none") {
    CHECK_THROWS_WITH(glsl_text(he_torrance_material("new", RoughSurface{{0.28, 1.77}, UnifiedChoices{}},
                                                     built_in_optical_constants("Al"))
                                    .at(Wavelength::from_micrometres(0.5))),
                      "new: format glsl: must be a material of model \"he\", not \"he_unified\"");
    CHECK_THROWS_WITH(glsl_text(he_torrance_material("long", {0.28, 1.77}, built_in_optical_constants("Al"))
                                    .at(WavelengthGrid::linear(0.4, 0.7, 65))),
                      Catch::Matchers::Contains("number of wavelengths of a shader 65: must be at most 64"));
    const std::string text = glsl_text(rough(0.1, 1, {1.5, 0}, 0.5));
    for (const char* key : {"HTS_SIGMA0 =", "HTS_N[1]", "HTS_ALBEDO[1]"}) {
        std::string damaged = text;
        damaged.erase(damaged.find(key), 6);
        CHECK_THROWS_WITH(
            shader_brdf(damaged, "x.glsl"),
            Catch::Matchers::Contains("x.glsl: constant HTS_") && Catch::Matchers::Contains(": missing"));
    }
    std::string word = text;
    word.replace(word.find("HTS_SIGMA0 = ") + 13, 3, "one");
    CHECK_THROWS_WITH(shader_brdf(word, "x.glsl"), Catch::Matchers::Contains("is not a number"));
}

TEST_CASE("the shader draws directions with the density it states, and their mean weight is the albedo") {
    Random random{3};
    struct Case {
        double sigma, tau, theta;
    };
    for (const Case& c :
         {Case{0.28, 1.77, 30}, Case{0.05, 1, 60}, Case{0.02, 3, 10}, Case{1, 4, 75}, Case{0, 1, 40}}) {
        const auto model = rough(c.sigma, c.tau, {1.2, 6}, 0.5, 0.1);
        const auto shader = shader_brdf(glsl_text(model), "shader");
        const auto sampler = shader.sampler(0);
        const Direction in = Direction::from_degrees(c.theta, 0);
        double weights = 0, squares = 0, inside = 0, drawn_inside = 0;
        const int draws = 200'000;
        // as many directions drawn as hit a band of the sky as the density says
        const auto in_band = [](const Direction& d) { return d.cos_theta() > 0.3 && d.cos_theta() < 0.8; };
        for (int i = 0; i < draws; ++i) {
            const Draw drawn = sampler.sample(in, {random.uniform(), random.uniform(), random.uniform()});
            weights += drawn.weight;
            squares += drawn.weight * drawn.weight;
            if (drawn.lobe == Lobe::directional_diffuse && in_band(drawn.out)) drawn_inside += 1;
            const Direction any = random.direction(0);
            if (in_band(any)) inside += 2 * std::numbers::pi * sampler.pdf(in, any);
        }
        const double mean = weights / draws;
        const double error = std::sqrt((squares / draws - mean * mean) / draws);
        const double albedo = model.albedo(in, 0).total();
        std::printf("shader's draws, sigma0 %.2f: mean weight %.4f +- %.4f, albedo %.4f\n", c.sigma, mean,
                    error, albedo);
        CHECK(std::abs(mean - albedo) < 5 * error + 1e-3 * albedo);
        CHECK(error < 0.01);
        CHECK(drawn_inside / draws == Approx(inside / draws).margin(0.02));
    }
}
