#include "tables/plans/plan_tables.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "tables/plans/plan_cost.hpp"
#include "tables/table/build_table.hpp"

namespace hts::tables {
namespace {

using spectral::ErrorMeasure;
using spectral::MaterialForms;
using spectral::Plan;
using spectral::PlannedForm;
using spectral::PlannedMaterial;
using spectral::Rung;
using spectral::Scene;

/// What a table may be wrong by so that, with what the choice is wrong by already, the whole is likely to
/// stay within the tolerance; the measurement decides.
double table_tolerance(const Plan& plan, const PlannedMaterial& material) {
    constexpr double relative_of_delta_e =
        0.005;  // a colour's lightness changes by so much for a unit of CIEDE2000
    const double enough = spectral::plan_headroom * plan.tolerance;
    const double left = std::max(0.9 * (enough - material.choice.error.worst), 0.1 * enough);
    const double relative =
        plan.scene.measure == ErrorMeasure::delta_e_2000 ? relative_of_delta_e * left : left;
    return std::clamp(relative, 1e-9, 0.5);
}

/// Why a table is not taken.
class NotTaken : public Error {
  public:
    using Error::Error;
};

void require_domain(const Scene& scene, const Rung& rung) {
    const double largest = std::max(scene.largest_theta_i, scene.largest_theta_r);
    if (rung.lobe == DiffuseLobe::none) throw NotTaken{"there is no lobe to look up"};
    if (scene.polarised) throw NotTaken{"the scene is polarised"};
    if (largest > tables::steepest_theta) {
        throw NotTaken{out_of_range("largest polar angle", largest * 180 / std::numbers::pi, "deg",
                                    "<= 88 deg, where tables end")
                           .what()};
    }
}

/// Different for every material of a plan, and for plans of different names in a folder.
std::string file_name(const std::filesystem::path& plan_file, std::size_t i, std::string material) {
    for (char& c : material) {
        if (c == '/' || c == ' ') c = '-';
    }
    return plan_file.stem().string() + "-" + std::to_string(i + 1) + "-" + material + ".htst";
}

/// The bytes of a table of what an evaluator evaluates at its wavelengths.
std::string built_table(const PlannedForm& exact, const tables::TableRequest& request) {
    const spectral::Reflectance& nodes = exact.at_nodes();
    tables::TableSource source;
    source.name = exact.name();
    try {
        return tables::finished_table(nodes, source, tables::plan_table(nodes, request),
                                      tables::computed_slices(nodes));
    } catch (const Error& refusal) {  // too fine or too large
        throw NotTaken{refusal.what()};
    }
}

std::string in_words(double nanoseconds) {
    return shortest(std::round(nanoseconds)) + " ns";
}

/// Puts the table in the choice's place and adds it to what came out, or throws NotTaken.
void try_table(Plan& plan, std::size_t i, const std::filesystem::path& plan_file, TriedTables& result) {
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
    const PlannedForm exact = forms.at(rung);
    std::string bytes = built_table(exact, request);
    const std::string file = file_name(plan_file, i, material.name);
    const Table table = Table::from_bytes(bytes, file);
    rung.table = {file, table.checksum()};
    const PlannedForm form{scene, rung, table.reflectance()};

    const double now = plan_cost(scene, forms, material.form).diffuse;
    const double then = plan_cost(scene, forms, form).diffuse;
    const std::string both = in_words(then) + " a pair of directions, against " + in_words(now);
    if (then >= now) throw NotTaken{both};
    const auto error = measured_error(scene, scene.materials[i], form, plan.sampling);
    if (error.worst > spectral::plan_headroom * plan.tolerance)
        throw NotTaken{both + ", but an error of " + shortest(error.worst)};
    const PlannedMaterial analytic = material;
    material.choice = {rung, error};
    material.form = form;
    if (scene.memory_budget && plan.bytes() > *scene.memory_budget) {
        const std::size_t needed = plan.bytes();
        material = analytic;
        throw NotTaken{both + ", but " + std::to_string(needed) + " bytes in all, above the budget"};
    }
    result.files.push_back({(plan_file.parent_path() / file).string(), std::move(bytes)});
    result.verdicts.push_back("taken: " + both);
}

}  // namespace

TriedTables try_tables(Plan& plan, const std::filesystem::path& plan_file) {
    TriedTables result;
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
        try {
            try_table(plan, i, plan_file, result);
        } catch (const NotTaken& reason) {
            result.verdicts.push_back(std::string{"not taken: "} + reason.what());
        }
    }
    return result;
}

}  // namespace hts::tables
