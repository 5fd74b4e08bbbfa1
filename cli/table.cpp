// hts table: a parent verb; what it can do stands in files of their own.

#include "cli/table.hpp"

#include "cli/verbs.hpp"

namespace hts::cli {

void add_table(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("table", "lookup tables and the files of other programs");
    verb->require_subcommand(1);
    add_table_export(*verb);
    add_table_import(*verb);
    verb->footer("\nExample:\n  hts table export aluminium.json --format rgl --output aluminium.bsdf");
}

}  // namespace hts::cli
