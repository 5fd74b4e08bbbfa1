#include "cli/io/completion.hpp"

#include <vector>

#include "cli/io/options.hpp"

namespace hts::cli {
namespace {

/// A verb with the words that lead to it: "hts table build".
struct Verb {
    std::string path;
    const CLI::App* app;
};

// NOLINTNEXTLINE(misc-no-recursion): verbs nest
void collect(std::vector<Verb>& verbs, const std::string& path, const CLI::App& app) {
    verbs.push_back({path, &app});
    for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; }))
        collect(verbs, path + " " + below->get_name(), *below);
}

std::vector<Verb> every_verb(const CLI::App& program) {
    std::vector<Verb> verbs;
    collect(verbs, "hts", program);
    return verbs;
}

/// Text that a shell takes as it is.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "'\\''" : c == '\n' ? " " : std::string(1, c);
    return result + "'";
}

/// In fish only \ and ' are read inside quotation marks.
std::string fish_quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' || c == '\\' ? std::string{'\\', c} : c == '\n' ? " " : std::string(1, c);
    return result + "'";
}

std::string spaced(const std::vector<std::string>& words, const char* between = " ") {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// -m and --material; of several long names the first.
std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    if (!option.get_snames().empty()) names.push_back("-" + option.get_snames().front());
    if (!option.get_lnames().empty()) names.push_back("--" + option.get_lnames().front());
    return names;
}

std::vector<std::string> positional_choices(const CLI::App& app) {
    std::vector<std::string> words;
    for (const CLI::Option* option : app.get_options()) {
        const auto& choices = choices_of(option);
        if (option->get_positional()) words.insert(words.end(), choices.begin(), choices.end());
    }
    return words;
}

std::vector<std::string> names_below(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(below->get_name());
    return names;
}

/// Whether a value may be a file: not where it is one of some words, or a number.
bool may_be_file(const CLI::Option& option) {
    return option.get_type_name().starts_with("TEXT") && choices_of(&option).empty();
}

/// Lines of a case for each verb; `line` says what is done there.
template <class Line>
std::string cases(const std::vector<Verb>& verbs, const char* indent, const Line& line) {
    std::string text;
    for (const Verb& verb : verbs) text += indent + ("\"" + verb.path + "\") ") + line(*verb.app) + " ;;\n";
    return text;
}

std::string paths_below(const std::vector<Verb>& verbs, const char* between) {
    std::vector<std::string> paths;
    for (std::size_t i = 1; i < verbs.size(); ++i) paths.push_back("\"" + verbs[i].path + "\"");
    return spaced(paths, between);
}

// ---- bash

/// What the value of an option may be.
std::string bash_values(const std::vector<Verb>& verbs) {
    std::string text;
    for (const Verb& verb : verbs) {
        for (const CLI::Option* option : verb.app->get_options()) {
            if (option->get_type_size() == 0) continue;
            std::vector<std::string> cases;
            for (const std::string& name : names_of(*option))
                cases.push_back("\"" + verb.path + " " + name + "\"");
            if (cases.empty()) continue;
            const auto& choices = choices_of(option);
            const std::string action = !choices.empty()       ? "-W " + quoted(spaced(choices))
                                       : may_be_file(*option) ? "-f"
                                                              : "-W ''";
            text += "        " + spaced(cases, "|") + ") COMPREPLY=($(compgen " + action +
                    " -- \"$cur\")); return ;;\n";
        }
    }
    return text;
}

std::string bash_script(const std::vector<Verb>& verbs) {
    const auto words = [](const CLI::App& app) {
        std::vector<std::string> all = names_below(app);
        for (const std::string& choice : positional_choices(app)) all.push_back(choice);
        for (const CLI::Option* option : app.get_options()) {
            for (const std::string& name : names_of(*option)) all.push_back(name);
        }
        if (app.get_parent() == nullptr) all.emplace_back("help");
        return "words=" + quoted(spaced(all));
    };
    return "# bash completion of hts, written by: hts completion bash\n"
           "_hts() {\n"
           "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb=hts words= i\n"
           "    COMPREPLY=()\n"
           "    for ((i = 1; i < COMP_CWORD; i++)); do\n"
           "        case \"$verb ${COMP_WORDS[i]}\" in\n"
           "            " +
           paths_below(verbs, "|") +
           ") verb=\"$verb ${COMP_WORDS[i]}\" ;;\n"
           "        esac\n"
           "    done\n"
           "    case \"$verb $prev\" in\n" +
           bash_values(verbs) +
           "    esac\n"
           "    case \"$verb\" in\n" +
           cases(verbs, "        ", words) +
           "    esac\n"
           "    COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
           "    [[ $cur == -* ]] || COMPREPLY+=($(compgen -f -- \"$cur\"))\n"
           "}\n"
           "complete -o filenames -F _hts hts\n";
}

// ---- zsh

/// name:description, as _describe takes it.
std::string described(const std::string& name, std::string text) {
    for (std::size_t at = 0; (at = text.find(':', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\\:");
    return quoted(name + ":" + text);
}

std::string zsh_script(const std::vector<Verb>& verbs) {
    const auto words = [](const CLI::App& app) {
        std::string text = "below=(";
        for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; }))
            text += described(each->get_name(), each->get_description()) + " ";
        for (const std::string& choice : positional_choices(app)) text += quoted(choice) + " ";
        text += "); options=(";
        for (const CLI::Option* option : app.get_options()) {
            for (const std::string& name : names_of(*option))
                text += described(name, option->get_description()) + " ";
        }
        return text + ")";
    };
    std::string values;
    for (const Verb& verb : verbs) {
        for (const CLI::Option* option : verb.app->get_options()) {
            if (option->get_type_size() == 0 || names_of(*option).empty()) continue;
            std::vector<std::string> cases;
            for (const std::string& name : names_of(*option))
                cases.push_back("\"" + verb.path + " " + name + "\"");
            const auto& choices = choices_of(option);
            const std::string action = !choices.empty()       ? "compadd -- " + spaced(choices)
                                       : may_be_file(*option) ? "_files"
                                                              : "_message value";
            values += "        " + spaced(cases, "|") + ") " + action + "; return ;;\n";
        }
    }
    return "#compdef hts\n"
           "# zsh completion of hts, written by: hts completion zsh\n"
           "_hts() {\n"
           "    local verb=hts word\n"
           "    local -a below options\n"
           "    for word in ${words[2,CURRENT-1]}; do\n"
           "        case \"$verb $word\" in\n"
           "            " +
           paths_below(verbs, "|") +
           ") verb=\"$verb $word\" ;;\n"
           "        esac\n"
           "    done\n"
           "    case \"$verb ${words[CURRENT-1]}\" in\n" +
           values +
           "    esac\n"
           "    case \"$verb\" in\n" +
           cases(verbs, "        ", words) +
           "    esac\n"
           "    if [[ ${words[CURRENT]} == -* ]]; then\n"
           "        _describe option options\n"
           "    else\n"
           "        (( $#below )) && _describe verb below\n"
           "        _files\n"
           "    fi\n"
           "}\n"
           "compdef _hts hts\n";
}

// ---- fish

std::string fish_script(const std::vector<Verb>& verbs) {
    std::string text =
        "# fish completion of hts, written by: hts completion fish\n"
        "function __hts_verb\n"
        "    set -l verb hts\n"
        "    for word in (commandline -opc)[2..-1]\n"
        "        switch \"$verb $word\"\n"
        "            case " +
        paths_below(verbs, " ") +
        "\n"
        "                set verb \"$verb $word\"\n"
        "        end\n"
        "    end\n"
        "    echo $verb\n"
        "end\n";
    for (const Verb& verb : verbs) {
        const std::string at = "complete -c hts -n 'test (__hts_verb) = \"" + verb.path + "\"' ";
        for (const CLI::App* below : verb.app->get_subcommands([](const CLI::App*) { return true; }))
            text += at + "-f -a " + below->get_name() + " -d " + fish_quoted(below->get_description()) + "\n";
        if (const auto choices = positional_choices(*verb.app); !choices.empty())
            text += at + "-a " + fish_quoted(spaced(choices)) + "\n";
        for (const CLI::Option* option : verb.app->get_options()) {
            if (names_of(*option).empty()) continue;
            text += at;
            if (!option->get_snames().empty()) text += "-s " + option->get_snames().front() + " ";
            if (!option->get_lnames().empty()) text += "-l " + option->get_lnames().front() + " ";
            if (option->get_type_size() != 0) text += may_be_file(*option) ? "-r " : "-x ";
            if (!choices_of(option).empty()) text += "-a " + fish_quoted(spaced(choices_of(option))) + " ";
            text += "-d " + fish_quoted(option->get_description()) + "\n";
        }
    }
    return text;
}

}  // namespace

std::string completion_script(const CLI::App& program, const std::string& shell) {
    const auto verbs = every_verb(program);
    if (shell == "bash") return bash_script(verbs);
    return shell == "zsh" ? zsh_script(verbs) : fish_script(verbs);
}

}  // namespace hts::cli
