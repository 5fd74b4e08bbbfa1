// Polynomials and 2^x in lanes; included once per instruction set.
#if defined(HTS_POLYNOMIALS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_POLYNOMIALS_INL
#undef HTS_POLYNOMIALS_INL
#else
#define HTS_POLYNOMIALS_INL
#endif

#include <cstddef>

#include "hts/lanes-inl.hpp"
#include "hts/phi_tables/exp2.hpp"

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

/// factor 2^e; 0 where that underflows.
///   degree   3, 5 or 10: relative error below 1e-4, 1e-7, 3e-16      e   at most 1000, any sign
template <int degree, class Lanes>
HWY_INLINE typename Lanes::Real scaled_exp2(const Lanes& o, typename Lanes::Real e,
                                            typename Lanes::Real factor) {
    using Real = typename Lanes::Real;
    constexpr auto c = [](int i) { return exp2_coefficients<degree>[static_cast<std::size_t>(i)]; };
    constexpr double round = 0x1.8p52;  // added and taken away, it rounds to integers
    const Real bounded = o.max(e, o.real(-1900.0));
    const Real n = o.sub(o.add(bounded, o.real(round)), o.real(round));
    const Real f = o.sub(bounded, n);
    const Real f2 = o.mul(f, f);
    Real even = o.real(c(degree));
    Real odd = o.real(c(degree - 1));
    HTS_UNROLL
    for (int i = degree - 2; i >= 0; i -= 2) even = o.mul_add(even, f2, o.real(c(i)));
    HTS_UNROLL
    for (int i = degree - 3; i >= 0; i -= 2) odd = o.mul_add(odd, f2, o.real(c(i)));
    const Real p = degree % 2 != 0 ? o.mul_add(even, f, odd) : o.mul_add(odd, f, even);
    // 2^n in two factors, since n may lie below the exponents of normal numbers
    const auto power = [&o](Real k) HWY_ATTR {
        return o.from_bits(o.template shift_left<52>(o.bits(o.add(k, o.real(round + 1023)))));
    };
    const Real low = o.real(-960.0);
    const Real n1 = o.max(n, low);
    return o.mul(o.mul(p, o.mul(power(n1), factor)), power(o.max(o.sub(n, n1), low)));
}

}  // namespace hts::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
