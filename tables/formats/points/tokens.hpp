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

/// Words stand between white space and commas; `{` and `}` are words of their own; what follows a `#` on its line is a comment.
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
    /// Takes a whole number 1 ... most; hts::Error otherwise.
    std::size_t take_count(const char* quantity, std::size_t most);
    /// Takes so many numbers.
    std::vector<double> take_numbers(const char* quantity, std::size_t count);
    /// Takes a word that must be this one; hts::Error otherwise.
    void take_word(std::string_view expected);

    /// hts::Error "path:line: message".
    [[nodiscard]] Error error(std::string_view message) const;

  private:
    void advance();

    std::string_view rest_, word_;
    std::string name_;
    std::size_t line_;
};

/// Appends a number with so many significant digits.
void append_rounded(std::string& text, double value, int digits = 6);

}  // namespace hts::tables
