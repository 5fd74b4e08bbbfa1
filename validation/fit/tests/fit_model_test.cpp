#include "validation/fit/fit_model.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "fit_samples.hpp"

using namespace hts;
using namespace hts::validation;
using namespace hts::validation::testing;

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

TEST_CASE("every model that is registered can be fitted") {
    for (const spectral::ModelEntry& entry : spectral::built_in_models()) {
        INFO(entry.name);
        CHECK(std::ranges::find(fit_families(), entry.name, &FitFamily::model) != fit_families().end());
    }
}
