/// What `hts table` can do, a file each.
#pragma once

#include <CLI/CLI.hpp>

namespace hts::cli {

/// Each adds its verb below `hts table`.
void add_table_export(CLI::App& table);
void add_table_import(CLI::App& table);

}  // namespace hts::cli
