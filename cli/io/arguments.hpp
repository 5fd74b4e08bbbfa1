/// The words of a command line before and after CLI11 reads them: verbs, help, values that are empty, options
/// that are none.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hts::cli {

/// The words after the program's name. `hts help VERB` becomes `hts VERB --help`. UsageError that names the
/// nearest verb where there is none of a name, and for `--option=` without a value.
[[nodiscard]] std::vector<std::string> command_words(const CLI::App& program, int argc, char** argv);

/// From here on every option refuses an empty value, and one of numbers whatever is none.
void require_values(CLI::App& program);

/// What a command line that cannot be parsed has wrong: the first option that is none, with the nearest that
/// is, else what CLI11 says.
[[nodiscard]] std::string complaint(const CLI::App& program, const CLI::ParseError& error);

}  // namespace hts::cli
