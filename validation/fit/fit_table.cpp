#include "validation/fit/fit_table.hpp"

#include <algorithm>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"

namespace hts::validation {
namespace {

bool has_index(const std::string& model) {
    const FitFamily* found = find_family(model);
    return found != nullptr && found->has_index;
}

/// One wavelength stands for a band where the model knows none.
FitSelection without_bands(FitSelection selection) {
    selection.nodes.wavelengths = 1;
    return selection;
}

}  // namespace

std::string ModelChoice::label() const {
    return lobes == 1 ? model : model + " " + std::to_string(lobes) + " lobes";
}

std::vector<ModelChoice> compared_models() {
    std::vector<ModelChoice> result;
    for (const FitFamily& family : fit_families()) {
        if (family.costly) continue;
        result.push_back({family.name});
        if (family.name == "kurt") result.insert(result.end(), {{"kurt", 2}, {"kurt", 3}});
    }
    return result;
}

ModelChoice choice_of(const Fit& fit) {
    return {fit.model, fit.request.lobes};
}

std::vector<Fit> fits_of(const std::vector<ModelChoice>& models, const CurveSet& set,
                         const ComparisonRequest& request) {
    const FitSelection selection = for_residual(request.selection, request.residual, set);
    const FitData with_bands = fit_data(set, selection);
    const FitData plain = fit_data(set, without_bands(selection));
    std::vector<Fit> result;
    const spectral::Job job{"fitting all models", models.size()};
    for (const ModelChoice& choice : models) {
        const bool spectral = has_index(choice.model);
        FitRequest fit{.model = choice.model,
                       .lobes = choice.lobes,
                       .index = spectral ? request.index : "",
                       .residual = request.residual,
                       .followed_starts = request.followed_starts};
        if (set.scale == Scale::unknown) fit.freed.emplace_back("scale");
        const auto fewer = std::ranges::find(result, ModelChoice{choice.model, choice.lobes - 1}, choice_of);
        result.push_back(
            fitted(fit, spectral ? with_bands : plain, fewer == result.end() ? nullptr : &*fewer));
        job.done();
    }
    return result;
}

std::vector<CrossValidation> cross_validations(const std::vector<Fit>& fits, const CurveSet& set,
                                               const FitSelection& selection) {
    std::vector<CrossValidation> result;
    const spectral::Job job{"leaving out angles", fits.size()};
    for (const Fit& fit : fits) {
        result.push_back(
            cross_validated(fit, {&set, 1}, has_index(fit.model) ? selection : without_bands(selection)));
        job.done();
    }
    return result;
}

}  // namespace hts::validation
