#include "cli/answers/eval_plan.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "cli/answers/eval_answer.hpp"
#include "cli/answers/point_evaluator.hpp"
#include "cli/answers/validity_warning.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/transform.hpp"
#include "cli/io/usage.hpp"
#include "hts/error.hpp"
#include "spectral/colour/display_colour.hpp"
#include "spectral/plans/plan.hpp"
#include "tables/formats/measured_model.hpp"
#include "tables/table/table.hpp"

namespace hts::cli {
namespace {

using spectral::LinearRgb;
using spectral::Plan;
using spectral::PlannedForm;
using spectral::Reflectance;

/// Which of a plan's materials a name means.
std::size_t place(const Plan& plan, const std::string& name) {
    if (name.empty() && plan.materials.size() == 1) return 0;
    std::string names;
    for (std::size_t i = 0; i < plan.materials.size(); ++i) {
        if (plan.materials[i].name == name) return i;
        names.append(names.empty() ? "" : ", ").append(plan.materials[i].name);
    }
    const std::string problem = name.empty() ? "--material missing" : "--material \"" + name + "\"";
    throw UsageError{problem + ": must be a material of the plan: " + names};
}

/// A pair of directions within the domain for which the plan's errors were measured.
class PlannedPair {
  public:
    PlannedPair(const CsvReader& points, const spectral::Scene& scene, const spectral::Material& material)
        : columns_{points},
          scene_{scene},
          full_model_{material.at(scene.wavelengths, {.outside = scene.outside_range})} {}

    [[nodiscard]] DirectionPair operator()(const CsvRow& row) const {
        const DirectionPair pair = columns_.pair(row);
        require("light", pair.in, scene_.largest_theta_i);
        require("view", pair.out, scene_.largest_theta_r);
        warning_.note(full_model_, pair);
        return pair;
    }
    /// How many of them, at how many wavelengths, were outside the model's validity.
    void print_warning() const { warning_.print(full_model_.name()); }

  private:
    static void require(const char* what, const Direction& direction, double largest) {
        constexpr double rounding = 1e-12;
        const double theta = std::atan2(direction.sin_theta(), direction.cos_theta());
        if (theta <= largest + rounding) return;
        constexpr double degree = std::numbers::pi / 180;
        throw Error{std::string{what} + ": " +
                    out_of_range("polar angle", theta / degree, "deg",
                                 "<= " + shortest(largest / degree) + " deg, the largest of the plan's scene")
                        .what()};
    }

    PairColumns columns_;
    const spectral::Scene& scene_;
    Reflectance full_model_;           // at the scene's wavelengths
    mutable ValidityWarning warning_;  // counts from any thread
};

struct SpectralValue {
    double wavelength, brdf, specular_reflectance;
    Mueller mueller, specular_mueller;
};

void evaluate_spectrum(const Reflectance& planned, bool polarised, const DirectionPair& pair,
                       std::span<SpectralValue> result) {
    const auto specular = planned.specular_reflectance(pair.in);
    const auto mueller = polarised ? planned.mueller(pair) : std::vector<Mueller>(result.size());
    const auto mirror = polarised ? planned.specular_mueller(pair.in) : std::vector<Mueller>(result.size());
    const auto brdf = polarised ? std::vector<double>(result.size()) : planned.brdf(pair);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = {planned.wavelengths().micrometres()[i], polarised ? mueller[i](0, 0) : brdf[i],
                     specular[i].value(), mueller[i], mirror[i]};
    }
}

struct ColourValue {
    LinearRgb diffuse, specular;
};

std::vector<std::string> joined(std::vector<std::string> columns, const std::vector<std::string>& more) {
    columns.insert(columns.end(), more.begin(), more.end());
    return columns;
}

void write_spectra(const Reflectance& planned, const PlannedPair& pair, bool polarised, bool mueller,
                   CsvReader& points, Output& output, Format format) {
    auto columns = joined(points.columns(), {"wavelength_um", "brdf", "specular_reflectance"});
    if (mueller) columns = joined(std::move(columns), mueller_columns());
    TableWriter table{output, format, columns};
    Transform<SpectralValue>{points, table, planned.size()}.run(
        [&](const CsvRow& row, std::span<SpectralValue> result) {
            evaluate_spectrum(planned, polarised, pair(row), result);
        },
        [&](TableWriter::Row& row, const SpectralValue& value) {
            row.field(shortest(value.wavelength)).number(value.brdf).number(value.specular_reflectance);
            if (mueller) append_mueller(row, value.mueller, value.specular_mueller);
        });
}

void write_colours(const PlannedForm& planned, const PlannedPair& pair, spectral::Illuminant illuminant,
                   CsvReader& points, Output& output, Format format) {
    TableWriter table{output, format,
                      joined(points.columns(),
                             {"red", "green", "blue", "specular_red", "specular_green", "specular_blue"})};
    Transform<ColourValue>{points, table, 1}.run(
        [&](const CsvRow& row, std::span<ColourValue> result) {
            const DirectionPair at = pair(row);
            std::vector<double> scratch(planned.at_nodes().size());
            result[0] = {linear_srgb(planned.colour(at, scratch), illuminant),
                         linear_srgb(planned.specular_colour(at.in), illuminant)};
        },
        [&](TableWriter::Row& row, const ColourValue& value) {
            for (const LinearRgb& rgb : {value.diffuse, value.specular}) {
                row.number(rgb.red).number(rgb.green).number(rgb.blue);
            }
        });
}

}  // namespace

void evaluate_planned(const PlannedEval& options, CsvReader& points, const OutputOptions& answer) {
    const Plan plan = spectral::read_plan(options.plan, tables::models_with_files(), tables::open_for_plan);
    const std::size_t chosen = place(plan, options.material);
    const PlannedForm& planned = plan.materials[chosen].form;
    if (options.mueller && !plan.scene.polarised) {
        throw UsageError{"--mueller: the plan is for unpolarised light: must be polarised in its scene"};
    }
    if (points.find_column("wavelength_um")) {
        throw UsageError{"column wavelength_um: the plan has the wavelengths: must not come with --plan"};
    }
    const PlannedPair pair{points, plan.scene, plan.scene.materials[chosen]};
    Output output{answer.path};
    const Format format = format_of(answer.path, answer.json);
    if (plan.scene.illuminant) {
        write_colours(planned, pair, *plan.scene.illuminant, points, output, format);
    } else {
        write_spectra(planned.reflectance(), pair, plan.scene.polarised, options.mueller, points, output,
                      format);
    }
    output.commit();
    pair.print_warning();
}

}  // namespace hts::cli
