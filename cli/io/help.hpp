/// The help texts of the command: every line within the width of a terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hts::cli {

/// No line of a help text has more letters.
inline constexpr std::size_t help_columns = 80;

/// Text broken where a line would be longer: prose is filled anew, a list goes on under what it says, a
/// command of an example with \ at the end of the line.
[[nodiscard]] std::string wrapped_help(const std::string& text);

/// Names an option by its first long name; others are spellings of before.
class HelpFormatter : public CLI::Formatter {
  public:
    [[nodiscard]] std::string make_option(const CLI::Option* option, bool is_positional) const override;
    [[nodiscard]] std::string make_subcommand(const CLI::App* verb) const override;
    [[nodiscard]] std::string make_usage(const CLI::App* verb, std::string name) const override;
    [[nodiscard]] std::string make_description(const CLI::App* verb) const override;
    [[nodiscard]] std::string make_footer(const CLI::App* verb) const override;
};

}  // namespace hts::cli
