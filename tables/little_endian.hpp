/// Numbers as little-endian bytes, whatever the host. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string>
#include <string_view>

namespace hts::tables {

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

}  // namespace hts::tables
