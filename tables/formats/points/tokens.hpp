/// A text of words and numbers taken one by one, with errors that name its line. Not installed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hts/error.hpp"

namespace hts::tables {

/// Numbers in files must be no larger, so that what is interpolated between them is finite.
inline constexpr double largest_number = 1e100;

/// Negative values, which measurements have and a BRDF has not: counted, so that nobody is left to guess.
struct NegativeValues {
    std::size_t count = 0, first_line = 0;
    double least = 0;

    void note(double value, std::size_t line) noexcept;
    /// "2 values are negative, the first on line 5, the least -0.01 1/sr: taken as 0".
    [[nodiscard]] std::string text() const;
};

/// Words stand between white space and commas; `{` and `}` are words of their own; what follows a `#`
/// on its line is a comment.
class Tokens {
  public:
    ///   text   must outlive this      name   of the file      line   where the text begins in it
    Tokens(std::string_view text, std::string name, std::size_t line = 1);

    [[nodiscard]] bool at_end() const noexcept { return word_.empty(); }
    /// The next word, "" at the end; `take` removes it.
    [[nodiscard]] std::string_view next() const noexcept { return word_; }
    std::string_view take();
    /// Takes a number of at most largest_number either way; hts::Error otherwise.
    double take_number(const char* quantity);
    /// The same of a value that is taken for 0 where it is negative, and counted.
    double take_value(const char* quantity);
    /// Those that were.
    [[nodiscard]] const NegativeValues& negative() const noexcept { return negative_; }
    /// Takes a whole number 1 ... most; hts::Error otherwise.
    std::size_t take_count(const char* quantity, std::size_t most);
    /// Takes so many numbers.
    std::vector<double> take_numbers(const char* quantity, std::size_t count);
    /// Takes a word that must be this one, in letters of any case; hts::Error otherwise.
    void take_word(std::string_view expected);

    /// Where the next word stands.
    [[nodiscard]] std::size_t line() const noexcept { return line_; }
    /// hts::Error "path:line: message".
    [[nodiscard]] Error error(std::string_view message) const;

  private:
    void advance();

    std::string_view rest_, word_;
    std::string name_;
    std::size_t line_;
    NegativeValues negative_;
};

/// Appends a number with so many significant digits.
void append_rounded(std::string& text, double value, int digits = 6);

/// An identifier in 8-4-4-4-12 digits, the same of the same content.
[[nodiscard]] std::string uuid_of(std::string_view content);

}  // namespace hts::tables
