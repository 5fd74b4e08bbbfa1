/// Text files, lines, words and numbers, with errors that say where. Not installed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hts/error.hpp"

namespace hts::spectral {

/// A whole file as UTF-8 text without byte order mark. hts::Error "path: …" if it is missing, a directory,
/// unreadable or empty, "path:line: …" if it is not UTF-8.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& path);

/// Without white space at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text) noexcept;

/// Pieces between separators, white space kept; n separators give n + 1 pieces.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// Pieces between runs of white space.
[[nodiscard]] std::vector<std::string_view> words(std::string_view text);

/// "a, b, c".
[[nodiscard]] std::string joined(const std::vector<std::string>& names);

/// "text" with quotation marks around it, on one line: control characters become question marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A text as a gnuplot string literal, taken as it is, on one line.
[[nodiscard]] std::string gnuplot_string(std::string_view text);

/// For the eye: so many significant digits, without trailing zeros.
[[nodiscard]] std::string brief(double value, int digits = 4);
/// "a, b, c".
[[nodiscard]] std::string brief(const std::vector<double>& values, int digits = 3);

/// The finite number that is the whole text; hts::Error "\"abc\" is not a number" otherwise.
[[nodiscard]] double number_in(std::string_view text);

/// The result of `action`; an hts::Error from it gets "where: " in front.
template <class Action>
auto located(const std::string& where, const Action& action) -> decltype(action()) {
    try {
        return action();
    } catch (const Error& error) {
        throw Error{where + ": " + error.what()};
    }
}

}  // namespace hts::spectral
