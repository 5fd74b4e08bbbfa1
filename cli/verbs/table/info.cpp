// hts table info: what a table is of, how it is laid out and what it promises.

#include <algorithm>
#include <memory>
#include <utility>

#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/verbs/table/table.hpp"
#include "hts/error.hpp"
#include "tables/table/table.hpp"

namespace hts::cli {
namespace {

struct InfoOptions {
    std::string table;
    OutputOptions output;
};

/// Key and value, the value as JSON has it.
using Line = std::pair<std::string, std::string>;

std::vector<Line> lines(const tables::Table& table) {
    const auto& info = table.info();
    const auto um = info.wavelengths.micrometres();
    const auto& nodes = info.nodes;
    const auto whole = [](auto value) { return std::to_string(value); };
    return {{"name", json_string(info.source.name)},
            {"material_path", json_string(info.source.material_path)},
            {"library_version", json_string(info.library_version)},
            {"wavelengths", whole(um.size())},
            {"first_um", shortest(um.front())},
            {"last_um", shortest(um.back())},
            {"steepest_theta_deg", "88"},
            {"tolerance", shortest(info.tolerance)},
            {"largest_error", shortest(info.error.largest)},
            {"percentile_99_error", shortest(info.error.percentile_99)},
            {"median_error", shortest(info.error.median)},
            {"measured_pairs", whole(info.error.pairs)},
            {"seed", whole(info.error.seed)},
            {"nodes_grazing", whole(nodes.grazing)},
            {"nodes_ratio", whole(nodes.ratio)},
            {"nodes_turn", whole(nodes.turn)},
            {"components", whole(info.components)},
            {"nodes_specular", whole(nodes.specular)},
            {"nodes_albedo", whole(nodes.albedo)},
            {"nodes_polarisation", whole(nodes.polarisation)},
            {"numbers", info.double_precision ? "\"double\"" : "\"float\""},
            {"bytes", whole(table.bytes())}};
}

void run(const InfoOptions& options) {
    const auto table = tables::Table::open(options.table);
    const auto all = lines(table);
    std::string text;
    if (format_of(options.output.path, options.output.json) == Format::json) {
        for (const auto& [key, value] : all)
            text += (text.empty() ? "{" : ",\n ") + json_string(key) + ": " + value;
        text += ",\n \"material\": " + table.info().source.material + "}\n";
    } else {
        constexpr std::size_t width = 22;
        for (const auto& [key, value] : all) {
            text.append(key).append(width - std::min(width - 1, key.size()), ' ').append(value) += '\n';
        }
    }
    write_file(options.output.path, text);
}

}  // namespace

void add_table_info(CLI::App& table) {
    CLI::App* verb = table.add_subcommand("info", "what a table holds and promises");
    auto options = std::make_shared<InfoOptions>();
    reads(verb->add_option("table", options->table, "file to read"))->required();
    options->output.add_to(*verb);
    verb->get_option("--json")->description("write JSON instead of text");
    verb->footer("\nExample:\n  hts table info m.htst");
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
