// Plans: that the choice is what an independent measurement says it is, the same every time, and refused where it
// does not belong.

#include "spectral/plans/plan.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "spectral/colour/colour_difference.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "temporary_folder.hpp"

using hts::DiffuseLobe;
using hts::Direction;
using hts::DirectionPair;
using hts::Surface;
using hts::testing::complaint;
using hts::testing::Random;
using hts::testing::TemporaryFolder;
using hts::testing::WorstCase;
using namespace hts::spectral;

namespace {

constexpr double degree = std::numbers::pi / 180;
const std::filesystem::path examples = HTS_SOURCE_DIR "/cli/data";

Material metal(const std::string& name, double rms_roughness, double correlation_length, double albedo = 0) {
    return he_torrance_material(name, Surface{rms_roughness, correlation_length},
                                built_in_optical_constants("Al"), DiffuseAlbedo{albedo});
}

Scene spectral_scene(const std::vector<Material>& materials, double tolerance) {
    return {"scene.json",
            materials,
            WavelengthGrid::linear(0.4, 0.7, 4),
            OutsideRange::error,
            60 * degree,
            60 * degree,
            false,
            std::nullopt,
            ErrorMeasure::relative_brdf_error,
            tolerance,
            std::nullopt};
}

Scene rgb_scene(const std::vector<Material>& materials, double delta_e) {
    Scene scene = spectral_scene(materials, delta_e);
    scene.wavelengths = WavelengthGrid::linear(0.4, 0.7, 31);
    scene.illuminant = Illuminant::D65;
    scene.measure = ErrorMeasure::delta_e_2000;
    return scene;
}

Plan plan_of(const Scene& scene, std::size_t pairs = 1000) {
    return make_plan(scene, {1, pairs}, scene.tolerance);
}

/// A pair within a scene, drawn otherwise than the planner draws: every other one within 6 degrees of the mirror direction.
DirectionPair random_pair(Random& random, const Scene& scene, bool near_mirror) {
    const double theta_i = random.uniform(0, scene.largest_theta_i), phi_i = random.uniform(0, 6.3);
    const double theta_r =
        near_mirror ? theta_i + random.uniform(-0.1, 0.1) : random.uniform(0, scene.largest_theta_r);
    const double phi_r =
        near_mirror ? phi_i + std::numbers::pi + random.uniform(-0.1, 0.1) : random.uniform(0, 6.3);
    return {Direction::from_angles(theta_i, phi_i),
            Direction::from_angles(std::clamp(theta_r, 0., scene.largest_theta_r), phi_r)};
}

/// The lobe by the model's own functions, without the evaluators that are planned.
double lobe(const Surface& surface, const DirectionPair& pair, const hts::SpectralSample& sample) {
    const hts::PairFactors factors{surface, view(surface, pair.in), view(surface, pair.out)};
    return hts::directional_diffuse(factors, sample.wavelength, sample.index).brdf;
}

/// Its largest value in the plane of incidence, at every degree.
double peak(const Surface& surface, const Scene& scene, const Direction& in,
            const hts::SpectralSample& sample) {
    double largest = 0;
    const double azimuth = std::atan2(in.mirror().sin_phi(), in.mirror().cos_phi());
    for (double theta = 0; theta <= scene.largest_theta_r; theta += degree) {
        largest = std::max(largest, lobe(surface, {in, Direction::from_angles(theta, azimuth)}, sample));
    }
    return largest;
}

/// The relative error of an evaluator as spectral/plans/plan.hpp defines it, measured anew.
double relative_error(const Scene& scene, const Material& material, const Rung& rung) {
    const Reflectance planned = MaterialForms{scene, material}.at(rung).reflectance();
    const Reflectance model = material.at(scene.wavelengths);
    const Surface surface = *material.properties().surface;
    Random random{77};
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        const DirectionPair pair = random_pair(random, scene, i % 2 == 0);
        const auto brdf = planned.brdf(pair);
        const auto mirror = planned.specular_reflectance(pair.in);
        const hts::View light = view(surface, pair.in);
        for (std::size_t j = 0; j < brdf.size(); ++j) {
            const hts::SpectralSample& sample = model.samples()[j];
            const double albedo = sample.uniform_diffuse * std::numbers::pi;
            const double exact = lobe(surface, pair, sample) + sample.uniform_diffuse;
            const double scale = exact + 1e-3 * peak(surface, scene, pair.in, sample);
            if (brdf[j] != exact) worst = std::max(worst, std::abs(brdf[j] - exact) / scale);
            const double rho =
                hts::specular_reflectance(surface, light, sample.wavelength, sample.index).value();
            const double all = hts::fresnel(pair.in.cos_theta(), sample.index).unpolarised_reflectance() *
                               std::pow(light.visibility.shadowing, 2);
            worst = std::max(worst, std::abs(mirror[j].value() - rho) / (all + albedo));
        }
    }
    return worst;
}

/// The same for colours, where none is brighter than the white.
double colour_error(const Scene& scene, const Material& material, const Rung& rung) {
    const PlannedForm planned = MaterialForms{scene, material}.at(rung);
    const Reflectance model = material.at(scene.wavelengths);
    const Xyz white = white_point(*scene.illuminant);
    Random random{78};
    double worst = 0;
    std::vector<double> exact(scene.wavelengths.size()), scratch(planned.at_nodes().size());
    for (int i = 0; i < 400; ++i) {
        const DirectionPair pair = random_pair(random, scene, i % 2 == 0);
        for (std::size_t j = 0; j < exact.size(); ++j) {
            const hts::SpectralSample& sample = model.samples()[j];
            exact[j] = std::numbers::pi *
                       (lobe(*material.properties().surface, pair, sample) + sample.uniform_diffuse);
        }
        const Xyz colour = tristimulus(scene.wavelengths.micrometres(), exact, *scene.illuminant);
        if (colour.Y > 1) continue;
        worst = std::max(
            worst, colour_difference(cielab(planned.colour(pair, scratch), white), cielab(colour, white)));
    }
    return worst;
}

std::vector<Material> one_of_each_regime() {
    return {metal("mirror", 0, 2, 0.1), metal("polished", 0.001, 2), metal("ground", 0.18, 3, 0.05),
            metal("sandblasted", 16, 160)};
}

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream{path}.rdbuf();
    return text.str();
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto position = text.find(what);
    REQUIRE(position != std::string::npos);
    return text.replace(position, what.size(), by);
}

/// Example scene with its tolerance replaced.
Scene figure_14(const char* file, double tolerance, bool polarised = false) {
    Scene scene = read_scene(examples / file);
    scene.tolerance = tolerance;
    scene.polarised = polarised;
    scene.memory_budget.reset();
    return scene;
}

}  // namespace

TEST_CASE("each regime gets its own rung") {
    const Plan plan = plan_of(spectral_scene(one_of_each_regime(), 1e-2));
    const auto rung = [&](std::size_t i) { return plan.materials[i].choice.rung; };
    CHECK(rung(0).lobe == DiffuseLobe::none);
    CHECK(rung(0).specular);
    CHECK(rung(1).lobe == DiffuseLobe::first_order);
    CHECK(rung(1).specular);
    CHECK(rung(2).lobe == DiffuseLobe::full);
    CHECK(rung(2).lobe_tolerance.relative_error() == 1e-3);
    CHECK(rung(2).specular);
    CHECK(rung(3).lobe == DiffuseLobe::rough_limit);
    CHECK_FALSE(rung(3).specular);
}

TEST_CASE("what is chosen meets the tolerance, what was rejected does not, measured independently") {
    for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-7}) {
        const Scene scene = spectral_scene(one_of_each_regime(), tolerance);
        const Plan plan = plan_of(scene);
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            const Material& material = scene.materials[i];
            INFO(material.name() << ", tolerance " << tolerance);
            CHECK(plan.materials[i].choice.error.worst <= plan_headroom * tolerance);
            CHECK(relative_error(scene, material, plan.materials[i].choice.rung) <= tolerance);
            for (const MeasuredRung& rejected : plan.materials[i].rejected) {
                INFO(name(rejected.rung.lobe) << " at " << rejected.rung.lobe_tolerance.relative_error());
                CHECK(rejected.error.worst > plan_headroom * tolerance);
                CHECK(relative_error(scene, material, rejected.rung) > plan_headroom * tolerance / 10);
            }
        }
    }
}

TEST_CASE("a colour takes as few wavelengths as its tolerance allows") {
    const std::vector<Material> materials{
        he_torrance_material("copper", Surface{0.13, 1.2}, built_in_optical_constants("Cu")),
        he_torrance_material("paint", Surface{0, 2}, OpticalConstants::constant({1.5, 0}),
                             DiffuseAlbedo{0.3})};
    std::size_t wavelengths = 1;
    for (const double delta_e : {3., 1., 0.1}) {
        const Scene scene = rgb_scene(materials, delta_e);
        const Plan plan = plan_of(scene);
        const Rung& copper = plan.materials[0].choice.rung;
        INFO("delta E " << delta_e << ": " << copper.wavelengths.size() << " wavelengths");
        CHECK(copper.wavelengths.size() > wavelengths);
        CHECK(copper.wavelengths.micrometres().front() == 0.4);
        CHECK(copper.wavelengths.micrometres().back() == 0.7);
        CHECK(colour_error(scene, materials[0], copper) <= delta_e);
        CHECK(plan.materials[1].choice.rung.wavelengths.size() == 1);
        CHECK(plan.materials[1].choice.rung.lobe == DiffuseLobe::none);
        CHECK(colour_error(scene, materials[1], plan.materials[1].choice.rung) <= 1e-9);
        wavelengths = copper.wavelengths.size();
    }
    CHECK(wavelengths < 31);
}

TEST_CASE("the four surfaces of Fig. 14 get four different plans") {
    const Plan plan = plan_of(read_scene(examples / "figure-14.json"));
    std::vector<std::string> kinds;
    for (std::size_t i = 0; i < 4; ++i) {
        const Rung& rung = plan.materials[i].choice.rung;
        std::ostringstream kind;
        kind << name(rung.lobe) << rung.lobe_tolerance.relative_error() << rung.specular
             << rung.wavelengths.size()
             << (plan.scene.materials[i].at(rung.wavelengths).uniform_diffuse()[0] > 0);
        kinds.push_back(kind.str());
    }
    std::sort(kinds.begin(), kinds.end());
    CHECK(std::unique(kinds.begin(), kinds.end()) == kinds.end());
    CHECK(plan.bytes() <= *plan.scene.memory_budget);
}

TEST_CASE("errors stay below the tolerance when measured again with other seeds") {
    const bool long_run = hts::testing::exhaustive();
    const std::size_t pairs = long_run ? 8192 : 600;
    std::vector<Scene> scenes;
    for (const double tolerance : {0.3, 1e-2, 1e-4, 1e-6, 1e-10}) {
        scenes.push_back(figure_14("figure-14-spectral.json", tolerance));
    }
    for (const double delta_e : {3., 1., 0.1}) scenes.push_back(figure_14("figure-14.json", delta_e));
    for (const double tolerance : {1e-2, 1e-6}) {
        scenes.push_back(figure_14("figure-14-spectral.json", tolerance, true));
    }
    WorstCase worst{"re-measured error of plans over their tolerance", 1};
    for (const Scene& scene : scenes) {
        const Plan plan = plan_of(scene, pairs);
        for (std::uint64_t seed = 2; seed < (long_run ? 12U : 4U); ++seed) {
            const auto errors = measured_errors(plan, {seed, 2 * pairs});
            for (std::size_t i = 0; i < errors.size(); ++i) {
                CHECK(errors[i].percentile_99 <= errors[i].worst);
                worst.note(errors[i].worst / scene.tolerance, [&] {
                    std::ostringstream where;
                    where << plan.materials[i].name << ", " << name(scene.measure) << ' ' << scene.tolerance
                          << ", seed " << seed;
                    return where.str();
                });
            }
        }
    }
    worst.check();
}

TEST_CASE("a finer tolerance never takes a coarser lobe") {
    double coarsest = 1;
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-9}) {
        const Plan plan = plan_of(spectral_scene({metal("ground", 0.18, 3)}, tolerance));
        const Rung& rung = plan.materials[0].choice.rung;
        CHECK(rung.lobe == DiffuseLobe::full);
        CHECK(rung.lobe_tolerance.relative_error() <= coarsest);
        coarsest = rung.lobe_tolerance.relative_error();
    }
    CHECK(coarsest == 1e-12);
}

TEST_CASE("plans and their files are the same for any number of threads") {
    const Scene scene = rgb_scene({metal("ground", 0.18, 3)}, 1);
    const int before = omp_get_max_threads();
    std::vector<std::string> texts;
    for (const int threads : {1, 2, 3, 1}) {
        omp_set_num_threads(threads);
        texts.push_back(plan_text(plan_of(scene), ""));
    }
    omp_set_num_threads(before);
    CHECK(std::count(texts.begin(), texts.end(), texts[0]) == 4);
}

TEST_CASE("the mirror term is dropped only where it does not count, and then is zero") {
    const Plan plan =
        plan_of(spectral_scene({metal("sandblasted", 16, 160), metal("ground", 0.18, 3)}, 1e-2));
    const auto planned = plan.reflectances();
    const Direction in = Direction::from_degrees(30, 0);
    CHECK(planned[0].specular_reflectance(in)[0].value() == 0);
    CHECK(planned[1].specular_reflectance(in)[3].value() > 0);
    const PlannedForm& ground = plan.materials[1].form;
    std::vector<double> scratch(ground.at_nodes().size());
    CHECK_THROWS_WITH(ground.colour({in, in}, scratch), "ground: no colour: the scene's output must be rgb");
}

TEST_CASE("a memory budget is kept or refused") {
    const std::vector<Material> materials{metal("mirror", 0, 2), metal("ground", 0.18, 3)};
    Scene scene = spectral_scene(materials, 1e-2);
    const std::size_t bytes = plan_of(scene).bytes();
    CHECK(bytes > hts::phi_table_bytes(hts::Tolerance{1e-3}));
    scene.memory_budget = bytes;
    CHECK(plan_of(scene).bytes() == bytes);
    scene.memory_budget = bytes - 1;
    CHECK_THROWS_WITH(plan_of(scene),
                      "scene.json: key \"memory_budget_bytes\": " + std::to_string(bytes - 1) +
                          ": must be >= " + std::to_string(bytes) +
                          ", what the smallest plan within the tolerance takes");
    CHECK_THROWS_AS(make_plan(scene, {}, 2), hts::Error);
    CHECK_THROWS_WITH(make_plan(scene, {~0ULL, 10}, 0.1),
                      "seed 18446744073709551615: must be from 0 to 2^53");
    CHECK_THROWS_WITH(make_plan(scene, {1, 0}, 0.1), "number of pairs 0: must be from 1 to 10000000");
}

TEST_CASE("a plan file gives the plan back") {
    const TemporaryFolder folder;
    std::filesystem::copy(examples / "figure-14", folder.path() / "figure-14",
                          std::filesystem::copy_options::recursive);
    std::filesystem::copy(examples / "figure-14.json", folder.path() / "scene.json");
    const Plan plan = plan_of(read_scene(folder.path() / "scene.json"));
    std::filesystem::create_directory(folder.path() / "plans");
    const std::string text = plan_text(plan, folder.path() / "plans");
    const auto path = folder.write("plans/plan.json", text);
    const Plan read = read_plan(path);
    CHECK(plan_text(read, folder.path() / "plans") == text);

    const auto before = plan.reflectances(), after = read.reflectances();
    const DirectionPair pair{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(before[i].name() == after[i].name());
        CHECK(before[i].brdf(pair) == after[i].brdf(pair));
        CHECK(before[i].bytes() == after[i].bytes());
    }

    const auto refusal = [&](const std::string& what, const std::string& by) {
        folder.write("plans/plan.json", replaced(text, what, by));
        return complaint(folder, [&] { static_cast<void>(read_plan(path)); });
    };
    CHECK(refusal(R"("hts plan")", R"("recipe")") ==
          R"(plans/plan.json: key "format": "recipe": must be "hts plan")");
    CHECK(
        refusal(R"("format_version": 1)", R"("format_version": 2)") ==
        R"(plans/plan.json: key "format_version": 2: the plan was made for another format than 1; plan the scene again)");
    CHECK(refusal(R"("library_version": ")", R"("library_version": "9)")
              .find("another version of the library") != std::string::npos);
    CHECK(refusal(R"("../scene.json")", R"("../none.json")") ==
          R"(plans/plan.json: key "scene": plans/../none.json: no such file)");
    CHECK(
        refusal(R"("full")", R"("half")") ==
        R"(plans/plan.json: key "materials[1].choice.lobe": "half": must be none, first_order, rough_limit or full)");
    CHECK(refusal(R"("seed": 1)", R"("seed": -1)").find(R"(key "seed": -1: must be a whole number)") !=
          std::string::npos);
    CHECK(
        refusal("0.4,", "0.39,") ==
        R"(plans/plan.json: key "materials[1].choice.wavelengths_um": must be from 0.4 to 0.7 um, the range of the scene)");

    folder.write("plans/plan.json", text);
    const std::string sphere = text_of(folder.path() / "figure-14/copper-sphere.json");
    folder.write("figure-14/copper-sphere.json", replaced(sphere, "0.13", "0.14"));
    const std::string changed = complaint(folder, [&] { static_cast<void>(read_plan(path)); });
    INFO(changed);
    CHECK(changed.starts_with(R"(plans/plan.json: key "scene_fingerprint": )"));
    CHECK(changed.find(
              "the plan was made for another scene, or plans/../scene.json or its materials have changed") !=
          std::string::npos);
}

namespace {

/// A scene of models that leave waves out; the last two do not depend on wavelength.
std::string scene_of_every_kind(const std::string& rest) {
    return R"({"materials": [
        {"name": "gold", "model": "walter", "distribution": "ggx", "alpha": 0.3, "index": "Au"},
        {"name": "brushed", "model": "ward", "kd": {"table": [[0.4, 0.1], [0.55, 0.5], [0.7, 0.2]]},
         "lobes": [{"ks": 0.2, "mx": 0.1, "my": 0.4}]},
        {"name": "velvet", "model": "ashikhmin", "f0": 0.04, "diffuse_albedo": 0.3,
         "normals": {"type": "gaussian", "sigma_x": 0.4, "sigma_y": 0.4}},
        {"name": "paint", "model": "cook_torrance", "kd": 0.5, "lobes": [{"ks": 1e-4, "f0": 0.04, "m": 0.3}]}],
        "wavelengths_um": "0.4:0.7:31", "largest_theta_i_deg": 70, "largest_theta_r_deg": 75, )" +
           rest + "}";
}

/// The largest error of a planned evaluator on pairs of the test's own, against the models at each wavelength.
double error_of_other_model(const Plan& plan, std::size_t i) {
    const Scene& scene = plan.scene;
    const Reflectance model = scene.materials[i].at(scene.wavelengths);
    const PlannedForm& planned = plan.materials[i].form;
    const Xyz white = white_point(Illuminant::D65);
    Random random{79};
    double worst = 0;
    std::vector<double> exact(model.size()), scratch(planned.at_nodes().size());
    for (int k = 0; k < 300; ++k) {
        const DirectionPair pair = random_pair(random, scene, k % 2 == 0);
        const auto brdf = planned.reflectance().brdf(pair);
        model.brdf(pair, exact);
        for (std::size_t j = 0; j < exact.size(); ++j) {
            if (!scene.illuminant) worst = std::max(worst, std::abs(brdf[j] / exact[j] - 1));
        }
        if (!scene.illuminant) continue;
        for (double& value : exact) value *= std::numbers::pi;
        const Xyz colour = tristimulus(scene.wavelengths.micrometres(), exact, Illuminant::D65);
        if (colour.Y > 1) continue;
        worst = std::max(
            worst, colour_difference(cielab(planned.colour(pair, scratch), white), cielab(colour, white)));
    }
    return worst;
}

}  // namespace

TEST_CASE("models other than he are planned by wavelengths and by whether their lobe counts") {
    const TemporaryFolder folder;
    for (const auto& [rest, tolerance] :
         {std::pair{R"("output": "rgb", "tolerance": {"delta_e_2000": 0.5})", 0.5},
          std::pair{R"("output": "spectral", "tolerance": {"relative_brdf_error": 0.02})", 0.02}}) {
        const Plan plan = plan_of(read_scene(folder.write("scene.json", scene_of_every_kind(rest))));
        for (std::size_t i = 0; i < 4; ++i) {
            INFO(plan.materials[i].name << ", " << rest);
            const Rung& rung = plan.materials[i].choice.rung;
            CHECK(error_of_other_model(plan, i) <= tolerance);
            CHECK(rung.lobe == (i == 3 ? DiffuseLobe::none : DiffuseLobe::full));
            CHECK_FALSE(rung.specular);
            if (i < 2) {
                CHECK(rung.wavelengths.size() > 2);
                CHECK(rung.wavelengths.size() < 31);
                CHECK(plan.materials[i].rejected.size() == 2);
            } else {
                CHECK(rung.wavelengths.size() == 1);
            }
            CHECK(plan.materials[i]
                      .form.reflectance()
                      .specular_reflectance(Direction::from_degrees(30, 0))[0]
                      .value() == 0);
        }
        CHECK(plan.bytes() < 20'000);
        const auto path = folder.write("plan.json", plan_text(plan, folder.path()));
        const Plan read = read_plan(path);
        CHECK(plan_text(read, folder.path()) == plan_text(plan, folder.path()));
        const DirectionPair pair{Direction::from_degrees(30, 10), Direction::from_degrees(40, 170)};
        for (std::size_t i = 0; i < 4; ++i)
            CHECK(read.reflectances()[i].brdf(pair) == plan.reflectances()[i].brdf(pair));

        folder.write("scene.json", replaced(scene_of_every_kind(rest), R"("my": 0.4)", R"("my": 0.40001)"));
        CHECK(complaint(folder, [&] { static_cast<void>(read_plan(path)); }).find("another scene") !=
              std::string::npos);
        folder.write("scene.json", scene_of_every_kind(rest));
        folder.write("plan.json", replaced(plan_text(plan, folder.path()), R"("full")", R"("rough_limit")"));
        const std::string refusal = complaint(folder, [&] { static_cast<void>(read_plan(path)); });
        INFO(refusal);
        CHECK(refusal.find("gold: lobe rough_limit: must be full or none") != std::string::npos);
    }
    Scene polarised = read_scene(examples / "figure-14-spectral.json");
    polarised.polarised = true;
    const Material gold = read_material(examples / "rough-gold.json");
    CHECK_THROWS_WITH(full_model(polarised, gold),
                      gold.name() + ": must be of model he: the scene is polarised");
}

TEST_CASE("a scene that compensates energy is planned with it") {
    Scene scene = rgb_scene({metal("ground", 0.18, 0.5, 0.1)}, 1);
    scene.wavelengths = WavelengthGrid::linear(0.4, 0.7, 7);
    const std::string published = fingerprint(scene);
    scene.compensate_energy = true;
    CHECK(fingerprint(scene) != published);
    const Plan plan = plan_of(scene, 300);
    CHECK(plan.materials[0].choice.rung.wavelengths.size() < 7);
    const Reflectance compensated = scene.materials[0].at(scene.wavelengths, {.compensate_energy = true});
    const Direction in = Direction::from_degrees(55, 0);
    std::vector<double> exact(7), mirror(7);
    for (const double degrees : {20., 55., 59.}) {
        const DirectionPair pair{in, Direction::from_degrees(degrees, 170)};
        const auto brdf = plan.reflectances()[0].brdf(pair);
        compensated.brdf(pair, exact);
        for (std::size_t i = 0; i < 7; ++i) CHECK(brdf[i] == Approx(exact[i]).epsilon(0.03));
    }
    scene.compensate_energy = false;
    const auto plain = full_model(scene, scene.materials[0]).reflectance().brdf({in, in.mirror()});
    compensated.brdf({in, in.mirror()}, exact);
    CHECK(exact[3] > 1.05 * plain[3]);  // so that the test above can tell
    CHECK(measured_errors(plan, {2, 300})[0].worst <= 1);

    Scene other = scene;
    other.compensate_energy = true;
    const Material gold = read_material(examples / "rough-gold.json");
    CHECK_THROWS_WITH(full_model(other, gold),
                      gold.name() + ": must be of model he: the scene compensates energy");
}
