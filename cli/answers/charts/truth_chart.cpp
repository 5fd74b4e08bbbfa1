#include "cli/answers/charts/truth_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench/charts/machine.hpp"
#include "cli/answers/charts/timed_evaluator.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/output/script.hpp"
#include "spectral/statistics.hpp"
#include "tables/table/build_table.hpp"

namespace hts::cli {
namespace {

using validation::Distances;
using validation::RoughnessStatistics;
using validation::TwinModel;

// ---- panels

/// Kinds of surfaces, by the phase variance along the normal, (4 pi sigma_0/lambda)^2, and by sigma_0/tau.
struct PanelKind {
    const char* title;
    RoughnessStatistics timed;  ///< whose evaluation is timed [wavelengths]
    bool (*has)(double phase_variance, double slope);
};
constexpr double gentle = 0.25;
constexpr std::array kinds{
    PanelKind{"smooth: g < 1 along the normal",
              {0.05, 1},
              [](double g, double slope) { return g < 1 && slope <= gentle; }},
    PanelKind{"intermediate: g 1 to 20",
              {0.25, 2},
              [](double g, double slope) { return g >= 1 && g < 20 && slope <= gentle; }},
    PanelKind{
        "rough, gentle: g > 20", {1, 4}, [](double g, double slope) { return g >= 20 && slope <= gentle; }},
    PanelKind{"steep: σ₀/τ > 1/4", {0.5, 1.25}, [](double, double slope) { return slope > gentle; }}};

bool belongs(const PanelKind& kind, const RoughnessStatistics& surface) {
    const double phase = 4 * std::numbers::pi * surface.rms_roughness;
    return kind.has(phase * phase, surface.rms_roughness / surface.correlation_length);
}

/// Arithmetic adds to it. Where a method has no light at all it is `no_light`.
double with_arithmetic(double decibels, double tolerance) {
    constexpr double no_light = 999;
    return std::fmin(no_light, std::hypot(decibels, 10 * std::log10(1 + tolerance)));
}

template <class Statistic>
Distances over(const std::vector<Distances>& all, double tolerance, const Statistic& statistic) {
    const auto of = [&](double Distances::*part) {
        std::vector<double> values;
        values.reserve(all.size());
        for (const Distances& each : all) values.push_back(each.*part);
        return with_arithmetic(statistic(values), tolerance);
    };
    return {of(&Distances::te), of(&Distances::tm), of(&Distances::unpolarised)};
}

// ---- times

std::vector<DirectionPair> timed_pairs(std::uint64_t seed) {
    constexpr double lowest = 0.1736;  // 80 deg
    Random random{seed};
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < 2000; ++i) {
        const Direction in = random.direction(lowest);
        pairs.push_back({in, random.direction(lowest)});
    }
    return pairs;
}

/// A surface of the panel at 0.58 um.
Surface timed_surface(const RoughnessStatistics& of) {
    constexpr double micrometres = 0.58;
    return {of.rms_roughness * micrometres, of.correlation_length * micrometres};
}

spectral::Material rough_surface(const spectral::RoughSurface& surface) {
    return spectral::he_torrance_material("timed", surface, spectral::built_in_optical_constants("Al"));
}

spectral::RoughSurface by_model(const Surface& surface, TwinModel model) {
    if (model == TwinModel::he_unified) return {surface, UnifiedChoices{}};
    if (model == TwinModel::he_unified_mixing) return {surface, UnifiedChoices{.polarisation_mixing = true}};
    if (model == TwinModel::he_unified_shortcut) return {surface, UnifiedChoices{.conductor_shortcut = true}};
    return {surface};
}

spectral::Material microfacets(const Surface& surface, const char* distribution) {
    return spectral::material_from_text(R"({"model": "walter", "index": "Al", "distribution": ")" +
                                            std::string{distribution} + R"(", "alpha": )" +
                                            shortest(surface.slope_width()) + "}",
                                        "timed.json");
}

/// What the library has not as a model: Kirchhoff's lobe, the same shadowed by correlated heights, and SSA-1,
/// one wavelength after the other.
Evaluator plain(const Surface& surface, TwinModel model, double tolerance) {
    const spectral::Reflectance known = rough_surface({surface}).at(chart_wavelengths());
    const std::vector<SpectralSample> samples{known.samples().begin(), known.samples().end()};
    return [=](const DirectionPair& pair, std::span<double> values) {
        const WaveVectorChange change = wave_vector_change(pair.in, pair.out);
        const double ci = pair.in.cos_theta(), cr = pair.out.cos_theta(),
                     a = 2 * change.cos_theta_d() * change.cos_theta_d();
        const double seen = model == TwinModel::kirchhoff
                                ? 1
                                : 1 / (1 + visibility(surface, pair.in).masked / ci +
                                       visibility(surface, pair.out).masked / cr);
        const double geometry = seen / (4 * std::numbers::pi * change.vertical * change.vertical * ci * cr);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double k = samples[i].wavelength.wave_number(), k_tau = k * surface.correlation_length();
            const double g = std::pow(k * surface.rms_roughness() * change.vertical, 2),
                         t = std::pow(k_tau * change.horizontal / 2, 2);
            double matrix = 0;
            if (model == TwinModel::ssa1) {
                const JonesMatrix b = bragg_jones(pair.in, pair.out, samples[i].index, 0);
                matrix = 2 * ci * cr * ci * cr *
                         (std::norm(b.ss) + std::norm(b.sp) + std::norm(b.ps) + std::norm(b.pp));
            } else {
                matrix =
                    a * a *
                    fresnel(change.cos_theta_d(), samples[i].index.substrate()).unpolarised_reflectance();
            }
            values[i] = k_tau * k_tau * phi(g, t, Tolerance{tolerance}) * geometry * matrix;
        }
    };
}

// ---- methods

/// Of the tables.
constexpr double table_tolerance = 1e-2;

/// How a method is timed.
enum class Way { model, first_order, rough_limit, plain, beckmann, ggx, table };

struct Method {
    const char* name;
    TwinModel twin;
    Way way;
    std::vector<double> tolerances;
    const char* colour;
    int shape;  // gnuplot's point type
};

const std::vector<Method>& methods() {
    static const std::vector<Method> all{
        {"he", TwinModel::he, Way::model, {1e-3, 1e-6, 1e-12}, "#0072b2", 7},
        {"he, first order", TwinModel::he_first_order, Way::first_order, {1e-3}, "#0072b2", 9},
        {"he, rough limit", TwinModel::he_rough_limit, Way::rough_limit, {1e-3}, "#0072b2", 5},
        {"he, table", TwinModel::he, Way::table, {table_tolerance}, "#0072b2", 13},
        {"he_unified", TwinModel::he_unified, Way::model, {1e-3, 1e-6, 1e-12}, "#d55e00", 7},
        {"he_unified, mixing", TwinModel::he_unified_mixing, Way::model, {1e-6}, "#d55e00", 6},
        {"he_unified, shortcut", TwinModel::he_unified_shortcut, Way::model, {1e-3, 1e-6}, "#d55e00", 9},
        {"he_unified, table", TwinModel::he_unified, Way::table, {table_tolerance}, "#d55e00", 13},
        {"Kirchhoff, not shadowed", TwinModel::kirchhoff, Way::plain, {1e-6}, "#009e73", 5},
        {"correlated Smith", TwinModel::smith, Way::plain, {1e-6}, "#009e73", 7},
        {"SSA-1", TwinModel::ssa1, Way::plain, {1e-6}, "#009e73", 9},
        {"Walter, Beckmann", TwinModel::beckmann, Way::beckmann, {1e-12}, "#888888", 5},
        {"Walter, GGX", TwinModel::ggx, Way::ggx, {1e-12}, "#888888", 7}};
    return all;
}

/// Of a table of he on the intermediate surface: tables of others are longer to build and as long to look up.
double lookup_time(double tolerance, std::span<const DirectionPair> pairs) {
    const auto exact = rough_surface({timed_surface(kinds[1].timed)}).at(chart_wavelengths());
    const tables::Table table = tables::build_table(exact, {exact.name(), "", ""}, {.tolerance = tolerance});
    return nanoseconds([&](const DirectionPair& pair, std::span<double> values) { table.brdf(pair, values); },
                       pairs);
}

double time_of(const Method& method, double tolerance, const Surface& surface,
               std::span<const DirectionPair> pairs) {
    const spectral::Material material = rough_surface(by_model(surface, method.twin));
    const auto in_form = [&](DiffuseLobe lobe) {
        return nanoseconds(
            evaluator_of(material.at(chart_wavelengths(), {.tolerance = Tolerance{tolerance}, .lobe = lobe})),
            pairs);
    };
    switch (method.way) {
        case Way::first_order:
            return in_form(DiffuseLobe::first_order);
        case Way::rough_limit:
            return in_form(DiffuseLobe::rough_limit);
        case Way::plain:
            return nanoseconds(plain(surface, method.twin, tolerance), pairs);
        case Way::beckmann:
            return nanoseconds(evaluator_of(microfacets(surface, "beckmann").at(chart_wavelengths())), pairs);
        case Way::ggx:
            return nanoseconds(evaluator_of(microfacets(surface, "ggx").at(chart_wavelengths())), pairs);
        default:
            return in_form(DiffuseLobe::full);
    }
}

std::vector<std::size_t> cases_of(const PanelKind& kind, const validation::ConductorCases& cases) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (belongs(kind, cases[i].exact.surface)) chosen.push_back(i);
    }
    return chosen;
}

std::size_t surfaces_among(const validation::ConductorCases& cases, const std::vector<std::size_t>& chosen) {
    std::vector<std::pair<double, double>> different;
    for (const std::size_t i : chosen) {
        const auto& surface = cases[i].exact.surface;
        const std::pair key{surface.rms_roughness, surface.correlation_length};
        if (std::find(different.begin(), different.end(), key) == different.end()) different.push_back(key);
    }
    return different.size();
}

}  // namespace

std::size_t truth_chart_steps() {
    return methods().size();
}

TruthChart measured_truth(std::uint64_t seed, const std::function<void(const std::string& step)>& progress) {
    TruthChart chart{{}, {}, seed, bench::machine().text()};
    const auto cases = validation::conductor_cases();
    std::vector<std::vector<std::size_t>> chosen;
    for (const PanelKind& kind : kinds) {
        chosen.push_back(cases_of(kind, cases));
        chart.panels.push_back({kind.title, surfaces_among(cases, chosen.back()), chosen.back().size()});
    }
    const auto pairs = timed_pairs(seed);

    const double lookup = lookup_time(table_tolerance, pairs);
    for (const Method& method : methods()) {
        progress(method.name);
        const auto all = all_distances(cases, method.twin);
        for (std::size_t panel = 0; panel < kinds.size(); ++panel) {
            std::vector<Distances> here;
            for (const std::size_t i : chosen[panel]) here.push_back(all[i]);
            for (const double tolerance : method.tolerances)
                chart.points.push_back(
                    {panel, method.name, tolerance, over(here, tolerance, spectral::median),
                     over(here, tolerance,
                          [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); }),
                     method.way == Way::table
                         ? lookup
                         : time_of(method, tolerance, timed_surface(kinds[panel].timed), pairs)});
        }
    }
    return chart;
}

validation::Figure truth_figure(const TruthChart& chart) {
    std::vector<std::string> titles, names, colours;
    std::vector<int> shapes;
    for (const Method& method : methods()) {
        names.emplace_back(method.name);
        colours.emplace_back(method.colour);
        shapes.push_back(method.shape);
    }
    std::vector<std::size_t> counts;
    std::vector<double> marks;
    validation::Figure figure{"truth", {}, {}, "Error against exact scattering and time of every method"};
    for (std::size_t panel = 0; panel < chart.panels.size(); ++panel) {
        const auto& [title, surfaces, cases] = chart.panels[panel];
        titles.push_back(title + ", " + std::to_string(surfaces) + " surfaces, " + std::to_string(cases) +
                         " cases");
        figure.tables.push_back({"truth-" + std::to_string(panel + 1),
                                 {"method", "tolerance", "nanoseconds", "median_te_db", "median_tm_db",
                                  "median_db", "worst_te_db", "worst_tm_db", "worst_db"},
                                 {}});
        for (const TruthPoint& point : chart.points) {
            if (point.panel != panel) continue;
            const auto method = std::find(names.begin(), names.end(), point.method) - names.begin() + 1;
            marks.push_back(static_cast<double>(method));
            figure.tables.back().rows.push_back({static_cast<double>(method), point.tolerance,
                                                 point.nanoseconds, point.median.te, point.median.tm,
                                                 point.median.unpolarised, point.worst.te, point.worst.tm,
                                                 point.worst.unpolarised});
        }
        counts.push_back(figure.tables.back().rows.size());
    }
    output::Script script;
    script.set("machine", chart.machine + ", seed " + std::to_string(chart.seed));
    script.set("surface", titles).set("count", counts).set("mark", marks);
    script.set("model", names).set("colour", colours).set("shape", shapes);
    figure.script = script.with("truth");
    return figure;
}

}  // namespace hts::cli
