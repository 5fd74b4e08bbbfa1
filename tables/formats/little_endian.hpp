/// Numbers as little-endian bytes, whatever the host. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hts::tables {

/// Written with the host's numbers, tells which order they had.
inline constexpr std::uint32_t byte_order = 0x01020304, other_byte_order = 0x04030201;

template <class Number>
void append_little_endian(std::string& bytes, Number number) {
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

/// The number that the first bytes hold; there must be enough.
template <class Number>
[[nodiscard]] Number from_little_endian(std::string_view bytes) {
    std::array<char, sizeof(Number)> raw;
    std::copy_n(bytes.begin(), raw.size(), raw.begin());
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
}

/// Doubles, rounded to Real.
template <class Real>
void append_numbers(std::string& bytes, std::span<const double> values) {
    for (const double value : values) append_little_endian(bytes, static_cast<Real>(value));
}

}  // namespace hts::tables
