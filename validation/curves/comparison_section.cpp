#include "validation/curves/comparison_section.hpp"

#include <algorithm>
#include <utility>

#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/text/text.hpp"
#include "validation/curves/reciprocity.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

using spectral::brief;

std::vector<std::string> figures_row(const std::string& label, const FiguresOfMerit& figures) {
    return {label,
            std::to_string(figures.points),
            brief(figures.median_abs_log, 3),
            brief(figures.rms_log, 3),
            brief(figures.mean_log, 3),
            brief(figures.rms, 3),
            brief(figures.relative_rms, 3),
            figures.reduced_chi_squared ? brief(*figures.reduced_chi_squared, 3) : "no uncertainties"};
}

std::string band_text(const Band& band) {
    return band.single() ? brief(band.first) + " um" : brief(band.first) + " ... " + brief(band.last) + " um";
}

std::string label_of(const Curve& curve) {
    if (curve.sweep == Sweep::scattered) return "pairs of directions, " + band_text(curve.band);
    return (curve.sweep == Sweep::incident ? "viewer at " : "light at ") + brief(curve.fixed_angle()) +
           " deg, " + band_text(curve.band);
}

ReportTable figures_table(const CurveSet& set, const Comparison& result, const std::string& stem) {
    ReportTable table{
        stem + "-figures",
        "Figures of merit. " + set.surface + ", " + name(set.kind) + " by " + set.by + ".",
        {"points of", "points", "median |ln(model/measured)|", "rms ln", "mean ln",
         std::string{"rms ["} + unit(set.quantity) + "]", "rms, relative", "reduced chi squared"},
        {}};
    table.rows.push_back(figures_row("all curves", result.figures));
    for (std::size_t i = 0; i < set.curves.size(); ++i)
        table.rows.push_back(figures_row(label_of(set.curves[i]), result.of_curves[i]));
    return table;
}

ReportTable maxima_table(const CurveSet& set, const Comparison& result, const std::string& stem) {
    ReportTable table{
        stem + "-maxima",
        "Where each curve is largest, among the measured angles. " + set.surface + ".",
        {"angle that stands still [deg]", "measured at [deg]", "computed at [deg]", "off [deg]", "remark"},
        {}};
    for (const CurveMaximum& m : result.maxima) {
        table.rows.push_back({brief(m.fixed_angle), brief(m.measured_angle), brief(m.computed_angle),
                              brief(m.off()), m.at_end ? "measured at the end of the curve" : ""});
    }
    return table;
}

std::string cone_text(const char* what, const std::optional<double>& solid_angle) {
    const std::string size = solid_angle ? brief(*solid_angle).append(" sr") : "not stated";
    return std::string{what}.append(" ").append(size);
}

std::string reciprocity_text(const CurveSet& set) {
    const Reciprocity pairs = reciprocity(set);
    if (pairs.pairs == 0)
        return "No two of the points swap light and viewer, so the data do not test themselves.";
    const CurvePoint& p = pairs.worst.there;
    return "Reciprocity of the data themselves, " + std::to_string(pairs.pairs) +
           " pairs: median |ln ratio| " + brief(pairs.median_abs_log, 3) + ", rms " +
           brief(pairs.rms_log, 3) + ", worst " + brief(std::abs(pairs.worst.log_ratio), 3) + " between " +
           brief(p.theta_i) + " and " + brief(p.theta_r) +
           " deg. No reciprocal model can come closer than half of that.";
}

std::string section_text(const CurveSet& set, const Comparison& result, const Trial& trial) {
    std::string text = "Points: " + set.surface + ", " + name(set.kind) + " by " + set.by +
                       ". Source: " + set.source + ". Licence: " + set.licence + ". Made by `" + set.how +
                       "`.\n\n";
    text += "Model: " + trial.model + ". It is averaged over the band and over the instrument's cones: " +
            cone_text("source", set.source_solid_angle) + ", " +
            cone_text("detector", set.detector_solid_angle) + ".";
    if (!set.source_solid_angle && !set.detector_solid_angle)
        text += " Without either, the specular term has no finite value and is left out.";
    if (set.scale == Scale::unknown)
        text += " The scale of the data is unknown; the model was multiplied by " + brief(result.scale) + ".";
    if (set.roughness)
        text += " Roughness measured by " + set.roughness->method + ": " + brief(set.roughness->rms_um) +
                " um rms.";
    text += "\n\n" + reciprocity_text(set);
    text += "\n\nUncertainties: " + (set.uncertainty.empty() ? "none stated" : set.uncertainty) + ".";
    for (const std::string& note : set.notes) text += " " + note + ".";
    return text;
}

spectral::Material he91(const char* index, double rms_roughness, double correlation_length, double albedo) {
    return spectral::he_torrance_material("He et al. 1991", {rms_roughness, correlation_length},
                                          spectral::built_in_optical_constants(index),
                                          spectral::DiffuseAlbedo{albedo});
}

}  // namespace

std::string described(const spectral::Material& material) {
    const auto& surface = material.properties().surface;
    if (!surface) return material.name() + " (" + material.model_source() + ")";
    const std::string model = material.model_name() == "he" ? "He-Torrance" : material.model_name();
    const auto& [along, across] = surface->correlation_lengths();
    const std::string length = brief(along) + (surface->isotropic() ? "" : " and " + brief(across));
    return material.name() + " (" + model + ": σ₀ " + brief(surface->rms_roughness()) + " µm, τ " + length +
           " µm, " + material.substance() + ")";
}

Section comparison_section(const CurveSet& set, const spectral::Material& material, const Trial& trial) {
    const std::string stem = trial.stem.empty() ? set.stem : trial.stem;
    auto predicted = Prediction{set, trial.nodes}.values(material, trial.policy);
    for (double& value : predicted) value *= trial.scale;
    const Comparison result = comparison(set, std::move(predicted), trial.free_parameters);
    const auto lines = model_lines(set, material, trial.nodes, trial.policy, result.scale * trial.scale);
    const ComparisonPicture picture{set, result, lines, trial.model, stem};
    Section section{.stem = stem,
                    .title = set.surface,
                    .text = section_text(set, result, trial),
                    .checks = criteria(set, result, trial.in_report),
                    .figures = {log_overlay(picture)},
                    .images = {},
                    .tables = {figures_table(set, result, stem)},
                    .not_available = {}};
    if (!lines.empty()) section.figures.push_back(polar_overlay(picture));
    section.figures.push_back(residual_plot(picture));
    if (!result.maxima.empty()) section.tables.push_back(maxima_table(set, result, stem));
    return section;
}

std::vector<MeasurementSlot> measurement_slots() {
    return {
        {"he91-figure-7", "rough aluminium at 2.0 um, light at 10, 45 and 75 deg", he91("Al", 0.28, 1.77, 0)},
        {"he91-figure-8", "rough aluminium at 0.5 um, light at 10, 30, 45, 60 and 75 deg",
         he91("Al", 0.28, 1.77, 0)},
        {"he91-figure-9", "magnesium-oxide ceramic at 0.5 um, light at 10, 45, 60 and 75 deg",
         he91("MgO", 1.45, 13.2, 0.9)},
        {"he91-figure-10", "220-grit sandpaper at 0.55 um, light at 0 deg", he91("Al2O3", 44, 10, 0)},
        {"he91-figure-11", "smooth blue plastic at 0.46 um, light at 15, 30, 45 and 60 deg",
         he91("PMMA", 0, 1, 0.15)}};
}

Section slots_section(const std::filesystem::path& folder) {
    Section all{.stem = "measurements-of-the-paper",
                .title = "Measured curves of He et al. 1991, Figures 7 to 11",
                .text = prose("measurements-of-the-paper"),
                .checks = {},
                .figures = {},
                .images = {},
                .tables = {},
                .not_available = {}};
    for (const MeasurementSlot& slot : measurement_slots()) {
        const auto file = folder / (slot.stem + ".json");
        if (folder.empty() || !std::filesystem::exists(file)) {
            all.not_available.push_back(slot.stem + ", " + slot.what +
                                        ": measurement not available (would be read from " + slot.stem +
                                        ".json)");
            continue;
        }
        Section one = comparison_section(read_curves(file), slot.model, {.model = described(slot.model)});
        std::move(one.figures.begin(), one.figures.end(), std::back_inserter(all.figures));
        std::move(one.tables.begin(), one.tables.end(), std::back_inserter(all.tables));
        all.text += "\n\n" + one.text;
    }
    return all;
}

}  // namespace hts::validation
