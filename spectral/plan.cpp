#include "spectral/plan.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/tolerance.hpp"
#include "spectral/planning_error.hpp"

namespace hts::spectral {
namespace {

/// A form of the lobe and what it costs [ns per wavelength, of hts_bench]: for the order of the ladder only.
struct LobeForm {
    DiffuseLobe lobe;
    double tolerance;
    double cost;
};
constexpr double specular_cost = 1;
constexpr std::array lobe_forms{
    LobeForm{DiffuseLobe::none, 1e-3, 1},          LobeForm{DiffuseLobe::first_order, 1e-3, 5},
    LobeForm{DiffuseLobe::rough_limit, 1e-3, 5.5}, LobeForm{DiffuseLobe::full, 1e-3, 9},
    LobeForm{DiffuseLobe::full, 1e-6, 11},         LobeForm{DiffuseLobe::full, 1e-12, 100},
};

struct LadderStep {
    Rung rung;
    double cost;
};

/// Grids of a scene: its own, and for colours smaller ones over the same range.
std::vector<WavelengthGrid> grids(const Scene& scene) {
    std::vector<WavelengthGrid> grids;
    const auto um = scene.wavelengths.micrometres();
    if (scene.measure == ErrorMeasure::delta_e_2000) {
        for (std::size_t count = 2; count < um.size(); count += 1 + count / 32) {
            grids.push_back(WavelengthGrid::linear(um.front(), um.back(), static_cast<int>(count)));
        }
    }
    grids.push_back(scene.wavelengths);
    return grids;
}

/// All evaluators of a material, cheapest first.
///   coarsest   tolerance of the full lobe that may be used
std::vector<LadderStep> ladder(const Scene& scene, double coarsest) {
    std::vector<LadderStep> steps;
    for (const WavelengthGrid& grid : grids(scene)) {
        for (const LobeForm& form : lobe_forms) {
            if (form.lobe == DiffuseLobe::full && form.tolerance > coarsest) continue;
            for (const bool specular : {false, true}) {
                const double each = form.cost + (specular ? specular_cost : 0);
                steps.push_back({{form.lobe, Tolerance{form.tolerance}, specular, grid},
                                 each * static_cast<double>(grid.size())});
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

/// Keeps the best of each kind of rung.
void note(std::vector<MeasuredRung>& rejected, MeasuredRung one) {
    const auto twin = std::find_if(rejected.begin(), rejected.end(), [&](const MeasuredRung& other) {
        return same_kind(other.rung, one.rung);
    });
    if (twin == rejected.end()) {
        rejected.push_back(std::move(one));
    } else if (one.error.worst < twin->error.worst) {
        *twin = std::move(one);
    }
}

PlannedMaterial planned(const Scene& scene, const Reflector& material, const PlanSampling& sampling,
                        double tolerance, double coarsest) {
    const ErrorMeter meter{scene, material, sampling};
    const double enough = plan_headroom * tolerance;
    std::vector<MeasuredRung> rejected;
    for (LadderStep& step : ladder(scene, coarsest)) {
        const PlannedReflectance candidate{material, step.rung, scene.outside_range, scene.illuminant};
        const MeasuredError error = meter.error(candidate, enough);
        MeasuredRung measured{std::move(step.rung), error};
        if (error.worst <= enough) return {material.name, std::move(measured), std::move(rejected)};
        note(rejected, std::move(measured));
    }
    throw Error{material.name +
                ": no evaluator meets the tolerance"};  // the last rung is the full model itself
}

Plan planned(const Scene& scene, const PlanSampling& sampling, double tolerance, double coarsest) {
    Plan plan{scene, tolerance, sampling, {}};
    for (const Reflector& material : scene.materials) {
        plan.materials.push_back(planned(scene, material, sampling, tolerance, coarsest));
    }
    return plan;
}

/// The tolerances of the tables of Phi that a plan uses.
std::set<double> tables(const Plan& plan) {
    std::set<double> tolerances;
    for (const PlannedMaterial& material : plan.materials) {
        const Rung& rung = material.choice.rung;
        if (rung.lobe == DiffuseLobe::full) tolerances.insert(rung.lobe_tolerance.relative_error());
    }
    return tolerances;
}

bool fits(const Plan& plan) {
    return !plan.scene.memory_budget || plan.bytes() <= *plan.scene.memory_budget;
}

}  // namespace

std::vector<PlannedReflectance> Plan::evaluators() const {
    std::vector<PlannedReflectance> result;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        result.emplace_back(scene.materials[i], materials[i].choice.rung, scene.outside_range,
                            scene.illuminant);
    }
    return result;
}

std::size_t Plan::bytes() const {
    std::size_t sum = 0;
    for (const PlannedReflectance& evaluator : evaluators()) sum += evaluator.bytes();
    for (const double table : tables(*this)) sum += phi_table_bytes(Tolerance{table});
    return sum;
}

PlannedReflectance full_model(const Scene& scene, const Reflector& material) {
    return {material,
            {DiffuseLobe::full, Tolerance{hts::accuracy::finest_tolerance}, true, scene.wavelengths},
            scene.outside_range,
            scene.illuminant};
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

std::vector<MeasuredError> measured_errors(const Plan& plan, const PlanSampling& sampling) {
    std::vector<MeasuredError> errors;
    const auto evaluators = plan.evaluators();
    for (std::size_t i = 0; i < evaluators.size(); ++i) {
        const ErrorMeter meter{plan.scene, plan.scene.materials[i], sampling};
        errors.push_back(meter.error(evaluators[i], std::numeric_limits<double>::infinity()));
    }
    return errors;
}

const char* name(DiffuseLobe lobe) noexcept {
    switch (lobe) {
        case DiffuseLobe::none:
            return "none";
        case DiffuseLobe::first_order:
            return "first_order";
        case DiffuseLobe::rough_limit:
            return "rough_limit";
        case DiffuseLobe::full:
            return "full";
    }
    return "";
}

}  // namespace hts::spectral
