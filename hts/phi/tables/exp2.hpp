// Polynomials of 2^f on [-1/2, 1/2], by power. Written by generate_phi_tables; do not edit.
// clang-format off
#pragma once

#include <array>

namespace hts::lanes {

template <int degree>
inline constexpr std::array<double, degree + 1> exp2_coefficients{};
template <>
inline constexpr std::array<double, 4> exp2_coefficients<3>{
    1,
    0x1.62e2d1675f711p-1,
    0x1.f0ecf78898eebp-3,
    0x1.c96d5de3cd482p-5};
template <>
inline constexpr std::array<double, 6> exp2_coefficients<5>{
    1,
    0x1.62e4302fc626ep-1,
    0x1.ebf906e26e833p-3,
    0x1.c6af6cdbbdcc7p-5,
    0x1.3d10705276a1dp-7,
    0x1.5f0890162a90ap-10};
template <>
inline constexpr std::array<double, 11> exp2_coefficients<10>{
    1,
    0x1.62e42fefa3a19p-1,
    0x1.ebfbdff82c598p-3,
    0x1.c6b08d703ce49p-5,
    0x1.3b2ab6fba1ddap-7,
    0x1.5d87fe9d7a584p-10,
    0x1.430913096fd9fp-13,
    0x1.ffcb54062e698p-17,
    0x1.62bfd47773353p-20,
    0x1.b675bca4eeebbp-24,
    0x1.e6063f7217bc6p-28};

}  // namespace hts::lanes
