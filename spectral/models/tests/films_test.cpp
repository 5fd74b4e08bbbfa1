// The key "films" of material files, whatever the model, and light from the whole hemisphere.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "hts/sampling/random.hpp"
#include "spectral/models/hemisphere.hpp"
#include "spectral/models/material.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::Equals;
using hts::Direction;
using hts::Wavelength;
using hts::spectral::Material;
using hts::spectral::material_from_text;
using hts::spectral::WavelengthGrid;

namespace {

const std::string he = R"("model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 1)";
const std::string unified = R"("model": "he_unified", "rms_roughness_um": 0.1, "correlation_length_um": 1)";
const std::string walter = R"("model": "walter", "distribution": "ggx", "alpha": 0.2)";
const std::string ashikhmin =
    R"("model": "ashikhmin", "normals": {"type": "gaussian", "sigma_x": 0.3, "sigma_y": 0.3})";
const std::string oxide = R"("films": [{"index": "Al2O3", "thickness_um": 0.05}])";

Material material(const std::string& model, const std::string& more) {
    return material_from_text("{" + model + ", " + more + "}", "m.json");
}
void refuses(const std::string& model, const std::string& more, const std::string& message) {
    INFO(more);
    CHECK_THROWS_WITH(material(model, more), Contains("m.json: ") && Contains(message));
}

const WavelengthGrid grid = WavelengthGrid::from_micrometres({0.4, 0.5, 0.6});

}  // namespace

TEST_CASE("films change every model that has an index, and films of no thickness none") {
    hts::Random random{1};
    for (const std::string& model : {he, unified, walter, ashikhmin}) {
        const auto bare = material(model, R"("index": "Al")").at(grid);
        const auto none = material(model, R"("index": "Al", "films": [])").at(grid);
        const auto thin =
            material(model, R"("index": "Al", "films": [{"index": "SiO2", "thickness_um": 0}])").at(grid);
        const auto same =
            material(model, R"("index": "Al", "films": [{"index": "Al", "thickness_um": 3}])").at(grid);
        const auto coated = material(model, R"("index": "Al", )" + oxide).at(grid);
        for (int i = 0; i < 30; ++i) {
            const hts::DirectionPair pair{random.direction(0.1), random.direction(0.1)};
            const auto expected = bare.brdf(pair);
            CHECK(none.brdf(pair) == expected);
            CHECK(thin.brdf(pair) == expected);
            const auto changed = coated.brdf(pair), alike = same.brdf(pair);
            for (std::size_t j = 0; j < expected.size(); ++j) {
                CHECK(alike[j] == Approx(expected[j]).epsilon(2e-6));
                CHECK(changed[j] > 0);
                CHECK(changed[j] != expected[j]);
            }
        }
        const Direction in = Direction::from_degrees(30, 0);
        CHECK(none.albedo(in, 1).total() == bare.albedo(in, 1).total());
        CHECK(coated.albedo(in, 1).total() < bare.albedo(in, 1).total());
        CHECK(same.albedo(in, 1).total() == Approx(bare.albedo(in, 1).total()).epsilon(1e-5));
    }
}

TEST_CASE("samplers draw what films reflect") {
    for (const std::string& model : {he, unified, walter, ashikhmin}) {
        const auto coated = material(model, R"("index": "Al", )" + oxide).at(grid);
        const auto sampler = coated.sampler(1);
        const Direction in = Direction::from_degrees(40, 0);
        hts::Random random{7};
        double sum = 0, squares = 0;
        constexpr int count = 40000;
        for (int i = 0; i < count; ++i) {
            const double weight = sampler.sample(in, random.uniforms()).weight;
            sum += weight;
            squares += weight * weight;
        }
        const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
        INFO(model << ", mean " << mean << ", albedo " << coated.albedo(in, 1).total());
        CHECK(std::abs(mean - coated.albedo(in, 1).total()) < 5 * error + 1e-3);
    }
}

TEST_CASE("light passes a coated glass as its films let it") {
    const std::string index = R"("index": {"n": 1.5, "k": 0})";
    const auto green = Wavelength::from_micrometres(0.5);
    const auto of = [&](const std::string& films) { return material(walter, index + films).at(green); };
    // straight through facets: T of the stack over that of the bare glass
    const Direction in = Direction::from_degrees(0, 0), behind = Direction::from_degrees(0, 180);
    const double bare = of("").btdf({in, behind})[0];
    const double quarter =
        of(R"(, "films": [{"index": {"n": 1.224744871391589, "k": 0}, "thickness_um": 0.10206207261596575}])")
            .btdf({in, behind})[0];
    CHECK(bare / quarter == Approx(0.96).epsilon(1e-12));
    const auto metal = of(R"(, "films": [{"index": "Al", "thickness_um": 0.02}])");
    CHECK(metal.transmits(0));
    CHECK(metal.btdf({in, behind})[0] < 0.2 * bare);
    CHECK(metal.btdf({in, behind})[0] > 0);
    // what a bare film lets through, and what an exterior denser than the film does
    const auto dense =
        material(
            walter,
            index + R"(, "exterior_index": 1.7, "films": [{"index": {"n": 1.5, "k": 0}, "thickness_um": 2}])")
            .at(green);
    const auto plain = material(walter, index + R"(, "exterior_index": 1.7)").at(green);
    const Direction out = Direction::from_degrees(20, 175);
    CHECK(dense.btdf({in, out})[0] == Approx(plain.btdf({in, out})[0]).epsilon(1e-10));
    CHECK(dense.brdf({in, out})[0] == Approx(plain.brdf({in, out})[0]).epsilon(1e-10));
}

TEST_CASE("the substrate of a coated surface may be overridden, and its films stay") {
    const auto green = Wavelength::from_micrometres(0.5);
    const Material coated = material(he, R"("index": "Al", )" + oxide);
    const Material other = material(he, R"("index": {"n": 2, "k": 3}, )" + oxide);
    hts::spectral::EvaluationOptions options;
    options.instead.n = 2;
    options.instead.k = 3;
    const hts::DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(20, 170)};
    CHECK(coated.at(green, options).brdf(pair) == other.at(green).brdf(pair));
    CHECK(coated.substance() == "Al under Al2O3 0.05 um");
    CHECK_THROWS_WITH(coated.at(Wavelength::from_micrometres(30)), Contains("Al2O3"));
}

TEST_CASE("films that cannot be are refused by file and key") {
    const auto film = [](const std::string& index, const std::string& thickness) {
        return R"("index": "Al", "films": [{"index": )" + index + R"(, "thickness_um": )" + thickness + "}]";
    };
    for (const std::string& model : {he, unified, walter, ashikhmin}) {
        refuses(model, film(R"("SiO2")", "-0.1"),
                R"(key "films[1].thickness_um": film thickness -0.1 um: must be from 0 to 1000)");
        refuses(model, film(R"("SiO2")", "1e6"), "from 0 to 1000");
        refuses(model, film(R"("SiO2")", R"("thin")"), R"(key "films[1].thickness_um")");
        refuses(model, film(R"("SiO3")", "0.1"), R"(key "films[1].index": no built-in material "SiO3")");
        refuses(model, film(R"({"n": -1, "k": 0})", "0.1"), R"(key "films[1].index.n")");
        refuses(model, R"("index": "Al", "films": [{"index": "SiO2"}])", "thickness_um");
        refuses(model, R"("index": "Al", "films": [{"index": "SiO2", "thickness_um": 1, "n": 2}])",
                R"(key "films[1].n": not known)");
        refuses(model, R"("index": "Al", "films": {"index": "SiO2", "thickness_um": 1})", R"(key "films")");
        std::string many;
        for (int i = 0; i < 101; ++i)
            many += std::string{i == 0 ? "" : ", "} + R"({"index": "SiO2", "thickness_um": 0.1})";
        refuses(model, R"("index": "Al", "films": [)" + many + "]", R"(key "films": films: 101 of them)");
    }
    refuses(unified, R"("index": "Al", "mirror": "second_order", )" + oxide, "mirror second_order");
    refuses(unified, R"("index": "Al", "polarisation_mixing": true, )" + oxide, "polarisation_mixing");
    CHECK_NOTHROW(material(unified, R"("index": "Al", "mirror": "second_order", "films": [])"));
    refuses(ashikhmin, R"("f0": 0.5, )" + oxide, R"(key "films": must come with index)");
    refuses(R"("model": "lambert", "diffuse_albedo": 0.5)", oxide, R"("films")");
}

TEST_CASE("light from the whole hemisphere") {
    const auto green = Wavelength::from_micrometres(0.5);
    const auto lambert =
        material_from_text(R"({"model": "lambert", "diffuse_albedo": 0.3})", "m.json").at(green);
    CHECK(bihemispherical_reflectance(lambert, 0).total() == Approx(0.3).epsilon(1e-6));
    const auto rough = material(he, R"("index": "Al", "diffuse_albedo": 0.01)").at(green);
    const auto& at = rough.samples()[0];
    const auto expected =
        hts::spectral::bihemispherical_reflectance(*rough.properties().surface, at.index, green);
    const auto mean = bihemispherical_reflectance(rough, 0);
    CHECK(mean.specular == Approx(expected.specular).margin(2e-5));
    CHECK(mean.directional_diffuse == Approx(expected.directional_diffuse).margin(2e-5));
    CHECK(mean.uniform_diffuse == Approx(0.01));
}
