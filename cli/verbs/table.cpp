// hts table: lookup tables with a promised error.

#include "cli/verbs/table/table.hpp"
#include "cli/verbs/verbs.hpp"

namespace hts::cli {

void add_table(CLI::App& program) {
    CLI::App* table = program.add_subcommand(
        "table", "lookup tables with a promised error, and the files of other programs");
    table->require_subcommand(1);
    add_table_build(*table);
    add_table_check(*table);
    add_table_info(*table);
    add_table_lookup(*table);
    add_table_merge(*table);
    add_table_chart(*table);
    add_table_export(*table);
    add_table_import(*table);
    table->footer("Each verb explains itself: hts table build --help");
}

}  // namespace hts::cli
