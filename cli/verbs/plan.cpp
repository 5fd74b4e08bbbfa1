// hts plan: for every material of a scene the cheapest evaluator that is exact enough, as measured.

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "spectral/plans/plan.hpp"
#include "spectral/text/verdict.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/plans/plan_cost.hpp"
#include "tables/plans/plan_tables.hpp"
#include "tables/table/table.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;
using spectral::MeasuredRung;
using spectral::Plan;
using spectral::Rung;

constexpr auto plan_help = R"(
A scene file (JSON) lists material files of any model, wavelengths, the largest polar
angles of lights and views, what is wanted (spectral or rgb, polarised or not), a tolerance
(relative_brdf_error, delta_e_2000, or true_db: the distance from exact scattering of model
and arithmetic together) and a memory budget; docs/plans.md has every key. For each
material the plan leaves out what the tolerance allows: wavelengths, the lobe, and of model
he its full series and the specular term. Errors are measured on random directions of the
scene against the full model; spectral/plans/plan.hpp defines them.
--output writes the plan for hts eval --plan and for the library; --check measures a plan
again, with another --seed, and exits with 1 if an error exceeds the tolerance.

Examples:
  hts plan cli/data/figure-14.json
  hts plan cli/data/figure-14-spectral.json --tolerance 1e-6 --output plan.json
  hts plan --check plan.json --seed 2)";

struct PlanOptions {
    std::string scene, check, output;
    std::optional<double> tolerance;
    std::optional<std::uint64_t> seed;
    std::optional<std::size_t> pairs;
    bool json = false, tables = false;
};

template <class... Values>
std::string formatted(const char* format, Values... values) {
    std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
    static_cast<void>(std::snprintf(text.data(), text.size() + 1, format, values...));
    return text;
}

std::string wavelengths_in_words(const Rung& rung) {
    const std::size_t count = rung.wavelengths.size();
    return std::to_string(count) + (count == 1 ? " wavelength" : " wavelengths");
}

std::string in_words(const Rung& rung, const spectral::Material& material) {
    if (!rung.table.empty()) return "table " + rung.table.file + ", " + wavelengths_in_words(rung);
    if (!material.properties().surface) {
        const bool whole = rung.lobe == DiffuseLobe::full;
        return (whole ? "all of " + material.model_name() : std::string{"uniform term alone"}) + ", " +
               wavelengths_in_words(rung);
    }
    std::string lobe;
    switch (rung.lobe) {
        case DiffuseLobe::none:
            lobe = "no lobe";
            break;
        case DiffuseLobe::first_order:
            lobe = "first order in g";
            break;
        case DiffuseLobe::rough_limit:
            lobe = "rough limit";
            break;
        case DiffuseLobe::full:
            lobe = "full Phi at " + shortest(rung.lobe_tolerance.relative_error());
            break;
    }
    return lobe + (rung.specular ? ", specular term, " : ", no specular term, ") + wavelengths_in_words(rung);
}

std::string in_words(const spectral::MeasuredError& error) {
    return formatted("worst %.3g, 99 %% below %.3g", error.worst, error.percentile_99);
}

// ---- the report of a new plan

struct MaterialCost {
    tables::PlanCost chosen, full;
};

std::vector<MaterialCost> costs(const Plan& plan) {
    std::vector<MaterialCost> result;
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
        const spectral::MaterialForms forms{plan.scene, plan.scene.materials[i]};
        result.push_back({tables::plan_cost(plan.scene, forms, plan.materials[i].form),
                          tables::plan_cost(plan.scene, forms, forms.full_model())});
    }
    return result;
}

/// What a rough surface has besides the forms of a rung.
std::string other_terms(const spectral::Scene& scene, const spectral::Material& material) {
    if (!material.properties().surface) return "";
    const auto reflectance = material.at(scene.wavelengths, {.outside = scene.outside_range});
    const bool uniform = std::ranges::any_of(
        reflectance.samples(), [](const SpectralSample& sample) { return sample.uniform_diffuse > 0; });
    return std::string{uniform ? ", uniform term" : ", no uniform term (a = 0)"} +
           (scene.polarised ? ", Mueller" : ", scalar") +
           (scene.compensate_energy ? ", energy compensated" : "");
}

/// Where the time of the diffuse terms goes.
std::string parts(const tables::PlanCost& cost, bool rough_surface) {
    return rough_surface
               ? formatted("directions %.0f, Phi %.0f, Fresnel and the rest %.0f, interpolation %.0f",
                           cost.directions, cost.phi, cost.rest, cost.interpolation)
               : formatted("values %.0f, interpolation %.0f", cost.rest, cost.interpolation);
}

/// What a plan says besides: for each material what came of a table, nothing unless tables were tried.
using TableVerdicts = std::vector<std::string>;

std::string report(const Plan& plan, std::size_t i, const MaterialCost& cost, const TableVerdicts& tables) {
    const spectral::PlannedMaterial& material = plan.materials[i];
    const tables::PlanCost &now = cost.chosen, &full = cost.full;
    const spectral::Material& described = plan.scene.materials[i];
    const bool rough = described.properties().surface.has_value();
    std::string text = material.name + ": " + in_words(material.choice.rung, described) +
                       other_terms(plan.scene, described) + "\n";
    text += "  error     " + in_words(material.choice.error) + "\n";
    text += formatted("  diffuse   %.0f ns a pair of directions, full model %.0f ns: %.1f times\n",
                      now.diffuse, full.diffuse, full.diffuse / now.diffuse);
    text += "            " + parts(now, rough && material.choice.rung.table.empty());
    text += plan.scene.illuminant ? formatted("; colour %.0f more\n", now.colour) : "\n";
    if (rough) {
        text += formatted("  mirror    %.0f ns a direction of light, full model %.0f ns\n", now.mirror,
                          full.mirror);
    }
    text += "  memory    " + std::to_string(material.form.bytes()) + " bytes\n";
    if (!tables.empty()) text += "  table     " + tables[i] + "\n";
    for (const MeasuredRung& rung : material.rejected) {
        text += (&rung == &material.rejected.front() ? "  rejected  " : "            ") +
                in_words(rung.rung, described) + ": " + in_words(rung.error) + "\n";
    }
    return text;
}

std::string report(const Plan& plan, const TableVerdicts& tables) {
    const auto cost = costs(plan);
    std::string text = formatted("tolerance %g (%s), measured on %zu pairs of directions, seed %llu\n",
                                 plan.tolerance, name(plan.scene.measure), plan.sampling.pairs,
                                 static_cast<unsigned long long>(plan.sampling.seed));
    if (plan.scene.true_db)
        text += formatted(
            "which is what true_db %g leaves beside the models' expected distance from exact scattering\n",
            *plan.scene.true_db);
    for (std::size_t i = 0; i < cost.size(); ++i) text += report(plan, i, cost[i], tables);
    return text + "all together " + std::to_string(plan.bytes()) +
           " bytes, with the tables of Phi they share\n";
}

nlohmann::ordered_json object(const tables::PlanCost& cost) {
    return {{"diffuse_ns", cost.diffuse},
            {"mirror_ns", cost.mirror},
            {"colour_ns", cost.colour},
            {"phi_ns", cost.phi},
            {"directions_ns", cost.directions},
            {"rest_ns", cost.rest},
            {"interpolation_ns", cost.interpolation}};
}

std::string json_report(const Plan& plan, const fs::path& folder, const TableVerdicts& tables) {
    nlohmann::ordered_json costs_of_all = nlohmann::ordered_json::array();
    const auto cost = costs(plan);
    for (std::size_t i = 0; i < cost.size(); ++i) {
        costs_of_all.push_back({{"name", plan.materials[i].name},
                                {"bytes", plan.materials[i].form.bytes()},
                                {"chosen", object(cost[i].chosen)},
                                {"full_model", object(cost[i].full)}});
        if (!tables.empty()) costs_of_all.back()["table"] = tables[i];
    }
    const nlohmann::ordered_json result{{"plan", nlohmann::ordered_json::parse(plan_text(plan, folder))},
                                        {"costs", costs_of_all}};
    return result.dump(2) + "\n";
}

void plan_scene(const PlanOptions& options) {
    const spectral::Scene scene = spectral::read_scene(options.scene, tables::models_with_files());
    const double tolerance = options.tolerance.value_or(scene.tolerance);
    if (options.tolerance) from_option("--tolerance", [&] { require_tolerance(scene.measure, tolerance); });
    spectral::PlanSampling sampling;
    sampling.seed = options.seed.value_or(sampling.seed);
    sampling.pairs = options.pairs.value_or(sampling.pairs);
    for (const spectral::Material& material : scene.materials) {
        for (const std::string& warning : material.warnings())
            std::cerr << "hts: " << material.name() << ": " << warning << '\n';
    }
    Plan plan = make_plan(scene, sampling, tolerance);
    const fs::path folder = fs::path{options.output}.parent_path();
    auto [verdicts, files] =
        options.tables ? tables::try_tables(plan, options.output) : tables::TriedTables{};
    if (!options.output.empty()) files.push_back({options.output, plan_text(plan, folder)});
    spectral::write_files(files);
    write_file("-", options.json ? json_report(plan, folder, verdicts) : report(plan, verdicts));
}

// ---- the check of an old one

void write_check(const Plan& plan, const std::vector<spectral::MeasuredError>& errors, bool json) {
    Output output{"-"};
    TableWriter table{output,
                      json ? Format::json : Format::csv,
                      {"material", "planned_worst", "worst", "error_99_percent", "tolerance", "verdict"}};
    std::string text;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        TableWriter::Row row{table, text};
        row.field(plan.materials[i].name).field(shortest(plan.materials[i].choice.error.worst));
        row.field(shortest(errors[i].worst)).field(shortest(errors[i].percentile_99));
        row.field(shortest(plan.tolerance)).word(spectral::verdict(errors[i].worst <= plan.tolerance)).end();
    }
    table.add(text);
    table.finish();
    output.commit();
}

void check_plan(const PlanOptions& options) {
    const Plan plan = spectral::read_plan(options.check, tables::models_with_files(), tables::open_for_plan);
    const spectral::PlanSampling sampling{options.seed.value_or(plan.sampling.seed + 1),
                                          options.pairs.value_or(plan.sampling.pairs)};
    const auto errors = measured_errors(plan, sampling);
    write_check(plan, errors, options.json);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (errors[i].worst <= plan.tolerance) continue;
        throw CheckFailed{options.check + ": " + plan.materials[i].name + ": error " +
                          shortest(errors[i].worst) + ": must be <= " + shortest(plan.tolerance)};
    }
}

void run(const PlanOptions& options) {
    if (options.scene.empty() == options.check.empty()) {
        throw UsageError{"scene file or --check: must be given, one of them"};
    }
    if (!options.check.empty() && (options.tolerance || !options.output.empty() || options.tables)) {
        throw UsageError{"--check: must not come with --tolerance, --output or --tables"};
    }
    if (options.tables && (options.output.empty() || options.output == "-")) {
        throw UsageError{"--tables: must come with --output and a file, beside which the tables stand"};
    }
    options.check.empty() ? plan_scene(options) : check_plan(options);
}

}  // namespace

void add_plan(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("plan", "the cheapest evaluators that a scene's tolerance allows");
    auto options = std::make_shared<PlanOptions>();
    reads_whole(verb->add_option("scene", options->scene, "scene file (JSON)"));
    writes(verb->add_option("--output,-o", options->output, "plan file to write (JSON)"));
    verb->add_option("--tolerance", options->tolerance, "instead of the scene's, in its measure");
    reads_whole(verb->add_option("--check", options->check, "plan file to measure again"));
    verb->add_option("--seed", options->seed, "of the random directions, default 1; to check, the plan's + 1")
        ->check(whole_number(0, std::uint64_t{1} << 53));
    verb->add_option(pairs_names, options->pairs, "random pairs of directions, default 8192")
        ->check(whole_number(1, 10'000'000));
    verb->add_flag("--tables", options->tables,
                   "try a lookup table for each material, some seconds to minutes; those that are\n"
                   "quicker and within the tolerance, as measured, are written beside the plan,\n"
                   "as PLAN-NUMBER-MATERIAL.htst");
    verb->add_flag("--json", options->json, "print JSON: the plan and the costs, or the check");
    verb->footer(plan_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
