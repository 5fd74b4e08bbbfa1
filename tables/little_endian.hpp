/// Numbers as little-endian bytes, whatever the host. Private to the module.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace hts::tables {

inline constexpr std::uint32_t byte_order = 0x01020304, other_byte_order = 0x04030201;

/// The unsigned integer with the bits of a float or double.
template <class Real>
using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

template <class Integer>
void append_little(std::string& bytes, Integer value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
}

template <class Integer>
[[nodiscard]] Integer little_at(std::string_view bytes, std::size_t at) {
    Integer value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i) {
        value |=
            static_cast<Integer>(static_cast<Integer>(static_cast<unsigned char>(bytes[at + i])) << (8 * i));
    }
    return value;
}

/// Doubles, rounded to Real.
template <class Real>
void append_numbers(std::string& bytes, std::span<const double> values) {
    for (const double value : values)
        append_little(bytes, std::bit_cast<Bits<Real>>(static_cast<Real>(value)));
}

}  // namespace hts::tables
