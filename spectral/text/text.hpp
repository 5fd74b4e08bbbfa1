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
/// The same of bytes that were read from there.
[[nodiscard]] std::string checked_text(std::string bytes, const std::filesystem::path& path);

/// hts::Error "path: …" if there is no such file or it is a directory.
void require_file(const std::filesystem::path& path);

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// What bytes are that are no UTF-8: "not UTF-8 text", or UTF-16 by its mark.
[[nodiscard]] std::string no_text(std::string_view bytes);

/// Whether these bytes are UTF-8 without NUL.
[[nodiscard]] bool is_text(std::string_view bytes) noexcept;

/// Without white space at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text) noexcept;

/// Pieces between separators, white space kept; n separators give n + 1 pieces.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// Pieces between runs of white space.
[[nodiscard]] std::vector<std::string_view> words(std::string_view text);

/// "a, b, c".
[[nodiscard]] std::string joined(const std::vector<std::string>& names);

/// Without regard to case, of ASCII letters.
[[nodiscard]] bool same_letters(std::string_view a, std::string_view b) noexcept;

/// "text" with quotation marks around it, on one line: control characters become question marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// For the eye: so many significant digits, without trailing zeros.
[[nodiscard]] std::string brief(double value, int digits = 4);
/// "a, b, c".
[[nodiscard]] std::string brief(const std::vector<double>& values, int digits = 3);

/// The finite number that is the whole text; hts::Error "\"abc\" is not a number" otherwise.
[[nodiscard]] double number_in(std::string_view text);
/// The same with "quantity: " in front of the message.
[[nodiscard]] double number_in(std::string_view text, std::string_view quantity);

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
