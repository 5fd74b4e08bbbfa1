// hts stability: where methods for the model fail, and that this engine does not.

#include <iostream>
#include <memory>
#include <sstream>

#include "bench/stability/stability.hpp"
#include "bench/stability/stability_report.hpp"
#include "cli/io/options.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto stability_help = R"(
Thirteen places where methods for the He-Torrance model fail in floating point: at each,
this engine and the naive methods meet references of 80 digits or exact limits. The table
says how each fared, by how much it is wrong and where it is worst; * marks the engine.
--output FOLDER also writes stability.html (a page with the reason of every failure) and
stability.csv there. Exit code 1 if the engine fails any row.

Examples:
  hts stability
  hts stability --output out/stability
  hts stability --json)";

using Results = std::vector<bench::StabilityResult>;

struct StabilityOptions {
    std::string folder;
    bool json = false;
};

template <class Write>
std::string text_of(const Results& results, Write&& write) {
    std::ostringstream out;
    write(out, results);
    return out.str();
}

void append_row(const TableWriter& table, std::string& text, const bench::StabilityResult& result) {
    TableWriter::Row row{table, text};
    row.number(result.row).field(result.problem).field(result.method).word(result.engine ? "yes" : "no");
    row.word(name(result.verdict)).number(result.error).number(result.bound);
    row.number(static_cast<double>(result.cases)).number(static_cast<double>(result.failures));
    row.field(result.detail).field(result.where).field(result.why).end();
}

void write_json(const Results& results) {
    Output output{"-"};
    TableWriter table{output,
                      Format::json,
                      {"row", "problem", "method", "engine", "verdict", "error", "bound", "cases", "failures",
                       "detail", "where", "why"}};
    std::string text;
    for (const bench::StabilityResult& result : results) append_row(table, text, result);
    table.add(text);
    table.finish();
    output.commit();
}

void write_folder(const fs::path& folder, const Results& results) {
    write_file((folder / "stability.html").string(), text_of(results, bench::write_stability_html));
    write_file((folder / "stability.csv").string(), text_of(results, bench::write_stability_csv));
}

void run(const StabilityOptions& options) {
    const Results results = bench::stability_suite();
    if (options.json) {
        write_json(results);
    } else {
        write_file("-", text_of(results, bench::write_stability_text));
    }
    if (!options.folder.empty()) write_folder(options.folder, results);
    if (!bench::engine_passes(results))
        throw CheckFailed{"stability: the engine fails (rows marked * above)"};
}

}  // namespace

void add_stability(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("stability", "where methods for the model fail, and this one not");
    auto options = std::make_shared<StabilityOptions>();
    fills(verb->add_option("-o,--output", options->folder, "folder for stability.html and stability.csv"),
          {"stability.html", "stability.csv"});
    verb->add_flag("--json", options->json, "JSON instead of the table");
    verb->footer(stability_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
