/// The verbs of the command `hts`, a file each; every one is a thin worked example of the library.
#pragma once

#include <CLI/CLI.hpp>

namespace hts::cli {

/// Each adds its verb to the program. The work runs, and throws, while the command line is parsed:
/// UsageError or CLI::ParseError for wrong usage, hts::Error for bad data.
void add_albedo(CLI::App& program);
void add_chart(CLI::App& program);
void add_compare(CLI::App& program);
void add_completion(CLI::App& program);
void add_curves(CLI::App& program);
void add_eval(CLI::App& program);
void add_info(CLI::App& program);
void add_figures(CLI::App& program);
void add_fit(CLI::App& program);
void add_furnace(CLI::App& program);
void add_materials(CLI::App& program);
void add_phi(CLI::App& program);
void add_plan(CLI::App& program);
void add_polar(CLI::App& program);
void add_render(CLI::App& program);
void add_sample(CLI::App& program);
void add_scatter(CLI::App& program);
void add_spectrum(CLI::App& program);
void add_stability(CLI::App& program);
void add_table(CLI::App& program);
void add_surface(CLI::App& program);
void add_truth(CLI::App& program);
void add_validate(CLI::App& program);

}  // namespace hts::cli
