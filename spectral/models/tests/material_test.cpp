#include "spectral/models/material.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "spectral/models/model_readers.hpp"
#include "spectral/models/reflectance.hpp"
#include "spectral/text/png.hpp"
#include "temporary_folder.hpp"

using hts::Direction;
using hts::Draw;
using hts::Uniforms;
using hts::Wavelength;
using hts::spectral::built_in_models;
using hts::spectral::Material;
using hts::spectral::ModelEntry;
using hts::spectral::read_material;
using hts::spectral::Reflectance;
using hts::spectral::Sampler;
using hts::testing::complaint;
using hts::testing::Random;
using hts::testing::relative_error;
using hts::testing::TemporaryFolder;
using hts::testing::WorstCase;

namespace {

constexpr double pi = std::numbers::pi;
const auto green = Wavelength::from_micrometres(0.55);

/// A material file of every model.
const std::map<std::string, std::string> files{
    {"he", R"({"model": "he", "rms_roughness_um": 0.2, "correlation_length_um": 2, "index": "Al", )"
           R"("diffuse_albedo": 0.1})"},
    {"he_unified",
     R"({"model": "he_unified", "rms_roughness_um": 0.2, "correlation_length_um": 2, "index": "Al", )"
     R"("diffuse_albedo": 0.1})"},
    {"walter", R"({"model": "walter", "distribution": "ggx", "alpha": 0.3, "index": "Au"})"},
    {"kurt", R"({"model": "kurt", "kd": 0.2,
       "lobes": [{"ks": 0.5, "f0": 0.1, "mx": 0.2, "my": 0.5, "alpha": 0.1}]})"},
    {"ashikhmin", R"({"model": "ashikhmin", "f0": 0.2, "diffuse_albedo": 0.5,
       "normals": {"type": "gaussian", "sigma_x": 0.3, "sigma_y": 0.3}})"},
    {"lambert", R"({"model": "lambert", "diffuse_albedo": {"table": [[0.4, 0.2], [0.7, 0.5]]}})"},
    {"oren_nayar", R"({"model": "oren_nayar", "diffuse_albedo": 0.7, "slope_angle_deg": 20})"},
    {"ward", R"({"model": "ward", "kd": 0.1, "lobes": [{"ks": 0.3, "mx": 0.2, "my": 0.4}]})"},
    {"ward_duer", R"({"model": "ward_duer", "lobes": [{"ks": 0.3, "mx": 0.2, "my": 0.4}]})"},
    {"cook_torrance", R"({"model": "cook_torrance", "lobes": [{"ks": 1, "f0": 0.8, "m": 0.3}]})"},
    {"blinn_phong", R"({"model": "blinn_phong", "kd": 0.3, "lobes": [{"ks": 0.4, "exponent": 20}]})"},
    {"lafortune", R"({"model": "lafortune", "kd": 0.2,
       "lobes": [{"ks": 0.4, "cx": -1, "cy": -1, "exponent": 20}]})"},
    {"ashikhmin_shirley", R"({"model": "ashikhmin_shirley", "rd": 0.5, "f0": 0.1, "nx": 20, "ny": 80})"},
};

Material material_of(const TemporaryFolder& folder, const std::string& text) {
    return read_material(folder.write("m.json", text));
}

Reflectance reflectance_of(const std::string& name) {
    const TemporaryFolder folder;
    return material_of(folder, files.at(name)).at(green);
}

std::string complaint_about(const std::string& text) {
    const TemporaryFolder folder;
    return complaint(folder, [&] { static_cast<void>(material_of(folder, text)); });
}

/// In the plane or off it, up to 85 degrees.
Direction random_direction(Random& random) {
    const double theta = random.uniform(0, 85);
    return Direction::from_degrees(theta, random.uniform(0, 360));
}

/// Midpoints over the hemisphere.
double integral_of_pdf(const Sampler& model, const Direction& in) {
    constexpr int rows = 200, columns = 400;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double theta = (i + 0.5) * pi / 2 / rows;
        for (int j = 0; j < columns; ++j)
            sum +=
                model.pdf(in, Direction::from_angles(theta, (j + 0.5) * 2 * pi / columns)) * std::sin(theta);
    }
    return sum * (pi / 2 / rows) * (2 * pi / columns);
}

/// A model of one's own: twice Lambert's at the top, none at the horizon.
class Toy {
  public:
    explicit Toy(double albedo) : albedo_{albedo} {
        if (!(albedo >= 0 && albedo <= 1)) throw hts::out_of_range("toy albedo", albedo, "", "from 0 to 1");
    }
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return albedo_ * 2.25 / pi * in.cos_theta() * out.cos_theta();
    }
    [[nodiscard]] double pdf(const Direction& /*in*/, const Direction& out) const noexcept {
        return out.cos_theta() / pi;
    }
    [[nodiscard]] hts::Draw sample(const Direction& in, const Uniforms& u) const noexcept {
        return hts::weighted(*this, in, hts::cosine_vector(u[0], u[1]));
    }

  private:
    double albedo_;
};

}  // namespace

TEST_CASE("every registered model is tested here") {
    REQUIRE(built_in_models().size() == files.size());
    for (const ModelEntry& entry : built_in_models()) {
        INFO(entry.name);
        REQUIRE(files.contains(entry.name));
        const TemporaryFolder folder;
        const Material material = material_of(folder, files.at(entry.name));
        CHECK(material.name() == "m");
        CHECK(material.model_name() == entry.name);
        CHECK(material.model_source() == entry.source);
        const auto& properties = material.properties();
        const bool rough = entry.name == "he" || entry.name == "he_unified";
        CHECK(properties.surface.has_value() == rough);
        CHECK(properties.polarised == rough);
    }
}

TEST_CASE("every model is reciprocal as a reflectance, and its terms add up") {
    for (const auto& [name, text] : files) {
        const Reflectance model = reflectance_of(name);
        Random random{3};
        WorstCase reciprocity{name + ", reciprocity", 1e-12};
        WorstCase sum{name + ", sum of terms", 1e-15};
        for (int i = 0; i < 500; ++i) {
            const Direction in = random_direction(random);
            const Direction out = i % 3 == 0 ? in.mirror() : random_direction(random);
            const double there = model.brdf({in, out}).front();
            REQUIRE((there >= 0 && std::isfinite(there)));
            const double directional = model.directional_diffuse({in, out}).front();
            const double uniform = std::min(there, model.uniform_diffuse().front());
            reciprocity.note(there == 0 ? 0 : std::abs(there - model.brdf({out, in}).front()) / there,
                             [i] { return "pair " + std::to_string(i); });
            sum.note(relative_error(directional + uniform, there),
                     [i] { return "pair " + std::to_string(i); });
        }
        reciprocity.check();
        sum.check();
    }
}

TEST_CASE("densities integrate to at most 1, and weights to the albedo") {
    for (const auto& [name, text] : files) {
        const Reflectance reflectance = reflectance_of(name);
        const Sampler model = reflectance.sampler(0);
        for (const double theta : {10.0, 60.0}) {
            const Direction in = Direction::from_degrees(theta, 40);
            INFO(name << " at " << theta);
            CHECK(integral_of_pdf(model, in) <= 1 + 1e-3);
            Random random{5};
            const int count = hts::testing::exhaustive() ? 1'000'000 : 20'000;
            double sum = 0, squares = 0;
            for (int i = 0; i < count; ++i) {
                const Draw drawn = model.sample(in, random.uniforms());
                sum += drawn.weight;
                squares += drawn.weight * drawn.weight;
                if (drawn.lobe == hts::Lobe::none) CHECK(drawn.weight == 0);
            }
            const double mean = sum / count;
            const double error = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
            const auto albedo = reflectance.albedo(in, 0);
            INFO("mean weight " << mean << " +- " << error << ", albedo " << albedo.total());
            CHECK(std::abs(mean - albedo.total()) < 5 * error + 1e-5);
            CHECK(albedo.uniform_diffuse == Approx(reflectance.uniform_diffuse().front() * pi).margin(1e-12));
        }
    }
}

TEST_CASE("all wavelengths of a model at once have the bits of each alone") {
    auto described = files;
    described["of two shapes"] = R"({"model": "ward", "kd": {"table": [[0.4, 0.2], [0.7, 0.5]]}, "lobes": [
        {"ks": 0.3, "mx": {"table": [[0.4, 0.2], [0.55, 0.2], [0.6, 0.4], [0.7, 0.4]]}, "my": 0.4}]})";
    const TemporaryFolder folder;
    const auto grid = hts::spectral::WavelengthGrid::linear(0.4, 0.7, 7);
    for (const auto& [name, text] : described) {
        INFO(name);
        const Material material = material_of(folder, text);
        const Reflectance spectrum = material.at(grid);
        std::vector<Reflectance> each;
        for (std::size_t k = 0; k < grid.size(); ++k) each.push_back(material.at(grid[k]));
        REQUIRE(spectrum.size() == grid.size());
        Random random{13};
        std::size_t different = 0;
        for (int i = 0; i < 200; ++i) {
            const Direction in = i == 0 ? Direction::from_degrees(90, 0) : random_direction(random);
            const Direction out = i % 3 == 1 ? in.mirror() : random_direction(random);
            const auto brdf = spectrum.brdf({in, out});
            const auto directional = spectrum.directional_diffuse({in, out});
            const auto specular = spectrum.specular_reflectance(in);
            for (std::size_t k = 0; k < grid.size(); ++k) {
                const Reflectance& alone = each[k];
                different += brdf[k] != alone.brdf({in, out}).front() ||
                             directional[k] != alone.directional_diffuse({in, out}).front() ||
                             specular[k].value() != alone.specular_reflectance(in).front().value() ||
                             spectrum.uniform_diffuse()[k] != alone.uniform_diffuse().front();
            }
        }
        CHECK(different == 0);
    }
}

TEST_CASE("properties say what can be asked of a material") {
    CHECK(reflectance_of("he").properties().polarised);
    CHECK(reflectance_of("he").properties().specular_term);
    CHECK(reflectance_of("he").properties().isotropic);
    CHECK(reflectance_of("he").samples().size() == 1);
    CHECK(reflectance_of("lambert").properties().isotropic);
    CHECK_FALSE(reflectance_of("ward").properties().isotropic);
    CHECK_FALSE(reflectance_of("kurt").properties().isotropic);
    CHECK(reflectance_of("lambert").samples().empty());
    CHECK_THROWS_WITH(
        reflectance_of("lambert").mueller({Direction::from_degrees(10, 0), Direction::from_degrees(20, 0)}),
        "m: has no Mueller matrices");
    const TemporaryFolder folder;
    const auto glass = material_of(
        folder, R"({"model": "walter", "distribution": "ggx", "alpha": 0.3, "index": {"n": 1.5, "k": 0}})");
    CHECK(glass.at(green).properties().transmitting);
    CHECK_FALSE(reflectance_of("walter").properties().transmitting);
}

TEST_CASE("a pigment under facets adds the same radiance everywhere, and lets nothing through") {
    const TemporaryFolder folder;
    const std::string facets =
        R"({"model": "walter", "distribution": "beckmann", "alpha": 0.3, "index": {"n": 1.5, "k": 0})";
    const auto bare = material_of(folder, facets + "}").at(green);
    const auto painted =
        material_of(folder, facets + R"(, "diffuse_albedo": {"table": [[0.4, 0.2], [0.7, 0.5]]}})").at(green);
    CHECK_FALSE(painted.properties().transmitting);
    const double um = green.micrometres(), albedo = 0.2 + 0.3 * (um - 0.4) / 0.3;
    const hts::DirectionPair pair{Direction::from_degrees(40, 0), Direction::from_degrees(30, 170)};
    CHECK(painted.brdf(pair)[0] == Approx(bare.brdf(pair)[0] + albedo / pi).epsilon(1e-14));
    CHECK(painted.uniform_diffuse()[0] == Approx(albedo / pi).epsilon(1e-14));
    CHECK(painted.directional_diffuse(pair)[0] == Approx(bare.brdf(pair)[0]).epsilon(1e-12));
}

TEST_CASE("what a model has not is refused by name") {
    const TemporaryFolder folder;
    const Material lambert = material_of(folder, files.at("lambert"));
    CHECK_THROWS_WITH(lambert.at(green, {.compensate_energy = true}),
                      "m: energy compensation: must be off, since its model is lambert, not he");
    CHECK_THROWS_WITH(lambert.at(green, {.lobe = hts::DiffuseLobe::rough_limit}),
                      "m: lobe rough_limit: must be full or none, since its model is lambert, not he");
    CHECK_THROWS_WITH(lambert.at(green, {.instead = {.n = 1.5}}),
                      "m: values of a rough surface: must not be given, since its model is lambert, not he");
    const Reflectance uniform =
        material_of(folder, files.at("ward")).at(green, {.lobe = hts::DiffuseLobe::none});
    const Direction in = Direction::from_degrees(30, 0);
    CHECK(uniform.brdf({in, in.mirror()}).front() == Approx(0.1 / pi).epsilon(1e-14));
}

TEST_CASE("numbers of a material file may be tables over wavelength") {
    const TemporaryFolder folder;
    const Material lambert = material_of(folder, files.at("lambert"));
    const Direction up = Direction::from_degrees(0, 0);
    CHECK(lambert.at(green).brdf({up, up}).front() == Approx(0.35 / pi).epsilon(1e-14));
    const auto ultraviolet = Wavelength::from_micrometres(0.3);
    CHECK_THROWS_WITH(lambert.at(ultraviolet),
                      Catch::Contains("\"diffuse_albedo\"") && Catch::Contains("0.4 to 0.7 um"));
    CHECK(lambert.at(ultraviolet, {.outside = hts::spectral::OutsideRange::hold}).brdf({up, up}).front() ==
          Approx(0.2 / pi).epsilon(1e-14));
}

TEST_CASE("a number with a default may be left out") {
    const TemporaryFolder folder;
    const auto lobe = [&](const std::string& ks) {
        return material_of(folder, R"({"model": "ashikhmin_shirley", "rd": 0, )" + ks +
                                       R"("f0": 0.1, "nx": 20, "ny": 80})")
            .at(green);
    };
    const Direction in = Direction::from_degrees(30, 0), out = Direction::from_degrees(35, 170);
    const double alone = lobe("").brdf({in, out}).front();
    CHECK(alone > 0.01);
    CHECK(lobe(R"("ks": 1, )").brdf({in, out}).front() == alone);
    CHECK(lobe(R"("ks": {"table": [[0.5, 2], [0.6, 2]]}, )").brdf({in, out}).front() == 2 * alone);
}

TEST_CASE("what is wrong with a material file is named by key and legal range") {
    struct Case {
        std::string text;
        std::vector<std::string> named;
    };
    const std::string kurt = R"({"model": "kurt", "kd": 0.2, "lobes": [{"ks": 1, "f0": 0.1, "mx": 0.2, )";
    const std::string normals = R"({"model": "ashikhmin", "f0": 0.2, "normals": )";
    const std::vector<Case> bad{
        {R"({"model": "plastic"})", {"\"model\"", "\"plastic\"", "he, he_unified, walter", "lambert"}},
        {R"({"model": "lambert"})", {"\"diffuse_albedo\"", "missing"}},
        {R"({"model": "lambert", "diffuse_albedo": 1.2})", {"\"diffuse_albedo\"", "1.2", "0 to 1"}},
        {R"({"model": "lambert", "diffuse_albedo": "white"})", {"\"diffuse_albedo\"", "number"}},
        {R"({"model": "lambert", "diffuse_albedo": 1, "kd": 1})", {"\"kd\"", "diffuse_albedo"}},
        {R"({"model": "lambert", "diffuse_albedo": {"table": [[0.5, 2]]}})",
         {"\"diffuse_albedo.table\"", "row 1", "0 to 1"}},
        {R"({"model": "oren_nayar", "diffuse_albedo": 1, "slope_angle_deg": 100})", {"\"slope_angle_deg\""}},
        {R"({"model": "walter", "distribution": "ggx", "index": "Au"})", {"\"alpha\"", "missing"}},
        {R"({"model": "walter", "distribution": "ggx", "alpha": -1, "index": "Au"})", {"\"alpha\"", "-1"}},
        {R"({"model": "walter", "distribution": "phong", "alpha": 1, "index": "Au"})",
         {"\"alpha\"", "phong"}},
        {R"({"model": "walter", "distribution": "rough", "alpha": 1, "index": "Au"})",
         {"\"distribution\"", "rough", "ggx"}},
        {R"({"model": "walter", "distribution": "ggx", "alpha": 1, "index": "Au", "exterior_index": 0})",
         {"\"exterior_index\"", "0"}},
        {R"({"model": "walter", "distribution": "ggx", "alpha": 1, "index": "Au", "diffuse_albedo": 1.5})",
         {"\"diffuse_albedo\"", "1.5", "0 to 1"}},
        {kurt + R"("my": 0, "alpha": 0}]})", {"\"lobes[1].my\"", "0"}},
        {kurt + R"("my": 1, "alpha": 2}]})", {"\"lobes[1].alpha\"", "2", "below 2"}},
        {kurt + R"("my": 1}]})", {"\"lobes[1].alpha\"", "missing"}},
        {kurt + R"("my": 1, "alpha": 0, "m": 3}]})", {"\"lobes[1].m\"", "not known"}},
        {R"({"model": "kurt", "lobes": []})", {"\"lobes\"", "at least one"}},
        {R"({"model": "kurt", "lobes": {}})", {"\"lobes\"", "array"}},
        {kurt + R"("my": 1, "alpha": 0}], "coupled": 1})", {"\"coupled\"", "true or false"}},
        {R"({"model": "ward", "kd": 2, "lobes": [{"ks": 1, "mx": 1, "my": 1}]})", {"\"kd\"", "2", "0 to 1"}},
        {R"({"model": "ashikhmin_shirley", "rd": 0, "f0": 0, "nx": 1, "ny": 1, "ks": -1})",
         {"\"ks\"", "-1", "0 to 1e+06"}},
        {R"({"model": "ward", "lobes": [{"ks": -1, "mx": 1, "my": 1}]})", {"\"lobes[1].ks\"", "-1"}},
        {normals + R"({"type": "gaussian", "sigma_x": 0.1}})", {"\"normals.sigma_y\"", "missing"}},
        {normals + R"({"type": "gaussian", "sigma_x": 0.1, "sigma_y": 0}})",
         {"\"normals.sigma_y\"", "1e-04"}},
        {normals + R"({"type": "gaussian", "sigma_x": "big", "sigma_y": 1}})",
         {"\"normals.sigma_x\"", "infinity"}},
        {normals + R"({"type": "grooves", "slope_deg": 90, "sigma": 1}})", {"\"normals.slope_deg\""}},
        {normals + R"({"type": "fur"}})", {"\"normals.type\"", "fur", "mixture"}},
        {normals + R"({"type": "mixture", "of": [[0, {"type": "inverse_gaussian", "sigma": 0.5}]]}})",
         {"\"normals.of[1][1]\"", "0", "> 0"}},
        {normals + R"({"type": "inverse_gaussian", "sigma": 0.5}, "diffuse_albedo": 3})",
         {"\"diffuse_albedo\"", "3", "0 to 1"}},
        {normals + R"({"type": "inverse_gaussian", "sigma": 0.5}, "index": "Al"})", {"\"index\"", "f0"}},
    };
    for (const Case& one : bad) {
        const std::string message = complaint_about(one.text);
        INFO(one.text << "\n" << message);
        CHECK(message.find("m.json") != std::string::npos);
        for (const std::string& part : one.named) {
            INFO("must name: " << part);
            CHECK(message.find(part) != std::string::npos);
        }
    }
}

TEST_CASE("normals may come from a picture or a table") {
    const TemporaryFolder folder;
    const auto with = [&](const std::string& normals) {
        return material_of(folder, R"({"model": "ashikhmin", "f0": 0.2, "normals": )" + normals + "}")
            .at(green);
    };
    folder.write("white.png", hts::spectral::png_bytes(4, 4, std::vector<std::uint8_t>(48, 255)));
    const Reflectance picture =
        with(R"({"type": "image", "file": "white.png", "extent": 1, "sigma_x": 0.5, "sigma_y": 0.5})");
    const Reflectance gaussian = with(R"({"type": "gaussian", "sigma_x": 0.5, "sigma_y": 0.5})");
    const Reflectance table = with(R"({"type": "tabulated", "rows": [[1], [1], [1]]})");
    const Reflectance everywhere = with(R"({"type": "inverse_gaussian", "sigma": "infinity"})");
    for (const double theta : {0.0, 30.0, 60.0}) {
        const auto in = Direction::from_degrees(20, 0), out = Direction::from_degrees(theta, 150);
        CHECK(picture.brdf({in, out}).front() == Approx(gaussian.brdf({in, out}).front()).epsilon(0.01));
        CHECK(table.brdf({in, out}).front() == Approx(everywhere.brdf({in, out}).front()).epsilon(0.01));
    }
    const auto problem = [&](const std::string& normals) {
        return complaint(folder, [&] { with(normals); });
    };
    CHECK(problem(R"({"type": "image", "file": "no.png", "extent": 1, "sigma_x": 0.5, "sigma_y": 0.5})") ==
          R"(m.json: key "normals.file": no.png: cannot be read: must be a PNG file)");
    CHECK(problem(R"({"type": "image", "file": "white.png", "extent": 2, "sigma_x": 0.5, "sigma_y": 0.5})") ==
          R"(m.json: key "normals.extent": extent of the image of normals 2: must be > 0 and at most 1)");
    CHECK(problem(R"({"type": "tabulated", "rows": [[1, 2], [1]]})") ==
          R"(m.json: key "normals.rows[2]": must be as long as the first row)");
}

TEST_CASE("slanted velvet warns that its mean normal is tilted") {
    const TemporaryFolder folder;
    const Material velvet = material_of(
        folder, R"({"model": "ashikhmin", "f0": 1, "normals": {"type": "slanted_fibres", "sigma": 0.5, )"
                R"("slant_deg": 40}})");
    REQUIRE(velvet.warnings().size() == 1);
    CHECK(velvet.warnings().front().find("mean normal") != std::string::npos);
    CHECK(material_of(folder, files.at("ashikhmin")).warnings().empty());
}

TEST_CASE("a model of one's own joins by a line") {
    auto models = built_in_models();
    models.push_back(hts::spectral::model_of_numbers<Toy>("toy", "nobody", {{"albedo", 0.5}}));
    const TemporaryFolder folder;
    const auto toy = read_material(folder.write("toy.json", R"({"model": "toy", "albedo": 0.8})"), models);
    const Direction in = Direction::from_degrees(60, 0);
    CHECK(toy.at(green).albedo(in, 0).total() == Approx(0.8 * 0.75).epsilon(1e-5));
    CHECK_THROWS_WITH(read_material(folder.write("bad.json", R"({"model": "toy", "albedo": 8})"), models),
                      Catch::Contains("key \"albedo\": toy albedo 8: must be from 0 to 1"));
}
