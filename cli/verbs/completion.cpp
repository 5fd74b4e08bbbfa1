// hts completion: what a shell asks to complete the words of the command.

#include "cli/io/completion.hpp"

#include <memory>

#include "cli/io/options.hpp"
#include "cli/io/output.hpp"
#include "cli/verbs/verbs.hpp"

namespace hts::cli {
namespace {

constexpr auto completion_help = R"(
Verbs, options, and the values of options that take one of some words.
  bash   hts completion bash > ~/.local/share/bash-completion/completions/hts
  zsh    hts completion zsh > _hts, in a folder of $fpath
  fish   hts completion fish > ~/.config/fish/completions/hts.fish

Example:
  hts completion bash)";

}  // namespace

void add_completion(CLI::App& program) {
    CLI::App* verb = program.add_subcommand("completion", "script that completes the command in a shell");
    auto shell = std::make_shared<std::string>();
    one_of(verb->add_option("shell", *shell, "which"), {"bash", "zsh", "fish"})->required();
    verb->footer(completion_help);
    verb->callback([&program, shell] { write_file("-", completion_script(program, *shell)); });
}

}  // namespace hts::cli
