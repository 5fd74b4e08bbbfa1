/// The verbs of `hts table`, a file each.
#pragma once

#include <CLI/CLI.hpp>

namespace hts::cli {

/// Each adds its verb to `hts table`.
void add_table_build(CLI::App& table);
void add_table_chart(CLI::App& table);
void add_table_check(CLI::App& table);
void add_table_export(CLI::App& table);
void add_table_import(CLI::App& table);
void add_table_info(CLI::App& table);
void add_table_lookup(CLI::App& table);
void add_table_merge(CLI::App& table);

}  // namespace hts::cli
