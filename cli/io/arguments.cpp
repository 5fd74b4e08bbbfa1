#include "cli/io/arguments.hpp"

#include <algorithm>
#include <charconv>

#include "cli/io/usage.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

std::vector<const CLI::App*> verbs_of(const CLI::App& parent) {
    return parent.get_subcommands([](const CLI::App*) { return true; });
}

/// The verb of this name below `parent`; none if there is nothing to choose.
const CLI::App* known_verb(const CLI::App& parent, const std::string& command, const std::string& word) {
    const auto verbs = verbs_of(parent);
    if (verbs.empty() || word.starts_with('-')) return nullptr;
    std::vector<std::string> names;
    for (const CLI::App* verb : verbs) {
        if (verb->get_name() == word) return verb;
        names.push_back(verb->get_name());
    }
    const std::string problem = word.empty() ? "verb missing" : "unknown verb " + spectral::in_quotes(word);
    throw UsageError{problem + ": " + spectral::must_be_one_of(word, names) + " (see " + command +
                     " --help)"};
}

/// Takes "help" out of the verbs; whether it was there.
bool take_help(std::vector<std::string>& words, std::size_t at) {
    if (at >= words.size() || words[at] != "help") return false;
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
    return true;
}

/// "+30" is 30; infinity and NaN are numbers, which the options refuse that cannot take them.
bool is_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    return problem == std::errc{} && end == text.data() + text.size();
}

bool takes_numbers(const CLI::Option& option) {
    return option.get_type_name().find("FLOAT") != std::string::npos;
}

void require_value(CLI::Option& option) {
    if (option.get_type_size() == 0) return;  // a flag
    const bool numbers = takes_numbers(option);
    option.check(CLI::Validator{[numbers](const std::string& text) -> std::string {
                                    if (text.empty()) return "\"\": must not be empty";
                                    if (numbers && !is_number(text))
                                        return spectral::in_quotes(text) + ": must be a number";
                                    return "";
                                },
                                ""});
}

/// The verb that the command line names, and how it is called.
std::pair<const CLI::App*, std::string> verb_called(const CLI::App& program) {
    const CLI::App* verb = &program;
    std::string command = "hts";
    for (auto chosen = verb->get_subcommands(); !chosen.empty(); chosen = verb->get_subcommands()) {
        verb = chosen.front();
        command += " " + verb->get_name();
    }
    return {verb, command};
}

std::vector<std::string> option_names(const CLI::App& verb) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

}  // namespace

std::vector<std::string> command_words(const CLI::App& program, int argc, char** argv) {
    std::vector<std::string> words{argv + 1, argv + argc};
    const CLI::App* parent = &program;
    std::string command = "hts";
    bool help = false;
    for (std::size_t i = 0; parent != nullptr; ++i) {
        help = take_help(words, i) || help;
        if (help && i >= words.size()) break;
        const std::string word = i < words.size() ? words[i] : "";
        parent = known_verb(*parent, command, word);
        command += " " + word;
    }
    if (help) words.emplace_back("--help");
    for (const std::string& word : words) {
        // CLI11 would take the next word for its value
        if (word.starts_with("--") && word.size() > 3 && word.find('=') == word.size() - 1)
            throw UsageError{word.substr(0, word.size() - 1) + ": \"\": must not be empty"};
    }
    return words;
}

// NOLINTNEXTLINE(misc-no-recursion): verbs nest
void require_values(CLI::App& program) {
    for (CLI::Option* option : program.get_options()) require_value(*option);
    for (CLI::App* verb : program.get_subcommands([](CLI::App*) { return true; })) require_values(*verb);
}

std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
    const bool of_values = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr ||
                           dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
    const auto [verb, command] = verb_called(program);
    const std::string see = " (see " + command + " --help)";
    for (const std::string& word : verb->remaining()) {
        if (of_values || !word.starts_with('-') || word.size() < 2 || is_number(word)) continue;
        const std::string name = word.substr(0, word.find('='));
        return "unknown option " + spectral::in_quotes(name) +
               (verb == &program ? ": a subcommand must come first (see hts --help)"
                                 : spectral::did_you_mean(name, option_names(*verb)) + see);
    }
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !verb->remaining().empty())
        return spectral::in_quotes(verb->remaining().front()) + ": not expected" + see;
    std::string said = error.what();
    if (const auto most = said.find(": At Most 1 required"); most != std::string::npos)
        return said.substr(0, most) + ": given more than once: must be given once" + see;
    if (const auto needed = said.find(": 1 required"); needed != std::string::npos)
        return said.substr(0, needed) + ": must have a value" + see;
    return said;
}

}  // namespace hts::cli
