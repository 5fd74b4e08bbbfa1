#include "validation/fit/fit.hpp"

#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <sstream>

#include "hts/error.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/tests/support/comparison.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/model_evaluator.hpp"
#include "spectral/models/reflectance.hpp"
#include "validation/fit/fit_problem.hpp"

namespace {

using namespace hts;
using namespace hts::validation;
using Catch::Contains;
using Catch::StartsWith;
using hts::testing::Random;

const auto one_micron = spectral::WavelengthGrid::from_micrometres({1.0});

/// Pairs in the plane of incidence, as goniometers measure them.
std::vector<DirectionPair> in_plane() {
    std::vector<DirectionPair> pairs;
    for (const double theta_i : {10.0, 30.0, 50.0, 70.0}) {
        for (double theta_r = -75; theta_r < 80; theta_r += 5) {
            pairs.push_back({Direction::from_degrees(theta_i, 0),
                             Direction::from_degrees(std::abs(theta_r), theta_r < 0 ? 0 : 180)});
        }
    }
    return pairs;
}

/// Pairs all over the hemisphere, half of them within 15 degrees of the mirror direction, where lobes are.
std::vector<DirectionPair> all_around(int count) {
    Random random{5};
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < count; ++i) {
        const double theta = random.uniform(0, 85), phi = random.uniform(0, 360);
        const bool near = i % 2 == 0;
        const double out =
            near ? std::clamp(theta + random.uniform(-15, 15), 0.0, 85.0) : random.uniform(0, 85);
        const double turn = near ? phi + 180 + random.uniform(-15, 15) : random.uniform(0, 360);
        pairs.push_back({Direction::from_degrees(theta, phi), Direction::from_degrees(out, turn)});
    }
    return pairs;
}

/// A standard normal number.
double gaussian(Random& random) {
    return std::sqrt(-2 * std::log(random.uniform(1e-12, 1))) *
           std::cos(random.uniform(0, 6.283185307179586));
}

/// What an instrument with noise in proportion to the value would show.
FitData seen(const spectral::Material& material, const std::vector<DirectionPair>& pairs, double noise,
             const spectral::WavelengthGrid& grid = one_micron) {
    Random random{11};
    const auto reflectance = material.at(grid, {.tolerance = Tolerance{hts::accuracy::finest_tolerance}});
    std::vector<FitSample> samples;
    std::vector<double> spectrum(grid.size());
    for (const DirectionPair& pair : pairs) {
        reflectance.brdf(pair, spectrum);
        for (std::size_t w = 0; w < grid.size(); ++w) {
            const double value = spectrum[w] * (1 + noise * gaussian(random));
            samples.push_back({pair, w, value, noise * spectrum[w]});
        }
    }
    return fit_data("synthetic", grid, samples);
}

spectral::Material he(double rms, double length, double albedo) {
    return spectral::he_torrance_material("synthetic", {rms, length}, spectral::built_in_optical_constants("Al"),
                                          spectral::DiffuseAlbedo{albedo});
}

/// A model that is the same at every wavelength.
template <ReflectanceModel Model>
spectral::Material constantly(const Model& model) {
    return spectral::material_of([=](const Wavelength&, spectral::OutsideRange) { return model; });
}

spectral::Material material_of(const FitModel& model, const std::vector<double>& values) {
    return spectral::material_from_text(model.material_text(values, model.name()), "");
}

std::string in_words(const Fit& fit) {
    std::ostringstream text;
    for (const auto& p : fit.parameters) {
        text << p.name << " = " << p.value << " +- " << p.standard_error << ' ' << p.unit << " ("
             << name(p.outcome) << ")\n";
    }
    text << "rms log " << fit.statistics.rms_log << ", starts " << fit.starts_at_best << " of "
         << fit.starts.size() << '\n';
    for (const auto& statement : fit.statements) text << statement << '\n';
    return text.str();
}

}  // namespace

TEST_CASE("He-Torrance parameters come back from noisy data") {
    const auto [rms, length, albedo] =
        GENERATE(table<double, double, double>({{0.05, 0.8, 0.02}, {0.2, 1.5, 0.1}, {0.35, 2.0, 0.3}}));
    const auto data = seen(he(rms, length, albedo), in_plane(), 0.01);
    const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = Residual::weighted}, data);
    INFO(in_words(fit));
    CHECK(fit.parameter("sigma0").value == Approx(rms).epsilon(0.01));
    CHECK(fit.parameter("tau").value == Approx(length).epsilon(0.01));
    CHECK(fit.parameter("a").value == Approx(albedo).epsilon(0.01));
    for (const auto& [name, truth] :
         std::map<std::string, double>{{"sigma0", rms}, {"tau", length}, {"a", albedo}}) {
        const auto& found = fit.parameter(name);
        CHECK(std::abs(found.value - truth) < 4 * found.standard_error);
    }
    CHECK(fit.statistics.reduced_chi_squared.value() == Approx(1).margin(0.25));
    CHECK(fit.starts_at_best >= 2);
}

TEST_CASE("optical constants and scale come back where they are asked for") {
    const auto truth = spectral::he_torrance_material(
        "glass", {0.1, 1.2}, spectral::OpticalConstants::constant({1.6, 0}), spectral::DiffuseAlbedo{0.2});
    auto data = seen(truth, in_plane(), 0.002);
    for (double& value : data.values) value *= 1.3;
    const Fit fit = fitted({.model = "he", .freed = {"scale"}, .residual = Residual::relative}, data);
    INFO(in_words(fit));
    for (const auto& [name, expected] :
         std::map<std::string, double>{{"n", 1.6}, {"scale", 1.3}, {"sigma0", 0.1}}) {
        CHECK(fit.parameter(name).value == Approx(expected).epsilon(0.03));
        CHECK(std::abs(fit.parameter(name).value - expected) < 4 * fit.parameter(name).standard_error);
    }
}

TEST_CASE("albedos come back channel by channel") {
    const auto grid = spectral::WavelengthGrid::from_micrometres({0.46, 0.55, 0.65});
    const spectral::DiffuseAlbedo albedo{spectral::PiecewiseLinear{{{0.46, 0.5}, {0.55, 0.2}, {0.65, 0.05}}}};
    const auto truth = spectral::he_torrance_material("paint", {0.12, 1.5},
                                                      spectral::built_in_optical_constants("Al"), albedo);
    const auto data = seen(truth, in_plane(), 0.01, grid);
    const Residual residual = GENERATE(Residual::relative, Residual::logarithmic);
    const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = residual}, data);
    INFO(in_words(fit));
    CHECK(fit.parameter("sigma0").value == Approx(0.12).epsilon(0.01));
    CHECK(fit.parameter("a@0.46um").value == Approx(0.5).epsilon(0.01));
    CHECK(fit.parameter("a@0.55um").value == Approx(0.2).epsilon(0.01));
    CHECK(fit.parameter("a@0.65um").value == Approx(0.05).epsilon(0.02));
}

TEST_CASE("Kurt's parameters come back to 1 % with 1 % noise") {
    const std::vector<WeightedLobe<KurtLobe>> lobes{{0.3, KurtLobe{0.1, 0.12, 0.3, 0.2}}};
    const auto data = seen(constantly(Kurt{0.1, lobes}), all_around(1500), 0.01);
    const Fit fit = fitted({.model = "kurt", .freed = {"my"}, .residual = Residual::weighted}, data);
    INFO(in_words(fit));
    const std::map<std::string, double> truth{{"kd", 0.1},  {"ks", 0.3}, {"f0", 0.1},
                                              {"mx", 0.12}, {"my", 0.3}, {"alpha", 0.2}};
    for (const auto& [name, value] : truth) {
        INFO(name);
        CHECK(fit.parameter(name).value == Approx(value).epsilon(0.01));
    }
}

TEST_CASE("two lobes are told apart") {
    const std::vector<WeightedLobe<KurtLobe>> lobes{{0.3, KurtLobe{0.8, 0.08, 0.08, 0}},
                                                    {0.5, KurtLobe{0.8, 0.4, 0.4, 0}}};
    const auto data = seen(constantly(Kurt{0.05, lobes}), in_plane(), 0.01);
    const Fit fit = fitted(
        {.model = "kurt", .lobes = 2, .fixed = {{"f0", 0.8}, {"alpha", 0}}, .residual = Residual::relative},
        data);
    INFO(in_words(fit));
    const bool narrow_first = fit.parameter("mx1").value < fit.parameter("mx2").value;
    CHECK(fit.parameter(narrow_first ? "mx1" : "mx2").value == Approx(0.08).epsilon(0.01));
    CHECK(fit.parameter(narrow_first ? "mx2" : "mx1").value == Approx(0.4).epsilon(0.01));
    CHECK(fit.parameter(narrow_first ? "ks1" : "ks2").value == Approx(0.3).epsilon(0.02));
    CHECK(fit.parameter("kd").value == Approx(0.05).epsilon(0.02));
}

TEST_CASE("every model finds its own parameters again") {
    for (const FitFamily& family : fit_families()) {
        INFO(family.name);
        if (family.costly && !hts::testing::exhaustive()) continue;
        const FitModel model{family.name, {1, {1.0}, {0}, ""}};
        std::vector<double> values;
        for (const FitParameter& parameter : model.parameters()) {
            const auto& starts = parameter.range.starts;
            double value = starts[starts.size() / 2] * 1.17;
            if (parameter.range.symbol == "tau") value *= values.back();
            if (!parameter.range.tied_to.empty()) value = values.back();
            values.push_back(value);
        }
        const auto data = seen(material_of(model, values), in_plane(), 1e-5);
        FitRequest request{.model = family.name, .residual = Residual::relative, .followed_starts = 4};
        if (family.has_index) request.fixed = {{"n", 1.5 * 1.17}};
        const Fit fit = fitted(request, data);
        INFO(in_words(fit));
        CHECK(fit.statistics.rms_log < 2e-5);
        for (std::size_t i = 0; i < values.size(); ++i) {
            CHECK(fit.parameters[i].value == Approx(values[i]).epsilon(2e-3));
        }
    }
}

TEST_CASE("a trial is what the material file of its numbers says, to the bit, and names it") {
    const auto grid = spectral::WavelengthGrid::from_micrometres({0.5, 0.6});
    const Prediction::Job job{grid, {1, 1}, in_plane(), {Direction::from_degrees(30, 0)}};
    for (const FitFamily& family : fit_families()) {
        for (const std::string index : {"", "\"Al\""}) {
            if (!index.empty() && !family.has_index) continue;
            INFO(family.name << " " << index);
            const FitModel model{family.name, {family.lobe.empty() ? 1 : 3, {0.5, 0.6}, {0, 1}, index}};
            std::vector<double> values;
            for (const FitParameter& parameter : model.parameters()) {
                const auto& starts = parameter.range.starts;
                values.push_back(starts.back() * (1 + 0.01 * static_cast<double>(values.size())));
            }
            const auto material = material_of(model, values);
            CHECK(material.name() == family.name);
            CHECK(material.model_name() == family.model);
            CHECK_FALSE(material.model_source().empty());
            const auto reflectance =
                material.at(grid, {.tolerance = Tolerance{hts::accuracy::finest_lane_tolerance}});
            const auto read = Prediction::answer(job, reflectance.evaluator());
            const std::vector<FitTrial> trials(2, {values});
            for (const auto& answer : model.answers(trials, job)) {
                CHECK(answer.brdf == read.brdf);
                CHECK(answer.specular_reflectance == read.specular_reflectance);
            }
        }
    }
}

TEST_CASE("fitted materials of every model keep name and model") {
    const auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01);
    for (const FitFamily& family : fit_families()) {
        if (family.costly) continue;
        const Fit fit = fitted({.model = family.name, .followed_starts = 1, .most_iterations = 1}, data);
        const auto material = fitted_material(fit);
        CHECK(material.name() == "synthetic, fitted " + family.name);
        CHECK(material.model_name() == family.model);
    }
}

TEST_CASE("derivatives of residuals are those of differences") {
    const auto grid = spectral::WavelengthGrid::from_micrometres({0.9, 1.0});
    const auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01, grid);
    for (const std::string model : {"he", "kurt", "ggx"}) {
        for (const Residual residual : {Residual::logarithmic, Residual::relative, Residual::cosine}) {
            for (const Loss loss : {Loss::squares, Loss::huber, Loss::cauchy}) {
                const FitRequest request{.model = model,
                                         .freed = {"scale"},
                                         .residual = residual,
                                         .loss = loss,
                                         .loss_scale = 0.3};
                const FitProblem problem{request, data};
                auto x = problem.completed(problem.starts().front());
                for (double& each : x) each *= 0.97;  // off every bound
                const auto [values, columns] = problem.residuals(x, true);
                REQUIRE(columns.size() == x.size());
                for (std::size_t k = 0; k < x.size(); ++k) {
                    const double step = 1e-4 * std::max(1.0, std::abs(x[k]));
                    auto above = x, below = x;
                    above[k] += step;
                    below[k] -= step;
                    const auto high = problem.residuals(above, false).residuals;
                    const auto low = problem.residuals(below, false).residuals;
                    double error = 0, size = 0;
                    for (std::size_t r = 0; r < high.size(); ++r) {
                        error = std::max(error, std::abs((high[r] - low[r]) / (2 * step) - columns[k][r]));
                        size = std::max(size, std::abs(columns[k][r]));
                    }
                    INFO(model << ", " << name(residual) << ", " << name(loss) << ", "
                               << problem.places()[problem.free()[k]].parameter.name);
                    CHECK(error < 2e-2 * size);
                }
            }
        }
    }
}

TEST_CASE("every model that is registered can be fitted") {
    for (const spectral::ModelEntry& entry : spectral::built_in_models()) {
        INFO(entry.name);
        CHECK(std::ranges::find(fit_families(), entry.name, &FitFamily::model) != fit_families().end());
    }
}

TEST_CASE("wild values do not mislead a robust fit") {
    auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01);
    for (std::size_t i = 0; i < data.values.size(); i += 15) data.values[i] *= 5;
    FitRequest request{.model = "he", .index = "\"Al\"", .loss_scale = 0.03};
    const double plain = std::abs(fitted(request, data).parameter("a").value - 0.1);
    request.loss = GENERATE(Loss::huber, Loss::cauchy);
    const Fit robust = fitted(request, data);
    CHECK(std::abs(robust.parameter("a").value - 0.1) < 0.2 * plain);
    CHECK(robust.parameter("sigma0").value == Approx(0.2).epsilon(0.02));
}

TEST_CASE("a very rough surface shows its slope alone, and the fit says so") {
    const auto data = seen(he(8, 80, 0.05), in_plane(), 0.01);
    const Fit fit = fitted({.model = "he", .index = "\"Al\"", .residual = Residual::relative}, data);
    INFO(in_words(fit));
    REQUIRE_FALSE(fit.statements.empty());
    CHECK_THAT(fit.statements.front(), StartsWith("sigma0 and tau apart: only sigma0/tau = 0.1"));
    CHECK(fit.parameter("sigma0").value / fit.parameter("tau").value == Approx(0.1).epsilon(0.01));
    CHECK(fit.parameter("sigma0").standard_error > 0.3 * fit.parameter("sigma0").value);
}

TEST_CASE("albedo against scale cannot be told from a matt surface") {
    const auto data = seen(constantly(LambertianModel{0.4}), in_plane(), 0.01);
    const Fit fit = fitted({.model = "lambert", .freed = {"scale"}, .residual = Residual::relative}, data);
    INFO(in_words(fit));
    REQUIRE_FALSE(fit.statements.empty());
    CHECK_THAT(fit.statements.front(), StartsWith("a and scale apart: only a scale = 0.4 +-"));
    CHECK(std::isinf(fit.parameter("a").standard_error));
}

TEST_CASE("a fit stays within bounds and says where it ended at one") {
    const auto data = seen(he(0.2, 1.5, 0), in_plane(), 0.01);
    for (const FittedParameter& p : fitted({.model = "oren_nayar"}, data).parameters) {
        CHECK(p.value >= p.lowest);
        CHECK(p.value <= p.highest);
    }
    const Fit fit = fitted({.model = "kurt", .residual = Residual::cosine}, data);
    CHECK(fit.parameter("alpha").value >= 0);
    for (const FittedParameter& p : fit.parameters) {
        CHECK(p.value >= p.lowest);
        CHECK(p.value <= p.highest);
        const bool said =
            std::ranges::find(fit.statements, p.name + ": ended at its bound") != fit.statements.end();
        CHECK(said == (p.outcome == Outcome::at_bound));
    }
}

TEST_CASE("a fit has the same bits for any number of threads") {
    const auto data = seen(he(0.2, 1.5, 0.1), in_plane(), 0.05);
    const FitRequest request{.model = "kurt", .residual = Residual::relative, .followed_starts = 3};
    omp_set_num_threads(1);
    const Fit one = fitted(request, data);
    omp_set_num_threads(3);
    const Fit three = fitted(request, data);
    omp_set_num_threads(omp_get_num_procs());
    CHECK(one.material == three.material);
    CHECK(one.predicted == three.predicted);
    CHECK(one.statistics.cost == three.statistics.cost);
}

TEST_CASE("what cannot be fitted is named") {
    const auto good = seen(he(0.2, 1.5, 0.1), in_plane(), 0.01);
    CHECK_THROWS_WITH(fitted({.model = "gloss"}, good),
                      Contains("model \"gloss\" is not known: must be one of he, "));
    CHECK_THROWS_WITH(
        fitted({.model = "he", .fixed = {{"gloss", 1}}}, good),
        Contains("parameter \"gloss\" of model \"he\" is not known: must be one of sigma0, tau, a"));
    CHECK_THROWS_WITH(fitted({.model = "he", .starts = {{"sigma0", 5000}}}, good),
                      Contains("sigma0: start 5000 um: must be 1e-04 ... 1000"));
    CHECK_THROWS_WITH(fitted({.model = "he", .fixed = {{"a", -0.1}}}, good),
                      Contains("a: fixed at -0.1: must be 0 ... 1"));
    CHECK_THROWS_WITH(fitted({.model = "lambert", .lobes = 2}, good), Contains("has no lobes"));
    CHECK_THROWS_WITH(fitted({.model = "kurt", .lobes = 4}, good), Contains("4 lobes: must be 1 ... 3"));
    CHECK_THROWS_WITH(fitted({.model = "kurt", .index = "\"Al\""}, good), Contains("has no index"));
    CHECK_THROWS_WITH(fitted({.model = "he", .index = "\"Unobtainium\""}, good), Contains("Unobtainium"));

    const std::vector<FitSample> few{
        {in_plane()[0], 0, 0.1, 0}, {in_plane()[1], 0, 0.1, 0}, {in_plane()[2], 0, 0.1, 0}};
    CHECK_THROWS_WITH(fitted({.model = "he", .index = "\"Al\""}, fit_data("three", one_micron, few)),
                      Contains("three: 3 values for 3 free parameters: must be more"));
    CHECK_THROWS_WITH(
        fitted({.model = "lambert", .residual = Residual::weighted}, fit_data("three", one_micron, few)),
        Contains("no uncertainties"));
    const auto bad = [&](double value, double uncertainty, std::size_t wavelength) {
        auto samples = few;
        samples[1] = {in_plane()[1], wavelength, value, uncertainty};
        return fit_data("bad", one_micron, samples);
    };
    CHECK_THROWS_WITH(bad(std::nan(""), 0, 0),
                      Contains("bad: sample 2: value nan: must be a finite number >= 0"));
    CHECK_THROWS_WITH(bad(-1, 0, 0), Contains("must be a finite number >= 0"));
    CHECK_THROWS_WITH(bad(1, 0.1, 0), Contains("bad: sample 1: uncertainty 0"));
    CHECK_THROWS_WITH(bad(1, 0, 7), Contains("wavelength 7: must be one of the grid's 1"));
    CHECK_THROWS_WITH(fitted({.model = "lambert"}, bad(0, 0, 0)),
                      Contains("value 2 is 0: must be > 0 for log residuals"));
}
