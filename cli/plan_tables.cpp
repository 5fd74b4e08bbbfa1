#include "cli/plan_tables.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "cli/plan_cost.hpp"
#include "hts/error.hpp"
#include "spectral/output.hpp"
#include "tables/build_table.hpp"

namespace hts::cli {
namespace {

using spectral::ErrorMeasure;
using spectral::MaterialForms;
using spectral::Plan;
using spectral::PlannedMaterial;
using spectral::PlannedReflectance;
using spectral::Rung;
using spectral::Scene;

/// What a table may be wrong by so that, with what the choice is wrong by already, the whole is likely to stay within the
/// tolerance; the measurement decides.
double table_tolerance(const Plan& plan, const PlannedMaterial& material) {
    constexpr double relative_of_delta_e =
        0.005;  // a colour's lightness changes by so much for a unit of CIEDE2000
    const double enough = spectral::plan_headroom * plan.tolerance;
    const double left = std::max(0.9 * (enough - material.choice.error.worst), 0.1 * enough);
    const double relative =
        plan.scene.measure == ErrorMeasure::delta_e_2000 ? relative_of_delta_e * left : left;
    return std::clamp(relative, 1e-9, 0.5);
}

void require_domain(const Scene& scene, const Rung& rung) {
    const double largest = std::max(scene.largest_theta_i, scene.largest_theta_r);
    if (rung.lobe == DiffuseLobe::none) throw Error{"there is no lobe to look up"};
    if (scene.polarised) throw Error{"the scene is polarised"};
    if (largest > tables::steepest_theta) {
        throw out_of_range("largest polar angle", largest * 180 / std::numbers::pi, "deg",
                           "<= 88 deg, where tables end");
    }
}

std::string file_name(std::string name) {
    for (char& c : name) {
        if (c == '/' || c == ' ') c = '-';
    }
    return name + ".htst";
}

std::string in_words(double nanoseconds) {
    return shortest(std::round(nanoseconds)) + " ns";
}

/// Puts the table in the choice's place or throws hts::Error that says why not.
std::string tried(Plan& plan, std::size_t i, const std::filesystem::path& folder) {
    const Scene& scene = plan.scene;
    PlannedMaterial& material = plan.materials[i];
    Rung rung = material.choice.rung;
    require_domain(scene, rung);
    tables::TableRequest request;
    request.tolerance = table_tolerance(plan, material);
    if (scene.memory_budget) request.largest_bytes = *scene.memory_budget;

    const MaterialForms forms{scene, scene.materials[i]};
    rung.lobe = DiffuseLobe::full;
    rung.lobe_tolerance = Tolerance{std::clamp(0.01 * request.tolerance, hts::accuracy::finest_tolerance,
                                               hts::accuracy::finest_lane_tolerance)};
    const PlannedReflectance exact = forms.at(rung);
    tables::TableSource source;
    source.name = material.name;
    const std::string bytes =
        tables::finished_table(exact.at_nodes(), source, tables::plan_table(exact.at_nodes(), request),
                               tables::computed_slices(exact.at_nodes()));
    rung.table = file_name(material.name);
    PlannedReflectance evaluator{
        scene, rung, std::make_shared<const tables::Table>(tables::Table::from_bytes(bytes, rung.table))};

    const double now = plan_cost(scene, forms, material.evaluator).diffuse;
    const double then = plan_cost(scene, forms, evaluator).diffuse;
    const std::string both = in_words(then) + " a pair of directions, against " + in_words(now);
    if (then >= now) throw Error{both};
    const auto error = measured_error(scene, scene.materials[i], evaluator, plan.sampling);
    if (error.worst > spectral::plan_headroom * plan.tolerance)
        throw Error{both + ", but an error of " + shortest(error.worst)};
    const PlannedMaterial analytic = material;
    material.choice = {rung, error};
    material.evaluator = std::move(evaluator);
    if (scene.memory_budget && plan.bytes() > *scene.memory_budget) {
        const std::size_t needed = plan.bytes();
        material = analytic;
        throw Error{both + ", but " + std::to_string(needed) + " bytes in all, above the budget"};
    }
    spectral::write_file((folder / rung.table).string(), bytes);
    return "taken: " + both;
}

}  // namespace

std::vector<std::string> try_tables(Plan& plan, const std::filesystem::path& folder) {
    std::vector<std::string> verdicts;
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
        try {
            verdicts.push_back(tried(plan, i, folder));
        } catch (const Error& reason) {
            verdicts.push_back(std::string{"not taken: "} + reason.what());
        }
    }
    return verdicts;
}

}  // namespace hts::cli
