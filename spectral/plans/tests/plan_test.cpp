// Plans: that the choice is what an independent measurement says it is, the same every time, and refused
// where it does not belong.

#include "spectral/plans/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "plan_cases.hpp"
#include "spectral/colour/colour_difference.hpp"

using hts::DiffuseLobe;
using hts::Direction;
using hts::DirectionPair;
using hts::Surface;
using hts::testing::Random;
using hts::testing::WorstCase;
using namespace hts::spectral;
using namespace hts::spectral::testing;

namespace {

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
            const double all = sample.index.amplitudes(pair.in.cos_theta()).unpolarised_reflectance() *
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

TEST_CASE("the specular term is dropped only where it does not count, and then is zero") {
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
