#include "tables/formats/points/tokens.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "spectral/text/text.hpp"

namespace hts::tables {
namespace {

constexpr std::string_view between = " \t\r\n\f\v,";
constexpr std::string_view ends_word = " \t\r\n\f\v,{}#";

std::string shown(std::string_view word) {
    return word.empty() ? "the end of the file" : spectral::in_quotes(word.substr(0, 40));
}

}  // namespace

void NegativeValues::note(double value, std::size_t line) noexcept {
    if (count++ == 0) first_line = line;
    least = std::min(least, value);
}

std::string NegativeValues::text() const {
    return std::to_string(count) + (count == 1 ? " value is" : " values are") +
           " negative, the first on line " + std::to_string(first_line) + ", the least " +
           spectral::brief(least) + " 1/sr: taken as 0";
}

Tokens::Tokens(std::string_view text, std::string name, std::size_t line)
    : rest_{text}, name_{std::move(name)}, line_{line} {
    advance();
}

void Tokens::advance() {
    const auto skip = [this](std::size_t count) {
        line_ += static_cast<std::size_t>(
            std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
        rest_.remove_prefix(count);
    };
    for (;;) {
        skip(std::min(rest_.find_first_not_of(between), rest_.size()));
        if (!rest_.starts_with('#')) break;
        skip(std::min(rest_.find('\n'), rest_.size()));
    }
    const bool brace = rest_.starts_with('{') || rest_.starts_with('}');
    word_ = rest_.substr(0, brace ? 1 : rest_.find_first_of(ends_word));
    rest_.remove_prefix(word_.size());
}

std::string_view Tokens::take() {
    const std::string_view word = word_;
    advance();
    return word;
}

double Tokens::take_number(const char* quantity) {
    double value = 0;
    const auto* const end = word_.data() + word_.size();
    const auto [after, failure] =
        std::from_chars(word_.data() + (word_.starts_with('+') ? 1 : 0), end, value);
    if (word_.empty() || failure != std::errc{} || after != end || !(std::abs(value) <= largest_number))
        throw error(
            std::string{quantity}.append(": must be a number of at most 1e100, not ").append(shown(word_)));
    advance();
    return value;
}

double Tokens::take_value(const char* quantity) {
    const std::size_t line = line_;
    const double value = take_number(quantity);
    if (value < 0) negative_.note(value, line);
    return value > 0 ? value : 0;
}

std::size_t Tokens::take_count(const char* quantity, std::size_t most) {
    std::size_t value = 0;
    const auto* const end = word_.data() + word_.size();
    const auto [after, failure] = std::from_chars(word_.data(), end, value);
    if (word_.empty() || failure != std::errc{} || after != end || value < 1 || value > most)
        throw error(std::string{quantity}
                        .append(": must be a whole number from 1 to ")
                        .append(std::to_string(most))
                        .append(", not ")
                        .append(shown(word_)));
    advance();
    return value;
}

std::vector<double> Tokens::take_numbers(const char* quantity, std::size_t count) {
    std::vector<double> numbers;
    while (numbers.size() < count) numbers.push_back(take_number(quantity));
    return numbers;
}

void Tokens::take_word(std::string_view expected) {
    if (!spectral::same_letters(word_, expected))
        throw error(std::string{expected}.append(": must stand here, not ").append(shown(word_)));
    advance();
}

Error Tokens::error(std::string_view message) const {
    return Error{name_ + ":" + std::to_string(line_) + ": " + std::string{message}};
}

void append_rounded(std::string& text, double value, int digits) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::general, digits);
    text.append(buffer.data(), end.ptr);
}

std::string uuid_of(std::string_view content) {
    std::string digits;
    for (std::uint64_t hash : {std::uint64_t{14695981039346656037U}, std::uint64_t{1099511628211U}}) {
        for (const char c : content) {
            hash ^= static_cast<unsigned char>(c);
            hash *= 1099511628211U;
        }
        for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[(hash >> shift) & 15];
    }
    for (const std::size_t at : {8U, 13U, 18U, 23U}) digits.insert(at, 1, '-');
    return digits;
}

}  // namespace hts::tables
