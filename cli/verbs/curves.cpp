// hts curves: measured, digitised or computed reflectance curves as files.

#include <iostream>
#include <memory>

#include "cli/io/curve_argument.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/curves/curve_import.hpp"

namespace hts::cli {
namespace {

using validation::Curve;
using validation::CurvePoint;
using validation::CurveSet;

constexpr auto curves_help = R"(
A curve set is one surface seen by one instrument, with its source, its licence and the
command that made the file. Its format, and that of the recipes which say what an
imported file does not, are described in validation/curves/data/README.md.

Examples:
  hts curves list
  hts curves show mwir-brass --output brass.csv
  hts curves import brass.csv --recipe cli/data/brass-recipe.json --output brass.json)";

struct ImportOptions {
    std::string file, recipe, surface, output = "-";
    std::optional<int> every;
    InstrumentOptions instrument;
};

/// The command as it is to be repeated, without the folders of this machine.
std::string command(const ImportOptions& options) {
    const auto name = [](const std::string& path) { return std::filesystem::path{path}.filename().string(); };
    std::string text = "hts curves import " + name(options.file) + " --recipe " + name(options.recipe);
    if (!options.surface.empty()) text += " --surface '" + options.surface + "'";
    if (options.every) text += " --every " + std::to_string(*options.every);
    if (const auto& sr = options.instrument.source) text += " --source-solid-angle " + shortest(*sr);
    if (const auto& sr = options.instrument.detector) text += " --detector-solid-angle " + shortest(*sr);
    return text;
}

void run_import(const ImportOptions& options) {
    auto recipe = validation::read_recipe(options.recipe, options.surface);
    if (options.every) recipe.selection.every = *options.every;
    const CurveSet set =
        options.instrument.of(validation::imported_curves(options.file, recipe, command(options)));
    write_file(options.output, validation::curves_text(set));
    std::cerr << set.surface << ": " << set.curves.size() << " curves, " << set.point_count() << " points\n";
    for (const std::string& note : set.notes) std::cerr << "  " << note << '\n';
}

void run_list(const OutputOptions& options) {
    Output output{options.path};
    TableWriter table{output,
                      format_of(options.path, options.json),
                      {"name", "surface", "kind", "by", "licence", "curves", "points"}};
    for (const std::string& name : validation::built_in_curve_names()) {
        const CurveSet set = validation::built_in_curves(name);
        std::string text;
        TableWriter::Row row{table, text};
        row.field(name).field(set.surface).field(validation::name(set.kind)).field(set.by).field(set.licence);
        row.field(std::to_string(set.curves.size())).field(std::to_string(set.point_count())).end();
        table.add(text);
    }
    table.finish();
    output.commit();
}

struct ShowOptions {
    std::string set;
    OutputOptions output;
};

void run_show(const ShowOptions& options) {
    const CurveSet set = curves_from_argument(options.set);
    std::cerr << set.surface << ", " << validation::name(set.kind) << " by " << set.by
              << "\nsource: " << set.source << "\nlicence: " << set.licence << "\nhow: " << set.how << '\n';
    for (const std::string& note : set.notes) std::cerr << "note: " << note << '\n';
    Output output{options.output.path};
    const std::string per = std::string_view{validation::unit(set.quantity)} == "1/sr" ? "_per_sr" : "";
    TableWriter table{output,
                      format_of(options.output.path, options.output.json),
                      {"first_um", "last_um", "theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg",
                       "value" + per, "uncertainty" + per}};
    std::string text;
    for (const Curve& curve : set.curves) {
        for (const CurvePoint& p : curve.points) {
            TableWriter::Row row{table, text};
            for (const double x : {curve.band.first, curve.band.last, p.theta_i, p.phi_i, p.theta_r, p.phi_r,
                                   p.value, p.uncertainty})
                row.field(shortest(x));
            row.end();
        }
    }
    table.add(text);
    table.finish();
    output.commit();
}

void add_import(CLI::App& curves) {
    CLI::App* verb = curves.add_subcommand("import", "write a curve set from another program's file");
    auto options = std::make_shared<ImportOptions>();
    reads_whole(verb->add_option("file", options->file,
                                 "CSV, FRED, ASTM or pixels of a figure, - for standard\ninput"))
        ->required();
    reads_whole(verb->add_option("--recipe", options->recipe, "what the file itself does not say (JSON)"))
        ->required();
    verb->add_option("--surface", options->surface, "what was measured, where the recipe leaves it open");
    verb->add_option("--every", options->every,
                     "thin out: one point of so many, in place of the recipe's number")
        ->check(whole_number(1, 1000));
    options->instrument.add_to(*verb);
    writes(verb->add_option("-o,--output", options->output, "curve set (JSON), - for standard output"))
        ->capture_default_str();
    verb->callback([options] { run_import(*options); });
}

}  // namespace

void add_curves(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("curves", "measured and digitised curves: import, list, show");
    verb->require_subcommand(1);
    verb->footer(curves_help);
    add_import(*verb);
    CLI::App* list = verb->add_subcommand("list", "the curve sets that come with the program");
    auto list_options = std::make_shared<OutputOptions>();
    list_options->add_to(*list);
    list->callback([list_options] { run_list(*list_options); });
    CLI::App* show = verb->add_subcommand("show", "the points of a curve set");
    auto show_options = std::make_shared<ShowOptions>();
    offers(reads_whole(show->add_option("set", show_options->set, "name of the list, or a file")),
           validation::built_in_curve_names())
        ->required();
    show_options->output.add_to(*show);
    show->callback([show_options] { run_show(*show_options); });
}

}  // namespace hts::cli
