// What the standard library of emscripten 3.1.6 (libc++ 14, which says 13) lacks of C++20 and the engine
// uses: read before every source of the engine.
#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

namespace std {

template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>)
    [[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

/// In `digits` significant ones, as printf's %g writes them.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format /*general*/, int digits) {
    char text[64];
    const int length = snprintf(text, sizeof text, "%.*g", digits, value);
    if (length > last - first) return {last, errc::value_too_large};
    memcpy(first, text, static_cast<size_t>(length));
    return {first + length, errc{}};
}

/// The fewest digits of which `read` makes the same number again, without an exponent where that is no longer.
template <class Number, class Read>
to_chars_result fewest_digits(char* first, char* last, Number value, int most, Read read) {
    char text[64], plain[400];
    const double wide = value;
    int digits = 1;
    for (; digits <= most; ++digits) {
        snprintf(text, sizeof text, "%.*e", digits - 1, wide);
        if (digits == most || read(text) == value) break;
    }
    const char* exponent = strchr(text, 'e');
    const int decimals = exponent == nullptr ? 0 : digits - 1 - atoi(exponent + 1);
    snprintf(plain, sizeof plain, "%.*f", decimals > 0 ? decimals : 0, wide);
    const char* chosen = strlen(plain) <= strlen(text) && read(plain) == value ? plain : text;
    const size_t length = strlen(chosen);
    if (length > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
    memcpy(first, chosen, length);
    return {first + length, errc{}};
}
inline to_chars_result to_chars(char* first, char* last, double value) {
    return fewest_digits(first, last, value, 17, [](const char* text) { return strtod(text, nullptr); });
}
inline to_chars_result to_chars(char* first, char* last, float value) {
    return fewest_digits(first, last, value, 9, [](const char* text) { return strtof(text, nullptr); });
}

/// A number without sign + and without spaces before it.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const string text{first, last};
    if (text.empty() || text[0] == '+' || isspace(static_cast<unsigned char>(text[0])) ||
        text.find_first_of("xX") != string::npos)
        return {first, errc::invalid_argument};
    char* end = nullptr;
    const double read = strtod(text.c_str(), &end);
    if (end == text.c_str()) return {first, errc::invalid_argument};
    const char* stop = first + (end - text.c_str());
    if (read == HUGE_VAL || read == -HUGE_VAL) return {stop, errc::result_out_of_range};
    value = read;
    return {stop, errc{}};
}

// Algorithms on whole ranges, as far as they are used; the two that take a projection name it.
namespace ranges {

#define HTS_ON_A_RANGE(name)                                           \
    template <class Range, class... Rest>                              \
    constexpr auto name(Range&& range, Rest... rest) {                 \
        return std::name(std::begin(range), std::end(range), rest...); \
    }
HTS_ON_A_RANGE(adjacent_find)
HTS_ON_A_RANGE(all_of)
HTS_ON_A_RANGE(any_of)
HTS_ON_A_RANGE(copy)
HTS_ON_A_RANGE(count_if)
HTS_ON_A_RANGE(find)
HTS_ON_A_RANGE(find_if)
HTS_ON_A_RANGE(for_each)
HTS_ON_A_RANGE(lower_bound)
HTS_ON_A_RANGE(max_element)
HTS_ON_A_RANGE(min_element)
HTS_ON_A_RANGE(none_of)
HTS_ON_A_RANGE(replace_if)
HTS_ON_A_RANGE(sort)
#undef HTS_ON_A_RANGE

template <class Range, class Value>
constexpr void fill(Range&& range, const Value& value) {
    std::fill(std::begin(range), std::end(range), value);
}
template <class A, class To, class F>
constexpr void transform(const A& a, To to, F f) {
    std::transform(std::begin(a), std::end(a), to, f);
}
template <class A, class B, class To, class F>
constexpr void transform(const A& a, const B& b, To to, F f) {
    std::transform(std::begin(a), std::end(a), std::begin(b), to, f);
}
template <class A, class B>
constexpr bool equal(const A& a, const B& b) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b));
}
template <class A, class B, class Same>
constexpr bool equal(const A& a, const B& b, Same same) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), same);
}
template <class A, class B, class Of, class With>
constexpr bool equal(const A& a, const B& b, std::equal_to<> /*same*/, Of of, With with) {
    return std::equal(
        std::begin(a), std::end(a), std::begin(b), std::end(b),
        [&](const auto& x, const auto& y) { return std::invoke(of, x) == std::invoke(with, y); });
}
template <class Range, class Value>
constexpr auto upper_bound(Range&& range, const Value& value) {
    return std::upper_bound(std::begin(range), std::end(range), value);
}

}  // namespace ranges
}  // namespace std
