/// Shell completion of the command, from what its verbs say of themselves.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hts::cli {

/// The script for "bash", "zsh" or "fish".
[[nodiscard]] std::string completion_script(const CLI::App& program, const std::string& shell);

}  // namespace hts::cli
