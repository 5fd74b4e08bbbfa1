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

/// The fewest digits that give the same number back.
inline to_chars_result to_chars(char* first, char* last, double value) {
    char text[64];
    for (int digits = 1; digits <= 17; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, nullptr) == value)
            return to_chars(first, last, value, chars_format::general, digits);
    }
    return to_chars(first, last, value, chars_format::general, 17);
}
inline to_chars_result to_chars(char* first, char* last, float value) {
    char text[64];
    for (int digits = 1; digits <= 9; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
        if (strtof(text, nullptr) == value)
            return to_chars(first, last, static_cast<double>(value), chars_format::general, digits);
    }
    return to_chars(first, last, static_cast<double>(value), chars_format::general, 9);
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
HTS_ON_A_RANGE(none_of)
HTS_ON_A_RANGE(replace_if)
HTS_ON_A_RANGE(sort)
#undef HTS_ON_A_RANGE

template <class Range, class Value>
constexpr void fill(Range&& range, const Value& value) {
    std::fill(std::begin(range), std::end(range), value);
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
