// hts validate: the model against measurements, exact scattering and its paper, as one report.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/charts/machine.hpp"
#include "cli/answers/validation_parts.hpp"
#include "cli/io/figure_files.hpp"
#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/io/table_writer.hpp"
#include "cli/io/usage.hpp"
#include "cli/verbs/verbs.hpp"
#include "hts/error.hpp"
#include "hts/version.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "validation/report/recorded.hpp"
#include "validation/report/report_page.hpp"

namespace hts::cli {
namespace {

namespace fs = std::filesystem;
using validation::Section;

constexpr auto validate_help = R"(
Writes into the folder
  report.html     everything on one page, pictures in it; what was learned comes first
  report.json     the criteria and the tables
  *.csv *.svg     the numbers and the pictures, with the scripts that draw them; *.png
--quick takes smaller samples and pictures, and shows stored results where the whole
computation takes long.

A criterion that the model misses is a finding. Exit code 1 if a result contradicts the
one recorded with the program, met or missed: then the program has changed. After a
change on purpose, record anew, with --quick and without:
  hts validate --quick --output out/v --record validation/report/data/recorded.json

Examples:
  hts validate --quick --output out/validation
  hts validate --only rays --output out/rays)";

struct ValidateOptions {
    std::string folder, curves, record;
    std::vector<std::string> only;
    bool quick = false;

    [[nodiscard]] validation::Effort effort() const {
        return quick ? validation::Effort::quick : validation::Effort::full;
    }
};

void write_rows(const fs::path& path, const validation::ReportTable& numbers) {
    Output output{path.string()};
    TableWriter table{output, Format::csv, numbers.columns};
    std::string text;
    for (const auto& cells : numbers.rows) {
        TableWriter::Row row{table, text};
        for (const std::string& cell : cells) row.field(cell);
        row.end();
    }
    table.add(text);
    table.finish();
    output.commit();
}

void write_tables_and_images(const fs::path& folder, const Section& section) {
    for (const validation::ReportTable& table : section.tables)
        write_rows(folder / (table.stem + ".csv"), table);
    for (const validation::Image& image : section.images) {
        write_file((folder / (image.stem + ".png")).string(), image.png);
    }
}

void say(const Section& section) {
    std::cout << section.title << '\n';
    for (const validation::Check& check : section.checks) {
        std::cout << (check.passed ? "  met     " : "  missed  ") << check.claim << ": " << check.measured
                  << '\n';
    }
}

std::vector<Section> sections_of(const ValidateOptions& options) {
    const auto is_wanted = [&](const ValidationPart& part) {
        return options.only.empty() || std::ranges::find(options.only, part.name) != options.only.end();
    };
    std::vector<Section> sections;
    spectral::Job job{"", static_cast<std::size_t>(std::ranges::count_if(validation_parts(), is_wanted))};
    for (const ValidationPart& part : validation_parts()) {
        if (!is_wanted(part)) continue;
        job.set_step(part.name);
        for (Section& section : part.make(options.effort(), options.curves)) {
            say(section);
            sections.push_back(std::move(section));
        }
        job.done();
    }
    return sections;
}

std::string provenance(bool quick) {
    return "hts " HTS_VERSION + std::string{quick ? " validate --quick, " : " validate, "} +
           bench::machine().text();
}

void require_known_parts(const std::vector<std::string>& only) {
    std::vector<std::string> names;
    for (const ValidationPart& part : validation_parts()) names.emplace_back(part.name);
    for (const std::string& part : only) {
        if (std::ranges::find(names, part) == names.end())
            throw UsageError{"--only: " + spectral::in_quotes(part) + ": " +
                             spectral::must_be_one_of(part, names)};
    }
}

/// What a file of results holds, which is written anew; the one of the program where there is none.
validation::Record record_at(const std::string& path) {
    if (!fs::exists(path)) return validation::Record::kept();
    return validation::Record::parse(spectral::read_text_file(path), path);
}

void run(const ValidateOptions& options) {
    require_known_parts(options.only);
    const fs::path folder{options.folder};
    validation::Validation findings{sections_of(options), {}};
    if (options.record.empty()) {
        findings.contradictions =
            validation::Record::kept().contradictions(findings.sections, options.effort());
    } else {
        write_file(options.record,
                   record_at(options.record).with(findings.sections, options.effort()).text());
    }
    for (const Section& section : findings.sections) write_tables_and_images(folder, section);
    const auto svg = [&](const validation::Figure& figure) {
        return spectral::read_text_file(write_figure(folder, figure));
    };
    const std::string origin = provenance(options.quick);
    write_file((folder / "report.html").string(), validation::report_page(findings, origin, svg));
    write_file((folder / "report.json").string(), validation::report_json(findings, origin));
    const auto [passed, all] = validation::tally(findings.sections);
    std::cout << passed << " of " << all << " criteria met: " << (folder / "report.html").string() << '\n';
    require_as_recorded(findings.contradictions, "validate");
}

}  // namespace

void add_validate(CLI::App& program) {
    CLI::App* verb =
        program.add_subcommand("validate", "the model against measurements, exact scattering and its paper");
    auto options = std::make_shared<ValidateOptions>();
    std::vector<std::string> names;
    for (const ValidationPart& part : validation_parts()) names.emplace_back(part.name);
    fills(verb->add_option("-o,--output", options->folder, "folder for the report"),
          {"report.html", "report.json"})
        ->required();
    offers(comma_list(*verb, "--only", options->only, "parts, separated by commas"), names);
    verb->add_option("--curves", options->curves,
                     "existing folder with any of he91-figure-7.json ... he91-figure-11.json, digitised")
        ->check(CLI::ExistingDirectory);
    verb->add_flag("--quick", options->quick, "smaller samples and pictures: a minute or two on two cores");
    verb->add_option("--record", options->record,
                     "file of results that later runs are held against: put these into it")
        ->each([](const std::string& path) { spectral::RunFiles::of_process()->will_continue(path); });
    verb->footer(validate_help);
    verb->callback([options] { run(*options); });
}

}  // namespace hts::cli
