#include "spectral/text/decimal.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "hts/sampling/random.hpp"

namespace {

std::string by_c_library(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string ours(double value) {
    std::string text;
    hts::spectral::append_17_digits(text, value);
    return text;
}

/// Every exponent, short and long mantissas, both signs, and what is near a power of ten or a half of the
/// last digit.
std::vector<double> values() {
    std::vector<double> all{0.0, -0.0, 1e-4, 9.9999999999999e-5,  0.1,
                            1.0, 1e16, 1e17, 99999999999999999.0, 0.5};
    hts::Random random{3};
    for (int exponent = 0; exponent < 2047; ++exponent) {
        for (int i = 0; i < 100; ++i) {
            const std::uint64_t mantissa = random.bits() >> (12 + i % 4 * 13);
            const std::uint64_t sign = static_cast<std::uint64_t>(i & 1) << 63;
            all.push_back(
                std::bit_cast<double>(sign | (static_cast<std::uint64_t>(exponent) << 52) | mantissa));
        }
    }
    for (int power = -323; power <= 308; ++power) {
        const double ten = std::strtod(("1e" + std::to_string(power)).c_str(), nullptr);
        for (double near :
             {ten, std::nextafter(ten, 0.0), std::nextafter(ten, std::numeric_limits<double>::infinity())})
            all.push_back(near);
    }
    // 18 digits, the last one 5: halfway between two numbers of 17
    for (int i = 1; i < 2000; i += 2) all.push_back(0x1p53 + 2 * i + static_cast<double>(i) / 0x1p10);
    for (int i = 1; i < 4000; i += 2) all.push_back(static_cast<double>(i) * 0x1p-18 + 10);
    all.push_back(std::numeric_limits<double>::infinity());
    all.push_back(-std::numeric_limits<double>::infinity());
    all.push_back(std::numeric_limits<double>::denorm_min());
    all.push_back(std::numeric_limits<double>::max());
    return all;
}

}  // namespace

TEST_CASE("numbers of 17 digits are those of the C library, and read back the same") {
    std::size_t different = 0;
    for (const double value : values()) {
        const std::string text = ours(value);
        if (text == by_c_library(value) && std::strtod(text.c_str(), nullptr) == value) continue;
        if (++different <= 5) UNSCOPED_INFO(text << " instead of " << by_c_library(value));
    }
    CHECK(different == 0);
}
