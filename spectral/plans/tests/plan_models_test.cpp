// Plans of models other than he, and with energy compensated.

#include <algorithm>
#include <cmath>

#include "plan_cases.hpp"
#include "spectral/colour/colour_difference.hpp"
#include "temporary_folder.hpp"

using hts::DiffuseLobe;
using hts::Direction;
using hts::DirectionPair;
using hts::testing::complaint;
using hts::testing::Random;
using hts::testing::TemporaryFolder;
using namespace hts::spectral;
using namespace hts::spectral::testing;

namespace {

/// A scene of models that leave waves out; the last two do not depend on wavelength.
std::string scene_of_every_kind(const std::string& rest) {
    return R"({"materials": [
        {"name": "gold", "model": "walter", "distribution": "ggx", "alpha": 0.3, "index": "Au"},
        {"name": "brushed", "model": "ward", "kd": {"table": [[0.4, 0.1], [0.55, 0.5], [0.7, 0.2]]},
         "lobes": [{"ks": 0.2, "mx": 0.1, "my": 0.4}]},
        {"name": "velvet", "model": "ashikhmin", "f0": 0.04, "diffuse_albedo": 0.3,
         "normals": {"type": "gaussian", "sigma_x": 0.4, "sigma_y": 0.4}},
        {"name": "paint", "model": "cook_torrance", "kd": 0.5,
         "lobes": [{"ks": 1e-4, "f0": 0.04, "m": 0.3}]}],
        "wavelengths_um": "0.4:0.7:31", "largest_theta_i_deg": 70, "largest_theta_r_deg": 75, )" +
           rest + "}";
}

/// The largest error of a planned evaluator on pairs of the test's own, against the
/// models at each wavelength.
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
                // nothing is cheaper than to interpolate a uniform term
                const bool whole = i == 3 && std::string{rest}.find("spectral") != std::string::npos;
                CHECK(rung.wavelengths.size() == (whole ? 31 : 1));
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
