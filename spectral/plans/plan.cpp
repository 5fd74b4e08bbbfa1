#include "spectral/plans/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/tolerance.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/plans/planning_error.hpp"

namespace hts::spectral {
namespace {

/// A form of the lobe and its cost per wavelength [about a nanosecond]: for the order of the ladder only.
struct LobeForm {
    DiffuseLobe lobe;
    double tolerance;
    double cost;
};
constexpr double specular_cost = 1;
/// Per wavelength of the scene, of a spectrum between fewer; colours need none.
constexpr double interpolation_cost = 1.6;
constexpr std::array lobe_forms{
    LobeForm{DiffuseLobe::none, 1e-3, 1},          LobeForm{DiffuseLobe::first_order, 1e-3, 5},
    LobeForm{DiffuseLobe::rough_limit, 1e-3, 5.5}, LobeForm{DiffuseLobe::full, 1e-3, 9},
    LobeForm{DiffuseLobe::full, 1e-6, 11},         LobeForm{DiffuseLobe::full, 1e-12, 100},
};

struct LadderStep {
    Rung rung;
    double cost;
};

WavelengthGrid equally_spaced_in_inverse_square(double first_um, double last_um, std::size_t count) {
    std::vector<double> um{first_um};
    for (std::size_t i = 1; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        um.push_back(1 / std::sqrt(std::lerp(1 / (first_um * first_um), 1 / (last_um * last_um), share)));
    }
    um.back() = last_um;
    return WavelengthGrid::from_micrometres(std::move(um));
}

/// Wavelengths at which the model may be evaluated: one, some over the scene's range, the scene's.
std::vector<WavelengthGrid> grids(const Scene& scene) {
    const auto um = scene.wavelengths.micrometres();
    const double first = um.front(), last = um.back();
    std::vector<WavelengthGrid> grids;
    if (!scene.polarised && um.size() > 1)
        grids.push_back(WavelengthGrid::from_micrometres({um[um.size() / 2]}));
    for (std::size_t count = 2; !scene.polarised && count < um.size() && count <= PlannedForm::most_nodes;
         ++count) {
        grids.push_back(equally_spaced_in_inverse_square(first, last, count));
        if (count > 2) grids.push_back(WavelengthGrid::linear(first, last, static_cast<int>(count)));
    }
    grids.push_back(scene.wavelengths);
    return grids;
}

/// The least that a model takes beside what its wavelengths share: fewer of them must
/// pay their interpolation.
constexpr std::array whole_or_uniform{LobeForm{DiffuseLobe::none, 1e-12, 1},
                                      LobeForm{DiffuseLobe::full, 1e-12, 3.2}};

/// All evaluators of a material, cheapest first.
///   surface    of a rough surface, whose lobe has limits and tolerances
///   coarsest   tolerance of its full lobe that may be used
std::vector<LadderStep> ladder(const Scene& scene, const std::optional<RoughSurface>& surface,
                               double coarsest) {
    const bool rough = surface.has_value();
    std::vector<LadderStep> steps;
    const std::span<const LobeForm> forms =
        rough ? std::span<const LobeForm>{lobe_forms} : std::span<const LobeForm>{whole_or_uniform};
    for (const WavelengthGrid& grid : grids(scene)) {
        const bool interpolated = grid.size() < scene.wavelengths.size() && !scene.illuminant;
        const double once =
            interpolated ? interpolation_cost * static_cast<double>(scene.wavelengths.size()) : 0;
        for (const LobeForm& form : forms) {
            if (form.lobe == DiffuseLobe::full && form.tolerance > coarsest) continue;
            if (form.lobe == DiffuseLobe::rough_limit && surface->correlation()) continue;  // it has none
            for (const bool specular : {false, true}) {
                if (specular && !rough) continue;
                const double each = form.cost + (specular ? specular_cost : 0);
                steps.push_back({{form.lobe, Tolerance{form.tolerance}, specular, grid},
                                 once + each * static_cast<double>(grid.size())});
            }
        }
    }
    std::stable_sort(steps.begin(), steps.end(),
                     [](const auto& a, const auto& b) { return a.cost < b.cost; });
    return steps;
}

bool same_kind(const Rung& a, const Rung& b) {
    return a.lobe == b.lobe && a.specular == b.specular &&
           a.lobe_tolerance.relative_error() == b.lobe_tolerance.relative_error();
}

/// Keeps the last of each kind of rung, the one nearest to the choice.
void note(std::vector<Rung>& rejected, Rung rung) {
    const auto twin = std::find_if(rejected.begin(), rejected.end(),
                                   [&](const Rung& other) { return same_kind(other, rung); });
    if (twin == rejected.end()) {
        rejected.push_back(std::move(rung));
    } else {
        *twin = std::move(rung);
    }
}

std::vector<MeasuredRung> measured(const MaterialForms& forms, const ErrorMeter& meter,
                                   const std::vector<Rung>& rungs) {
    std::vector<MeasuredRung> result;
    result.reserve(rungs.size());
    for (const Rung& rung : rungs) result.push_back({rung, meter.error(forms.at(rung))});
    return result;
}

PlannedMaterial planned(const Scene& scene, const Material& material, const PlanSampling& sampling,
                        double tolerance, double coarsest) {
    const MaterialForms forms{scene, material};
    const ErrorMeter meter{scene, material, forms, sampling};
    const double enough = plan_headroom * tolerance;
    std::vector<Rung> failed;
    const auto steps = ladder(scene, material.properties().surface, coarsest);
    const Job job{"", steps.size()};
    for (const LadderStep& step : steps) {
        job.done();
        const PlannedForm candidate = forms.at(step.rung);
        if (!meter.fails_early(candidate, enough)) {
            const MeasuredError error = meter.error(candidate);
            if (error.worst <= enough) {
                return {material.name(), {step.rung, error}, measured(forms, meter, failed), candidate};
            }
        }
        note(failed, step.rung);
    }
    throw Error{material.name() +
                ": no evaluator meets the tolerance"};  // the last rung is the full model itself
}

Plan planned(const Scene& scene, const PlanSampling& sampling, double tolerance, double coarsest) {
    Plan plan{scene, tolerance, sampling, {}};
    const Job job{"", scene.materials.size()};
    for (const Material& material : scene.materials) {
        plan.materials.push_back(planned(scene, material, sampling, tolerance, coarsest));
        job.done();
    }
    return plan;
}

/// The tolerances of the tables of Phi that a plan uses.
std::set<double> tables(const Plan& plan) {
    std::set<double> tolerances;
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
        const Rung& rung = plan.materials[i].choice.rung;
        if (rung.lobe == DiffuseLobe::full && rung.table.empty() &&
            plan.scene.materials[i].properties().surface)
            tolerances.insert(rung.lobe_tolerance.relative_error());
    }
    return tolerances;
}

bool fits(const Plan& plan) {
    return !plan.scene.memory_budget || plan.bytes() <= *plan.scene.memory_budget;
}

}  // namespace

std::vector<Reflectance> Plan::reflectances() const {
    std::vector<Reflectance> result;
    result.reserve(materials.size());
    for (const PlannedMaterial& material : materials) result.push_back(material.form.reflectance());
    return result;
}

std::size_t Plan::bytes() const {
    std::size_t sum = 0;
    for (const PlannedMaterial& material : materials) sum += material.form.bytes();
    for (const double table : tables(*this)) sum += phi_table_bytes(Tolerance{table});
    return sum;
}

PlannedForm full_model(const Scene& scene, const Material& material) {
    return MaterialForms{scene, material}.full_model();
}

Plan make_plan(const Scene& scene, const PlanSampling& sampling, double tolerance) {
    require_tolerance(scene.measure, tolerance);
    Plan plan = planned(scene, sampling, tolerance, hts::accuracy::coarsest_tolerance);
    if (fits(plan)) return plan;
    const std::size_t several_tables = plan.bytes();
    if (const auto used = tables(plan); used.size() > 1) {  // one table for all takes less
        plan = planned(scene, sampling, tolerance, *used.begin());
        if (fits(plan)) return plan;
    }
    throw Error{scene.path.string() +
                ": key \"memory_budget_bytes\": " + std::to_string(*scene.memory_budget) +
                ": must be >= " + std::to_string(std::min(several_tables, plan.bytes())) +
                ", what the smallest plan within the tolerance takes"};
}

MeasuredError measured_error(const Scene& scene, const Material& material, const PlannedForm& form,
                             const PlanSampling& sampling) {
    return ErrorMeter{scene, material, {scene, material}, sampling}.error(form);
}

std::vector<MeasuredError> measured_errors(const Plan& plan, const PlanSampling& sampling) {
    std::vector<MeasuredError> errors;
    const Job job{"", plan.materials.size()};
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
        errors.push_back(
            measured_error(plan.scene, plan.scene.materials[i], plan.materials[i].form, sampling));
        job.done();
    }
    return errors;
}

}  // namespace hts::spectral
