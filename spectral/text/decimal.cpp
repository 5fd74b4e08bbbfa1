#include "spectral/text/decimal.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace hts::spectral {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr int significant = 17, least_power = -292, most_power = 325;
constexpr std::uint64_t ten_to_8 = 100'000'000, ten_to_16 = ten_to_8 * ten_to_8, ten_to_17 = 10 * ten_to_16;

/// bits 2^exponent, the highest of 128 bits set, of a power of ten; below it by less than `most_missing`
/// units of the last bit, at most two for each step from 1.
struct Power {
    Wide bits;
    int exponent;
};
constexpr int most_missing = 1024;
static_assert(-2 * least_power < most_missing && 2 * most_power < most_missing);

/// Of a value of more than 64 bits.
int leading_zeros(Wide value) {
    return std::countl_zero(static_cast<std::uint64_t>(value >> 64));
}

Power times_10(const Power& p) {
    // p 10 / 16, in two parts, since p 10 may have 132 bits
    const Wide low = (p.bits & 15) * 10, product = (p.bits >> 4) * 10 + (low >> 4);
    if (const int shift = leading_zeros(product); shift > 0) {
        return {(product << shift) | ((low & 15) >> (4 - shift)), p.exponent + 4 - shift};
    }
    return {product, p.exponent + 4};
}

Power over_10(const Power& p) {
    const Wide quotient = p.bits / 10, rest = p.bits % 10;
    const int shift = leading_zeros(quotient);
    return {(quotient << shift) + (rest << shift) / 10, p.exponent - shift};
}

class Powers {
  public:
    Powers() {
        Power p{Wide{1} << 127, -127};
        for (int q = 0; q <= most_power; ++q, p = times_10(p)) at(q) = p;
        p = at(0);
        for (int q = -1; q >= least_power; --q) at(q) = p = over_10(p);
    }
    [[nodiscard]] const Power& operator[](int q) const {
        return powers_[static_cast<std::size_t>(q - least_power)];
    }

  private:
    Power& at(int q) { return powers_[static_cast<std::size_t>(q - least_power)]; }
    std::array<Power, most_power - least_power + 1> powers_{};
};

/// value 10^q, 54 to 58 bits before the point.
struct Scaled {
    std::uint64_t whole;
    Wide fraction, half;  ///< a half in units of the fraction
};

/// The product of mantissa 2^exponent, its highest bit set, with a power of ten.
Scaled scaled(std::uint64_t mantissa, int exponent, const Power& power) {
    const Wide low = Wide{mantissa} * static_cast<std::uint64_t>(power.bits);
    const Wide high = Wide{mantissa} * static_cast<std::uint64_t>(power.bits >> 64) + (low >> 64);
    const int behind = -(exponent + power.exponent) - 64;  // bits of `high` behind the point
    return {static_cast<std::uint64_t>(high >> behind), high & ((Wide{1} << behind) - 1),
            Wide{1} << (behind - 1)};
}

void append_by_library(std::string& text, double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::general, significant);
    text.append(buffer.data(), end.ptr);
}

constexpr auto two_digits = [] {
    std::array<char, 200> text{};
    for (std::size_t i = 0; i < 100; ++i) {
        text[2 * i] = static_cast<char>('0' + i / 10);
        text[2 * i + 1] = static_cast<char>('0' + i % 10);
    }
    return text;
}();

void write_8(char* to, std::uint64_t value) {
    auto rest = static_cast<std::uint32_t>(value);
    for (int i = 6; i >= 0; i -= 2, rest /= 100)
        std::memcpy(to + i, &two_digits[std::size_t{2} * (rest % 100)], 2);
}

/// In the form of "%g": 0.00012, 12.5, 1.25e+20.
void append_general(std::string& text, bool negative, std::uint64_t number, int exponent) {
    std::array<char, significant> digit{};
    digit[0] = static_cast<char>('0' + number / ten_to_16);
    write_8(&digit[1], number % ten_to_16 / ten_to_8);
    write_8(&digit[9], number % ten_to_8);
    int count = significant;
    while (digit[static_cast<std::size_t>(count) - 1] == '0') --count;
    std::array<char, 32> buffer{};
    char* to = buffer.data();
    const auto put = [&to](const char* from, int length) {
        std::memcpy(to, from, static_cast<std::size_t>(length));
        to += length;
    };
    if (negative) *to++ = '-';
    if (exponent < -4 || exponent >= significant) {
        *to++ = digit[0];
        if (count > 1) *to++ = '.';
        put(digit.data() + 1, count - 1);
        *to++ = 'e';
        *to++ = exponent < 0 ? '-' : '+';
        const int size = exponent < 0 ? -exponent : exponent;
        if (size >= 100) *to++ = static_cast<char>('0' + size / 100);
        put(&two_digits[static_cast<std::size_t>(2 * (size % 100))], 2);
    } else if (exponent < 0) {
        put("0.000", 1 - exponent);
        put(digit.data(), count);
    } else {
        const int before = exponent + 1;
        put(digit.data(), before);  // zeros at the end are still there
        if (count > before) {
            *to++ = '.';
            put(&digit[static_cast<std::size_t>(before)], count - before);
        }
    }
    text.append(buffer.data(), to);
}

}  // namespace

void append_17_digits(std::string& text, double value) {
    static const Powers powers;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int biased = static_cast<int>(bits >> 52 & 0x7FF);
    if (biased == 0 || biased == 0x7FF) return append_by_library(text, value);
    const std::uint64_t mantissa = (bits | std::uint64_t{1} << 52) << 11;
    const int exponent = biased - 1023 - 63;
    // floor(log10 2^e), which is that of the value or one less
    int decimal = static_cast<int>((std::int64_t{biased - 1023} * 1'292'913'986) >> 32);
    Scaled number = scaled(mantissa, exponent, powers[significant - 1 - decimal]);
    if (number.whole >= ten_to_17) number = scaled(mantissa, exponent, powers[significant - 1 - ++decimal]);
    const Wide off =
        number.fraction > number.half ? number.fraction - number.half : number.half - number.fraction;
    if (off <= 2 * Wide{most_missing})
        return append_by_library(text, value);  // too near a half to tell which way
    std::uint64_t rounded = number.whole + (number.fraction > number.half ? 1 : 0);
    if (rounded == ten_to_17) {
        rounded = ten_to_16;
        ++decimal;
    }
    append_general(text, (bits >> 63) != 0, rounded, decimal);
}

}  // namespace hts::spectral
