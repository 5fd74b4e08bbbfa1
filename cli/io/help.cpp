#include "cli/io/help.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "cli/io/options.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

constexpr std::size_t text_column = 26;  // where descriptions begin

/// Letters, as a terminal counts them.
std::size_t letters(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Words of a shell command: white space inside quotation marks does not part them.
std::vector<std::string> shell_words(std::string_view line) {
    std::vector<std::string> words(1);
    char quote = 0;
    for (const char c : line) {
        if (quote == 0 && c == ' ') {
            if (!words.back().empty()) words.emplace_back();
            continue;
        }
        if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
        } else if (c == quote) {
            quote = 0;
        }
        words.back() += c;
    }
    if (words.back().empty()) words.pop_back();
    // an option and its value stay on one line
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        if (!words[i].starts_with("-") || words[i + 1].starts_with("-")) continue;
        words[i] += ' ' + words[i + 1];
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    return words;
}

/// The words in lines of at most `width` letters, the first one after `before`, the others after `indent`
/// blanks; `end` closes every line but the last.
std::string filled(const std::vector<std::string>& words, const std::string& before, std::size_t indent,
                   const std::string& end = "") {
    std::string text, line = before;
    bool fresh = true;
    for (const std::string& word : words) {
        const std::size_t blank = fresh ? 0 : 1;
        if (!fresh && letters(line) + blank + letters(word) + end.size() > help_columns) {
            text += line + end + '\n';
            line = std::string(indent, ' ');
            fresh = true;
        }
        if (!fresh) line += ' ';
        line += word;
        fresh = false;
    }
    return text + line + '\n';
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (const std::string_view word : spectral::words(text)) words.emplace_back(word);
    return words;
}

/// "  name   what": where `what` begins; 0 for a line without such a gap.
std::size_t column_of_gap(const std::string& line, std::size_t indent) {
    const auto gap = line.find("  ", indent);
    if (gap == std::string::npos) return 0;
    return letters(std::string_view{line}.substr(0, std::min(line.find_first_not_of(' ', gap), line.size())));
}

std::string wrapped_line(const std::string& line) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    if (line.compare(indent, 4, "hts ") == 0 || line.compare(indent, 7, "mpirun ") == 0 ||
        line.compare(indent, 7, "sbatch ") == 0)
        return filled(shell_words(line), std::string(indent, ' '), indent + 4, " \\");
    if (const std::size_t column = column_of_gap(line, indent); column > 0 && column < help_columns / 2) {
        std::size_t bytes = 0;
        while (letters(std::string_view{line}.substr(0, bytes)) < column) ++bytes;
        return filled(words_of(std::string_view{line}.substr(bytes)), line.substr(0, bytes), column);
    }
    return filled(words_of(line), std::string(indent, ' '), indent + 4);
}

/// Lines, those of a command that goes on after a \ as one.
std::vector<std::string> whole_commands(const std::string& text) {
    std::vector<std::string> lines;
    bool goes_on = false;
    for (const std::string_view piece : spectral::split(text, '\n')) {
        if (goes_on) {
            lines.back() += spectral::trimmed(piece);
        } else {
            lines.emplace_back(piece);
        }
        goes_on = lines.back().ends_with(" \\");
        if (goes_on) lines.back().pop_back();
    }
    return lines;
}

/// Lines of a paragraph, which are filled anew if one of them is too long.
std::string wrapped_paragraph(const std::vector<std::string>& lines) {
    std::string text;
    const auto fits = [](const std::string& line) { return letters(line) <= help_columns; };
    if (std::ranges::all_of(lines, fits)) {
        for (const std::string& line : lines) text += line + '\n';
        return text;
    }
    for (const std::string& line : lines) text += line + ' ';
    return filled(words_of(text), "", 0);
}

/// Names of an option, its value and its description in two columns.
std::string two_columns(const std::string& left, const std::string& right) {
    const std::vector<std::string> words = words_of(right);
    std::string before = "  " + left;
    if (words.empty()) return before + '\n';
    if (letters(before) + 2 <= text_column)
        return filled(words, before + std::string(text_column - letters(before), ' '), text_column);
    return before + '\n' + filled(words, std::string(text_column, ' '), text_column);
}

/// Words that stand for a value.
std::string value_word(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    if (option.get_type_size() == 0 || type.empty()) return "";
    if (type.starts_with("TEXT")) return " TEXT";
    return type.find("FLOAT") != std::string::npos ? " NUMBER" : " COUNT";
}

}  // namespace

std::string wrapped_help(const std::string& text) {
    std::string result;
    std::vector<std::string> paragraph;
    const auto close = [&] {
        result += wrapped_paragraph(paragraph);
        paragraph.clear();
    };
    for (const std::string& line : whole_commands(text)) {
        if (!line.empty() && line.front() != ' ') {
            paragraph.push_back(line);
            continue;
        }
        close();
        result += letters(line) <= help_columns ? line + '\n' : wrapped_line(line);
    }
    close();
    result.pop_back();
    return result;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
    std::string name = option->get_name(true, false);
    if (!is_positional) {
        name.clear();
        if (!option->get_snames().empty()) name = "-" + option->get_snames().front();
        if (!option->get_lnames().empty())
            name += (name.empty() ? "--" : ", --") + option->get_lnames().front();
    }
    if (!is_positional && option->get_positional())
        return two_columns(name + value_word(*option), "as the argument");
    std::string text = option->get_description();
    if (const auto& names = choices_of(option); !names.empty() && names.size() < 16)
        text += ": " + spectral::joined(names);
    if (option->get_required()) text += " (required)";
    if (!option->get_default_str().empty()) text += " [" + option->get_default_str() + "]";
    return two_columns(name + (is_positional ? "" : value_word(*option)), text);
}

std::string HelpFormatter::make_subcommand(const CLI::App* verb) const {
    return two_columns(verb->get_name(), verb->get_description());
}

std::string HelpFormatter::make_usage(const CLI::App* verb, std::string name) const {
    const std::string usage = Formatter::make_usage(verb, std::move(name));
    return filled(words_of(usage), "", 4);
}

std::string HelpFormatter::make_description(const CLI::App* verb) const {
    return filled(words_of(verb->get_description()), "", 0);
}

std::string HelpFormatter::make_footer(const CLI::App* verb) const {
    std::string text = verb->get_footer();
    if (text.starts_with('\n')) text.erase(0, 1);  // make_help has one in front
    return text.empty() ? text : wrapped_help(text) + "\n";
}

}  // namespace hts::cli
