#include "tables/table/crc64.hpp"

#include <array>
#include <cstddef>

namespace hts::tables {
namespace {

constexpr std::uint64_t polynomial = 0xc96c5795d7870f42;
constexpr std::size_t at_once = 8;
using Tables = std::array<std::array<std::uint64_t, 256>, at_once>;

// tables[k][b]: what byte b does to the checksum when k more bytes follow.
constexpr Tables tables = [] {
    Tables made{};
    for (std::uint64_t byte = 0; byte < 256; ++byte) {
        std::uint64_t value = byte;
        for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? polynomial : 0);
        made[0][byte] = value;
    }
    for (std::size_t k = 1; k < at_once; ++k) {
        for (std::size_t byte = 0; byte < 256; ++byte) {
            made[k][byte] = (made[k - 1][byte] >> 8) ^ made[0][made[k - 1][byte] & 0xff];
        }
    }
    return made;
}();

std::uint64_t byte_at(std::string_view text, std::size_t i) {
    return static_cast<unsigned char>(text[i]);
}

}  // namespace

std::uint64_t crc64(std::string_view text, std::uint64_t before) noexcept {
    std::uint64_t value = ~before;
    for (; text.size() >= at_once; text.remove_prefix(at_once)) {
        std::uint64_t next = 0;
        for (std::size_t i = 0; i < at_once; ++i) {
            next ^= tables[at_once - 1 - i][((value >> (8 * i)) ^ byte_at(text, i)) & 0xff];
        }
        value = next;
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
        value = (value >> 8) ^ tables[0][(value ^ byte_at(text, i)) & 0xff];
    }
    return ~value;
}

}  // namespace hts::tables
