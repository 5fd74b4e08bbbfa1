#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "spectral/models/uncertainty.hpp"
#include "spectral/output/script.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"
#include "validation/curves/comparison.hpp"
#include "validation/curves/comparison_figures.hpp"
#include "validation/fit/sections/case_result.hpp"
#include "validation/fit/sections/surface_descriptions.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

using nlohmann::ordered_json;

constexpr AveragingNodes nodes{1, 1};
constexpr double most_albedo = 0.2;

/// A roughness that maps gave.
struct Description {
    const char* name;   ///< of the file
    const char* title;  ///< in tables
};
constexpr std::array descriptions{
    Description{"gaussian", "Gaussian"}, Description{"exponential", "exponential"},
    Description{"k_correlation", "K-correlation"}, Description{"measured", "measured spectrum, none beyond"}};
constexpr std::array indices{1.5, 1.75, 2.0};

/// The material file of a description.
///   set   "anodised-ec1"
std::string material_text(const std::string& set, const Description& description, const char* model, double n,
                          double albedo) {
    const std::string stem = set + "-" + description.name;
    const std::string text{spectral::embedded_text(surface_descriptions(), stem)};
    ordered_json file;
    if (std::string_view{description.name} == "measured") {
        const auto table = spectral::CsvTable::parse(text, stem + ".csv");
        ordered_json rows = ordered_json::array();
        for (std::size_t row = 0; row < table.row_count(); ++row) {
            auto& cells = rows.emplace_back(ordered_json::array());
            for (const char* column : {"frequency_per_um", "psd_um4", "psd_um4_error"})
                cells.push_back(table.number(row, table.column(column)));
        }
        file["correlation"] = {{"type", "psd"}, {"psd", "2d"}, {"table", rows}};
    } else {
        file = ordered_json::parse(text);
    }
    file["model"] = model;
    file["index"] = {{"n", n}, {"k", 0}};
    file["diffuse_albedo"] = albedo;
    return file.dump();
}

spectral::Material material_of(const std::string& set, const Description& description, const char* model,
                               double n, double albedo) {
    return spectral::material_from_text(material_text(set, description, model, n, albedo),
                                        set + "-" + description.name);
}

struct Predicted {
    const char* roughness;
    std::string model;
    double n, albedo;
    FiguresOfMerit figures;
    std::vector<double> values;
};

/// The albedo that comes closest in the mean square of logarithms; predictions are affine in it.
double best_albedo(const CurveSet& set, const std::vector<double>& without,
                   const std::vector<double>& slope) {
    const auto squares = [&](double albedo) {
        double sum = 0;
        std::size_t i = 0;
        for (const Curve& curve : set.curves) {
            for (const CurvePoint& point : curve.points) {
                const auto log =
                    log_ratio(without[i] + albedo * slope[i], point.value, set.noise_floor.value_or(0));
                if (log) sum += *log * *log;
                ++i;
            }
        }
        return sum;
    };
    // golden sections of a range in which the sum has one minimum
    constexpr double golden = 0.6180339887498949;
    double low = 0, high = most_albedo;
    while (high - low > 1e-5) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        squares(a) < squares(b) ? high = b : low = a;
    }
    return low < 2e-5 ? 0 : (low + high) / 2;
}

Predicted predicted(const CurveSet& set, const Prediction& instrument, const Description& description,
                    const char* model, double n) {
    constexpr double some = 0.1;
    const auto values = [&](double albedo) {
        return instrument.values(material_of(set.stem, description, model, n, albedo));
    };
    const auto without = values(0);
    std::vector<double> slope = values(some);
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - without[i]) / some;
    const double albedo = best_albedo(set, without, slope);
    std::vector<double> best = without;
    for (std::size_t i = 0; i < best.size(); ++i) best[i] += albedo * slope[i];
    Comparison result = comparison(set, best, 1);
    return {description.title, model, n, albedo, result.figures, std::move(result.model)};
}

std::vector<Predicted> predictions(const CurveSet& set) {
    const Prediction instrument{set, nodes};
    std::vector<Predicted> result;
    for (const Description& description : descriptions)
        for (const char* model : {"he", "he_unified"}) {
            for (const double n : indices)
                result.push_back(predicted(set, instrument, description, model, n));
        }
    return result;
}

const Predicted& row_of(const std::vector<Predicted>& all, const Description& description, const char* model,
                        double n) {
    return *std::ranges::find_if(all, [&](const Predicted& each) {
        return each.roughness == description.title && each.model == model && each.n == n;
    });
}

/// Median over the points of the standard deviation that the errors of the map's description leave, relative.
double map_error(const CurveSet& set, const Description& description) {
    const std::string text = material_text(set.stem, description, "he", indices[0], 0),
                      name = set.stem + "-" + description.name;
    const auto grid = spectral::WavelengthGrid::from_micrometres({set.curves.front().band.first});
    const auto of = spectral::UncertainMaterial{text, name}.at(grid);
    const auto own = spectral::material_from_text(text, name).at(grid);
    std::vector<double> relative;
    for (const Curve& curve : set.curves) {
        for (const CurvePoint& point : curve.points) {
            double deviation = 0, value = 0;
            of.brdf(point.pair(), {&deviation, 1});
            own.brdf(point.pair(), {&value, 1});
            if (value > 0) relative.push_back(deviation / value);
        }
    }
    std::ranges::sort(relative);
    return relative[relative.size() / 2];
}

std::vector<std::string> figures(const FiguresOfMerit& f) {
    return {spectral::brief(f.median_abs_log, 3), spectral::brief(f.rms_log, 3),
            spectral::brief(f.mean_log, 3)};
}

ReportTable table_of(const CaseResult& fit, const std::vector<Predicted>& all) {
    ReportTable table{
        fit.set.stem + "-predicted",
        fit.set.surface + ", measured by " + fit.set.by +
            ": predicted from height maps, one albedo fitted, and in the last row fitted in all.",
        {"roughness", "model", "n", "albedo", "median |ln(model/measured)|", "rms ln", "mean ln"},
        {}};
    for (const Predicted& each : all) {
        std::vector<std::string> row{each.roughness, each.model, spectral::brief(each.n),
                                     spectral::brief(each.albedo, 3)};
        for (std::string& cell : figures(each.figures)) row.push_back(std::move(cell));
        table.rows.push_back(std::move(row));
    }
    const auto& parameter = [&](const char* name) {
        return spectral::brief(fit.fit.parameter(name).value, 3);
    };
    const Comparison fitted = comparison(
        fit.set, Prediction{fit.set, nodes}.values(fitted_material(fit.fit), spectral::OutsideRange::hold));
    std::vector<std::string> row{
        "fitted: Gaussian, σ₀ " + parameter("sigma0") + " µm, τ " + parameter("tau") + " µm", "he",
        parameter("n"), parameter("a")};
    for (std::string& cell : figures(fitted.figures)) row.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
    return table;
}

/// Measured points, the fit and predictions of index 1.5, a panel per angle of incidence.
Figure figure_of(const CaseResult& fit, const std::vector<Predicted>& all) {
    const CurveSet& set = fit.set;
    std::vector<std::string> titles, legend{"fitted"};
    std::vector<std::vector<Curve>> lines{
        model_lines(set, fitted_material(fit.fit), nodes, spectral::OutsideRange::hold)};
    for (const Description& description : descriptions) {
        if (std::string_view{description.name} == "exponential") continue;
        const double albedo = row_of(all, description, "he", indices[0]).albedo;
        lines.push_back(model_lines(set, material_of(set.stem, description, "he", indices[0], albedo), nodes,
                                    spectral::OutsideRange::error));
        legend.emplace_back(std::string{"predicted, "} + description.title);
    }
    std::vector<output::Rows> points, drawn;
    for (std::size_t c = 0; c < set.curves.size(); ++c) {
        titles.push_back("light at " + spectral::brief(set.curves[c].fixed_angle()) + "°");
        auto& dots = points.emplace_back();
        for (const CurvePoint& point : set.curves[c].points)
            dots.push_back({set.curves[c].swept_angle(point), point.value});
        auto& rows = drawn.emplace_back();
        for (std::size_t i = 0; i < lines[0][c].points.size(); ++i) {
            auto& row = rows.emplace_back();
            row.push_back(lines[0][c].swept_angle(lines[0][c].points[i]));
            for (const auto& line : lines) row.push_back(line[c].points[i].value);
        }
    }
    output::Script script;
    script.set("surface", set.surface + ", measured by " + set.by + ", " +
                              spectral::brief(set.curves[0].band.first) + " µm");
    script.set("panel", titles).set("line", legend).data("points", points).data("lines", drawn);
    return {set.stem + "-predicted",
            {},
            script.with("predicted"),
            set.surface +
                ": measured, fitted, and predicted from height maps by he with index 1.5 and one albedo."};
}

}  // namespace

Section predicted_section(const std::vector<CaseResult>& results) {
    Section section{.stem = "predicted",
                    .title = "Predicted, not fitted: two coatings from their height maps",
                    .text = prose("predicted"),
                    .checks = {},
                    .figures = {},
                    .images = {},
                    .tables = {},
                    .not_available = {}};
    for (const CaseResult& fit : results) {
        const bool mapped = fit.asked.set == "anodised-ec1" || fit.asked.set == "anodised-nite";
        if (!mapped || !fit.asked.judged) continue;
        const auto all = predictions(fit.set);
        section.tables.push_back(table_of(fit, all));
        section.figures.push_back(figure_of(fit, all));
        const Predicted& gaussian = row_of(all, descriptions[0], "he", indices[0]);
        const Predicted& shaped = row_of(all, descriptions[2], "he", indices[0]);
        const Predicted& other = row_of(all, descriptions[2], "he", indices[2]);
        const double shape = shaped.figures.median_abs_log, error = map_error(fit.set, descriptions[2]);
        section.checks.push_back(
            {fit.set.surface + ": the map's K-correlation predicts within a factor of 1.5 "
                               "in the median, n = 1.5",
             "median |ln(model / measured)| " + spectral::brief(shape, 3), shape <= std::log(1.5), "", 0.05});
        section.text +=
            "\n\n" + fit.set.surface + ": with n = 1.5 a Gaussian of the map's rms and length is " +
            spectral::brief(gaussian.figures.median_abs_log, 2) +
            " off in the median of |ln|, its K-correlation " + spectral::brief(shape, 2) + ", with n = 2 " +
            spectral::brief(other.figures.median_abs_log, 2) +
            ". The errors that the map leaves the K-correlation's numbers make, to first order, a "
            "relative standard deviation of " +
            spectral::brief(error, 2) + " in the median, those of the measured spectrum's rows " +
            spectral::brief(map_error(fit.set, descriptions[3]), 2) + "; the fit leaves " +
            spectral::brief(fit.fit.statistics.median_abs_log, 2) + ".";
        section.learned +=
            (section.learned.empty() ? "From height maps alone the scatter of two coatings is predicted to "
                                     : " and ") +
            spectral::brief(shape, 2);
    }
    section.learned += " in the median of |ln(model / measured)|; fits reach the values of their tables.";
    return section;
}

}  // namespace hts::validation
