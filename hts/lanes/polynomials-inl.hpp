// Polynomials and 2^x in lanes; included once per instruction set.
#if defined(HTS_POLYNOMIALS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_POLYNOMIALS_INL
#undef HTS_POLYNOMIALS_INL
#else
#define HTS_POLYNOMIALS_INL
#endif

#include <array>
#include <bit>
#include <cstddef>

#include "hts/lanes/lanes-inl.hpp"
#include "hts/phi/tables/exp2.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::lanes::HWY_NAMESPACE {

/// Horner's rule on `packs` vectors at once, as chains of even and of odd powers; `row(i, k)` loads
/// coefficient i of vector k.
template <int rows, std::size_t packs, class Pack, class Row>
HWY_INLINE void polynomials(Pack (&sum)[packs], Pack x, Pack x2, Row row) {
    Pack odd[packs];
    HTS_UNROLL
    for (std::size_t k = 0; k < packs; ++k) {
        sum[k] = row(rows - 1, k);
        odd[k] = row(rows - 2, k);
    }
    HTS_UNROLL
    for (int i = rows - 3; i >= 0; i -= 2) {
        HTS_UNROLL
        for (std::size_t k = 0; k < packs; ++k) {
            sum[k] = hn::MulAdd(sum[k], x2, row(i, k));
            if (i > 0) odd[k] = hn::MulAdd(odd[k], x2, row(i - 1, k));
        }
    }
    HTS_UNROLL
    for (std::size_t k = 0; k < packs; ++k) {
        sum[k] = rows % 2 != 0 ? hn::MulAdd(odd[k], x, sum[k]) : hn::MulAdd(sum[k], x, odd[k]);
    }
}

/// Sum of coefficients[i] x^i by two Horner chains, of the even and of the odd powers.
template <class Lanes, class V, class Coefficient, std::size_t size>
HWY_INLINE V polynomial(const Lanes& o, const std::array<Coefficient, size>& coefficients, V x) {
    static_assert(size >= 2);
    const V x2 = x * x;
    V last = o.real(coefficients[size - 1]);
    V other = o.real(coefficients[size - 2]);
    HTS_UNROLL
    for (std::size_t i = size - 2; i > 1; i -= 2) {
        last = o.mul_add(last, x2, o.real(coefficients[i - 1]));
        other = o.mul_add(other, x2, o.real(coefficients[i - 2]));
    }
    if constexpr (size % 2 == 0) return o.mul_add(last, x, other);
    return o.mul_add(other, x, o.mul_add(last, x2, o.real(coefficients[0])));
}

/// Terms first ... first + count - 1 over x^first, by Estrin's rule: more to compute than
/// Horner's, in fewer steps.
///   powers   x, x^2, x^4, x^8
template <std::size_t first, std::size_t count, class Lanes, class V, class Coefficient, std::size_t size>
HWY_INLINE V estrin(const Lanes& o, const std::array<Coefficient, size>& coefficients, const V (&powers)[4]) {
    if constexpr (count == 1) {
        return o.real(coefficients[first]);
    } else {
        constexpr std::size_t half = std::bit_floor(count - 1);
        return o.mul_add(estrin<first + half, count - half>(o, coefficients, powers),
                         powers[std::countr_zero(half)], estrin<first, half>(o, coefficients, powers));
    }
}

/// 2^e, quickly for one at a time.
///   degree   3, 5 or 10: relative error below 1e-4, 1e-7, 3e-16      e   exponents of normal numbers
template <int degree, class Lanes>
HWY_INLINE typename Lanes::Real exp2(const Lanes& o, typename Lanes::Real e) {
    using F = Format<typename Lanes::Number>;
    constexpr double round = F::round + F::bias;  // added, it leaves the biased exponent in the last bits
    const auto shifted = o.add(e, o.real(round));
    const auto f = o.sub(e, o.sub(shifted, o.real(round)));
    const auto f2 = o.mul(f, f);
    const auto f4 = o.mul(f2, f2);
    const typename Lanes::Real powers[] = {f, f2, f4, o.mul(f4, f4)};
    const auto power = o.from_bits(o.template shift_left<F::mantissa>(o.bits(shifted)));
    return o.mul(estrin<0, degree + 1>(o, exp2_coefficients<degree>, powers), power);
}

/// factor 2^e; 0 where that underflows.
///   degree   3, 5 or 10: relative error below 1e-4, 1e-7, 3e-16      e   any that does not overflow
template <int degree, class Lanes>
HWY_INLINE typename Lanes::Real scaled_exp2(const Lanes& o, typename Lanes::Real e,
                                            typename Lanes::Real factor) {
    using Real = typename Lanes::Real;
    using F = Format<typename Lanes::Number>;
    const Real bounded = o.max(e, o.real(F::least_exponent));
    const Real n = o.sub(o.add(bounded, o.real(F::round)), o.real(F::round));
    const Real f = o.sub(bounded, n);
    const Real p = polynomial(o, exp2_coefficients<degree>, f);
    // 2^n in two factors, since n may lie below the exponents of normal numbers
    const auto power = [&o](Real k) HWY_ATTR {
        return o.from_bits(o.template shift_left<F::mantissa>(o.bits(o.add(k, o.real(F::round + F::bias)))));
    };
    const Real low = o.real(F::half_exponent);
    const Real n1 = o.max(n, low);
    return o.mul(o.mul(p, o.mul(power(n1), factor)), power(o.max(o.sub(n, n1), low)));
}

}  // namespace hts::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
