// hts compare: a model beside measured curves.

#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <system_error>

#include "cli/answers/validity_warning.hpp"
#include "cli/io/curve_argument.hpp"
#include "cli/io/figure_files.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "validation/curves/comparison_section.hpp"

namespace hts::cli {
namespace {

using validation::Check;
using validation::ReportTable;
using validation::Section;

constexpr auto compare_help = R"(
The model is averaged over the band and the instrument's solid angles and set beside each
point; a material that hts fit wrote is multiplied by the factor fitted to these curves.
CURVES is a curve set (see hts curves) or the name of one that comes with the program.
Figures of merit go to standard output; criteria, where the set has any, to
standard error, and one that is missed makes the exit code 1. With --output the plots,
their scripts and numbers go into a folder.

Examples:
  hts compare mwir-aluminium-sandblasted --material cli/data/very-rough-aluminium.json --output out
  hts compare curet-sandpaper --material cli/data/sandpaper.json --detector-solid-angle 2e-3)";

struct CompareOptions {
    std::string curves, folder;
    MaterialOptions material;
    InstrumentOptions instrument;
    std::optional<double> scale;
    int wavelengths = 8, rings = 2;
    bool json = false;
};

void write_report_table(Output& output, Format format, const ReportTable& report) {
    TableWriter table{output, format, report.columns};
    std::string text;
    for (const auto& cells : report.rows) {
        TableWriter::Row row{table, text};
        for (const std::string& cell : cells) row.field(cell);
        row.end();
    }
    table.add(text);
    table.finish();
}

void draw_section(const Section& section, const std::filesystem::path& folder, bool json) {
    for (const ReportTable& table : section.tables) {
        Output output{(folder / (table.stem + ".csv")).string()};
        write_report_table(output, Format::csv, table);
        output.commit();
    }
    for (const validation::Figure& figure : section.figures)
        std::cerr << write_figure(folder, figure, json).string() << '\n';
}

/// The factor on all values that a fit to these curves found beside the material; 1 where it found none.
double fitted_scale(const std::string& material, const validation::CurveSet& set) {
    // a pipe is gone once the material was read
    if (std::error_code ignored; !std::filesystem::is_regular_file(material, ignored)) return 1;
    const auto fitted = spectral::JsonValue::read(material).find("fitted");
    return fitted && (*fitted)["data"].text() == set.stem ? (*fitted)["scale"].number() : 1;
}

/// What a reader of the numbers should know beside them.
void say_what_bears_on_it(const validation::CurveSet& set, const spectral::Material& material, double scale) {
    if (scale != 1) std::cerr << "model times the factor " << brief(scale) << '\n';
    const auto& properties = material.properties();
    const bool hemispherical = set.quantity == validation::Quantity::hemispherical_reflectance;
    if (properties.specular_term && !hemispherical && !set.source_solid_angle && !set.detector_solid_angle)
        std::cerr << "the specular term was not compared: no solid angle of source or detector is stated "
                     "(--detector-solid-angle)\n";
    if (set.roughness && properties.surface)
        std::cerr << validation::roughness_statement(properties.surface->rms_roughness(), *set.roughness)
                  << '\n';
}

void run(const CompareOptions& options) {
    const auto set = options.instrument.of(curves_from_argument(options.curves));
    const auto material = options.material.read();
    const double scale = options.scale ? *options.scale : fitted_scale(options.material.path, set);
    std::string model = validation::described(material);
    if (scale != 1) model += ", times " + brief(scale);
    const Section section = validation::comparison_section(set, material,
                                                           {.model = model,
                                                            .policy = options.material.policy(),
                                                            .nodes = {options.wavelengths, options.rings},
                                                            .scale = scale});
    say_what_bears_on_it(set, material, scale);
    std::set<double> um;
    for (const auto& curve : set.curves) um.insert((curve.band.first + curve.band.last) / 2);
    warn_of_gain_of(material.at(spectral::WavelengthGrid::from_micrometres({um.begin(), um.end()}),
                                {.outside = options.material.policy()}),
                    options.material.path);
    Output output{"-"};
    write_report_table(output, options.json ? Format::json : Format::csv, section.tables.front());
    output.commit();
    bool passed = true;
    for (const Check& check : section.checks) {
        std::cerr << check.verdict() << ": " << check.claim << ": " << check.measured << '\n';
        passed = passed && check.passed;
    }
    if (!options.folder.empty()) draw_section(section, options.folder, options.json);
    if (!passed) throw CheckFailed{set.surface + ": the model does not meet the criteria"};
}

}  // namespace

void add_compare(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("compare", "a model beside measured curves: figures of merit, plots");
    auto options = std::make_shared<CompareOptions>();
    offers(reads_whole(verb->add_option("curves", options->curves,
                                        "curve set (JSON), or the name of one in hts curves list")),
           validation::built_in_curve_names())
        ->required();
    options->material.add_to(*verb)->required();
    fills(verb->add_option("-o,--output", options->folder,
                           "folder for plots, numbers and tables (needs gnuplot)"));
    options->instrument.add_to(*verb);
    verb->add_option("--scale", options->scale,
                     "factor on the model, in place of the one that hts fit wrote beside the material")
        ->check(number_within(1e-9, 1e9));
    verb->add_option("--band-nodes", options->wavelengths, "wavelengths per band, 1 ... 64")
        ->check(whole_number(1, 64))
        ->capture_default_str();
    verb->add_option("--rings,--cone-rings", options->rings, "rings of nodes per cone, 0 ... 8")
        ->check(whole_number(0, 8))
        ->capture_default_str();
    verb->add_flag("--json", options->json, "figures of merit as JSON");
    verb->footer(compare_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
