// Directions from degrees, compiled for every instruction set and chosen at run time.
#include "hts/angles/degrees_simd.hpp"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/angles/degrees_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::angles_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_NATIVE_FMA

constexpr hn::CappedTag<double, 8> d{};
using Real = hn::Vec<decltype(d)>;
using Mask = hn::Mask<decltype(d)>;

HWY_INLINE Real real(double value) {
    return hn::Set(d, value);
}

/// A value as the sum of two doubles, to within 2^-63 of the table and 2^-65 of the series, relative.
struct Sum {
    Real high, rest;
};

/// The double nearest to a sum, and whether it is nearest to all values within 1.75 * 2^-62 of it: then the
/// values in long double, of which Boost's is within 2^-62 of the exact one, round to it too.
struct Rounded {
    Real value;
    Mask certain;
};
HWY_INLINE Rounded rounded(const Sum& sum) {
    const Real error = hn::Mul(hn::Abs(sum.high), real(1.75 * 0x1p-62));
    const Real low = hn::Add(sum.high, hn::Sub(sum.rest, error));
    return {low, hn::Eq(low, hn::Add(sum.high, hn::Add(sum.rest, error)))};
}

struct SineCosine {
    Rounded sine, cosine;
};

/// sin(pi q) and cos(pi q).
///   q   0 ... 1/4
HWY_INLINE SineCosine octant_turn(const OctantTable& octant, Real q) {
    constexpr double pi = 0x1.921fb54442d18p+1, pi_rest = 0x1.1a62633145c07p-53;
    const Real place = hn::Floor(hn::MulAdd(q, real(256), real(0.5)));
    const Real from = hn::NegMulAdd(place, real(1.0 / 256), q);  // exact, |from| <= 1/512
    static_assert(OctantTable::columns == 4);
    const auto row = hn::ShiftLeft<2>(hn::ConvertTo(hn::RebindToSigned<decltype(d)>{}, place));
    const auto column = [&](OctantTable::Column of) {
        return hn::GatherIndex(d, octant.values.data() + of, row);
    };
    const Real sine = column(OctantTable::sine), sine_rest = column(OctantTable::sine_rest);
    const Real cosine = column(OctantTable::cosine), cosine_rest = column(OctantTable::cosine_rest);

    // a + a_rest = pi from; sin a = a + sin_rest, cos a = 1 + cos_1
    const Real a = hn::Mul(from, real(pi));
    const Real a_rest = hn::MulAdd(from, real(pi_rest), hn::MulSub(from, real(pi), a));
    const Real s = hn::MulAdd(hn::Add(a, a), a_rest, hn::Mul(a, a));
    const Real sixth = hn::NegMulAdd(s, hn::NegMulAdd(s, real(1.0 / 5040), real(1.0 / 120)), real(1.0 / 6));
    const Real half = hn::NegMulAdd(s, hn::NegMulAdd(s, real(1.0 / 720), real(1.0 / 24)), real(0.5));
    const Real sin_rest = hn::NegMulAdd(hn::Mul(a, s), sixth, a_rest);
    const Real cos_1 = hn::Neg(hn::Mul(s, half));

    const auto turned = [&](Real table, Real table_rest, Real other, Real other_rest) {
        const Real product = hn::Mul(other, a), high = hn::Add(table, product);
        Real rest = hn::Sub(product, hn::Sub(high, table));  // of the addition
        rest = hn::Add(rest, hn::MulSub(other, a, product));
        rest = hn::Add(rest, hn::MulAdd(other_rest, a, table_rest));
        rest = hn::Add(rest, hn::MulAdd(table, cos_1, hn::Mul(other, sin_rest)));
        return rounded({high, rest});
    };
    return {turned(sine, sine_rest, cosine, cosine_rest),
            turned(cosine, cosine_rest, hn::Neg(sine), hn::Neg(sine_rest))};
}

HWY_INLINE Real select(Mask which, Real yes, Real no) {
    return hn::IfThenElse(which, yes, no);
}

HWY_ATTR std::uint64_t turn_all(const OctantTable& octant, DirectionColumns& columns) {
    std::uint64_t left = 0;
    for (std::size_t i = 0; i < DirectionColumns::size; i += hn::Lanes(d)) {
        Real theta = hn::Load(d, columns.theta.data() + i), phi = hn::Load(d, columns.phi.data() + i);
        Mask certain = hn::And(hn::And(hn::Ge(theta, real(0)), hn::Le(theta, real(90))),
                               hn::Lt(hn::Abs(phi), real(540)));
        certain = hn::And(certain, hn::Ne(hn::Abs(phi), real(360)));  // whose sine is a zero of its sign
        theta = hn::IfThenElseZero(certain, theta);
        phi = hn::IfThenElseZero(certain, phi);
        // where the products of a tiny angle are exact no longer
        const auto large_enough = [](Real angle) {
            const Real size = hn::Abs(angle);
            return hn::Or(hn::Ge(size, real(1e-200)), hn::Eq(size, real(0)));
        };

        // near the horizon the cosine is the sine of the elevation, whose subtraction is exact
        const Mask low = hn::Lt(theta, real(45));
        const Real turn = hn::Div(theta, real(180));
        const Real elevation = hn::Div(hn::Sub(real(90), theta), real(180));
        const SineCosine polar = octant_turn(octant, select(low, turn, elevation));
        const SineCosine beside = octant_turn(octant, select(low, turn, hn::Sub(real(0.5), turn)));
        hn::Store(hn::CopySign(select(low, polar.sine.value, beside.cosine.value), turn), d,
                  columns.sin_theta.data() + i);
        hn::Store(select(low, polar.cosine.value, polar.sine.value), d, columns.cos_theta.data() + i);
        certain = hn::And(certain, hn::And(polar.sine.certain, beside.cosine.certain));
        certain = hn::And(certain, hn::Or(polar.cosine.certain, hn::Not(low)));
        certain = hn::And(certain, large_enough(theta));

        const Real wrapped =
            select(hn::Gt(hn::Abs(phi), real(180)), hn::Sub(phi, hn::CopySign(real(360), phi)), phi);
        const Real x = hn::Div(wrapped, real(180)), size = hn::Abs(x);
        const Mask forward = hn::Le(size, real(0.5));
        const Real r = select(forward, size, hn::Sub(real(1), size));
        const Mask small = hn::Le(r, real(0.25));
        const SineCosine azimuth = octant_turn(octant, select(small, r, hn::Sub(real(0.5), r)));
        const Real sine = select(small, azimuth.sine.value, azimuth.cosine.value);
        const Real cosine = select(small, azimuth.cosine.value, azimuth.sine.value);
        hn::Store(hn::CopySign(sine, select(hn::Lt(size, real(1)), x, hn::Neg(x))), d,
                  columns.sin_phi.data() + i);
        hn::Store(select(forward, cosine, hn::Neg(cosine)), d, columns.cos_phi.data() + i);
        certain = hn::And(certain, hn::And(azimuth.sine.certain, azimuth.cosine.certain));
        certain = hn::And(certain, large_enough(phi));

        std::array<std::uint8_t, 8> bits{};
        hn::StoreMaskBits(d, hn::Not(certain), bits.data());
        left |= std::uint64_t{bits[0]} << i;  // at most 8 lanes
    }
    return left;
}

#else  // without fused multiply-adds products have no exact rest

HWY_ATTR std::uint64_t turn_all(const OctantTable&, DirectionColumns&) {
    return ~std::uint64_t{0};
}

#endif

}  // namespace hts::angles_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::angles_detail {

HWY_EXPORT(turn_all);

std::uint64_t turn(const OctantTable& octant, DirectionColumns& columns) noexcept {
    return HWY_DYNAMIC_DISPATCH(turn_all)(octant, columns);
}

}  // namespace hts::angles_detail
#endif
