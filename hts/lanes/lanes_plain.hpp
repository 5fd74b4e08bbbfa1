// One value behind the same names as lanes-inl.hpp's vectors: for calls with one item of code written once
// for both.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__clang__)
#define HTS_UNROLL _Pragma("unroll")
#else
#define HTS_UNROLL _Pragma("GCC unroll 16")
#endif
#define HTS_PLAIN_INLINE [[gnu::always_inline]] static inline

namespace hts::lanes {

/// How a floating-point number is made of bits.
template <class Number>
struct Format;
template <>
struct Format<double> {
    static constexpr int mantissa = 52, bias = 1023;
    static constexpr double round = 0x1.8p52;  // added and taken away, it rounds to integers
    static constexpr double ulp = 0x1p-52;
    static constexpr double least_exponent = -1900, half_exponent = -960;  // of 2^e in two factors
};
template <>
struct Format<float> {
    static constexpr int mantissa = 23, bias = 127;
    static constexpr double round = 0x1.8p23;
    static constexpr double ulp = 0x1p-23;
    static constexpr double least_exponent = -240, half_exponent = -120;
};

/// 2^exponent, a normal number.
constexpr double power_of_2(int exponent) noexcept {
    return std::bit_cast<double>((std::int64_t{1023} + exponent) << 52);
}

/// A double as a vector of one lane. `fused`: multiply-adds round once, as the vectors of the same processor
/// do.
template <bool fused>
struct PlainLanes {
    using Number = double;
    using Real = double;
    using Int = std::int64_t;
    using Flag = bool;  ///< of a branch
    using Mask = Int;   ///< of a select: all bits or none
    using Unsigned = std::uint64_t;

    HTS_PLAIN_INLINE constexpr Real real(double v) noexcept { return v; }
    HTS_PLAIN_INLINE constexpr Int integer(Int v) noexcept { return v; }
    template <class V>
    HTS_PLAIN_INLINE V add(V a, V b) noexcept {
        return a + b;
    }
    template <class V>
    HTS_PLAIN_INLINE V sub(V a, V b) noexcept {
        return a - b;
    }
    HTS_PLAIN_INLINE Real mul(Real a, Real b) noexcept { return a * b; }
    HTS_PLAIN_INLINE Real divide(Real a, Real b) noexcept { return a / b; }
    HTS_PLAIN_INLINE Real sqrt(Real a) noexcept { return std::sqrt(a); }
    /// a b + c
    HTS_PLAIN_INLINE Real mul_add(Real a, Real b, Real c) noexcept {
        if constexpr (fused) return std::fma(a, b, c);
        return a * b + c;
    }
    HTS_PLAIN_INLINE float mul_add(float a, float b, float c) noexcept {
        if constexpr (fused) return std::fma(a, b, c);
        return a * b + c;
    }
    /// c - a b
    HTS_PLAIN_INLINE Real neg_mul_add(Real a, Real b, Real c) noexcept {
        if constexpr (fused) return std::fma(-a, b, c);
        return c - a * b;
    }
    HTS_PLAIN_INLINE Real max(Real a, Real b) noexcept { return a > b ? a : b; }
    HTS_PLAIN_INLINE Real min(Real a, Real b) noexcept { return a < b ? a : b; }

    HTS_PLAIN_INLINE Int bits(Real a) noexcept { return std::bit_cast<Int>(a); }
    HTS_PLAIN_INLINE Real from_bits(Int a) noexcept { return std::bit_cast<Real>(a); }
    HTS_PLAIN_INLINE Int bit_and(Int a, Int b) noexcept { return a & b; }
    HTS_PLAIN_INLINE Int bit_or(Int a, Int b) noexcept { return a | b; }
    HTS_PLAIN_INLINE Int shift_left(Int a, Int n) noexcept {
        return static_cast<Int>(static_cast<Unsigned>(a) << n);
    }
    HTS_PLAIN_INLINE Int shift_right(Int a, Int n) noexcept {
        return static_cast<Int>(static_cast<Unsigned>(a) >> n);
    }
    template <int n>
    HTS_PLAIN_INLINE Int shift_left(Int a) noexcept {
        return shift_left(a, n);
    }
    template <int n>
    HTS_PLAIN_INLINE Int shift_right(Int a) noexcept {
        return shift_right(a, n);
    }
    /// n a
    template <int n>
    HTS_PLAIN_INLINE Int times(Int a) noexcept {
        return n * a;
    }
    HTS_PLAIN_INLINE Int clamp(Int a, Int low, Int high) noexcept {
        const Int raised = a < low ? low : a;
        return raised > high ? high : raised;
    }
    HTS_PLAIN_INLINE Int max0(Int a) noexcept { return a > 0 ? a : 0; }
    HTS_PLAIN_INLINE Int unsigned_min(Int a, Int b) noexcept {
        return static_cast<Unsigned>(a) < static_cast<Unsigned>(b) ? a : b;
    }

    HTS_PLAIN_INLINE Mask mask(bool b) noexcept { return -static_cast<Int>(b); }
    HTS_PLAIN_INLINE Mask greater_equal(Real a, Real b) noexcept { return mask(a >= b); }
    HTS_PLAIN_INLINE Mask less(Real a, Real b) noexcept { return mask(a < b); }
    HTS_PLAIN_INLINE Mask either(Mask a, Mask b) noexcept { return a | b; }
    HTS_PLAIN_INLINE Mask any_bit(Int a, Int b) noexcept { return mask((a & b) != 0); }
    HTS_PLAIN_INLINE Flag not_negative(Int a) noexcept { return a >= 0; }
    /// By bits: a jump here would be mispredicted half of the time.
    HTS_PLAIN_INLINE Int select_integer(Mask m, Int a, Int b) noexcept { return b ^ ((a ^ b) & m); }
    HTS_PLAIN_INLINE Real select(Mask m, Real a, Real b) noexcept {
        return from_bits(select_integer(m, bits(a), bits(b)));
    }
    HTS_PLAIN_INLINE Int gather(const std::int64_t* base, Int i) noexcept { return base[i]; }
};

}  // namespace hts::lanes

#undef HTS_PLAIN_INLINE
