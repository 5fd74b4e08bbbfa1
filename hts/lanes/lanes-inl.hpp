// Highway vectors behind a few names, so that a formula is written once for vectors and, by lanes_plain.hpp,
// for one value. Included once per instruction set.
#if defined(HTS_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_LANES_INL
#undef HTS_LANES_INL
#else
#define HTS_LANES_INL
#endif

#include <bit>
#include <cstdint>

#include "hts/lanes/lanes_plain.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::lanes::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The scalar call's arithmetic on this processor: the same bits as a lane of WideLanes.
using Plain = PlainLanes<HWY_NATIVE_FMA != 0>;

/// Vectors of Tag, a Highway tag of double or float; every function as in PlainLanes, lane by lane.
template <class Tag>
struct WideLanes {
    static constexpr Tag d{};
    static constexpr hn::RebindToSigned<Tag> di{};
    static constexpr hn::RebindToUnsigned<Tag> du{};
    using Number = hn::TFromD<Tag>;
    using Whole = hn::TFromD<hn::RebindToSigned<Tag>>;
    using Real = hn::Vec<Tag>;
    using Int = hn::Vec<hn::RebindToSigned<Tag>>;
    using Mask = hn::Mask<Tag>;
    using Flag = Mask;

    static HWY_INLINE Real real(double v) { return hn::Set(d, static_cast<Number>(v)); }
    static HWY_INLINE Int integer(std::int64_t v) { return hn::Set(di, static_cast<Whole>(v)); }
    template <class V>
    static HWY_INLINE V add(V a, V b) {
        return hn::Add(a, b);
    }
    template <class V>
    static HWY_INLINE V sub(V a, V b) {
        return hn::Sub(a, b);
    }
    static HWY_INLINE Real mul(Real a, Real b) { return hn::Mul(a, b); }
    static HWY_INLINE Real divide(Real a, Real b) { return hn::Div(a, b); }
    static HWY_INLINE Real sqrt(Real a) { return hn::Sqrt(a); }
    static HWY_INLINE Real mul_add(Real a, Real b, Real c) { return hn::MulAdd(a, b, c); }
    static HWY_INLINE Real neg_mul_add(Real a, Real b, Real c) { return hn::NegMulAdd(a, b, c); }
    static HWY_INLINE Real max(Real a, Real b) { return hn::Max(a, b); }
    static HWY_INLINE Real min(Real a, Real b) { return hn::Min(a, b); }

    static HWY_INLINE Int bits(Real a) { return hn::BitCast(di, a); }
    static HWY_INLINE Real from_bits(Int a) { return hn::BitCast(d, a); }
    static HWY_INLINE Int bit_and(Int a, Int b) { return hn::And(a, b); }
    static HWY_INLINE Int bit_or(Int a, Int b) { return hn::Or(a, b); }
    static HWY_INLINE Int shift_left(Int a, Int n) {
        return hn::BitCast(di, hn::Shl(hn::BitCast(du, a), hn::BitCast(du, n)));
    }
    static HWY_INLINE Int shift_right(Int a, Int n) {
        return hn::BitCast(di, hn::Shr(hn::BitCast(du, a), hn::BitCast(du, n)));
    }
    template <int n>
    static HWY_INLINE Int shift_left(Int a) {
        return hn::ShiftLeft<n>(a);
    }
    template <int n>
    static HWY_INLINE Int shift_right(Int a) {
        return hn::BitCast(di, hn::ShiftRight<n>(hn::BitCast(du, a)));
    }
    /// n a for n a power of 2, or the sum or the difference of two
    template <int n>
    static HWY_INLINE Int times(Int a) {
        constexpr int high = std::bit_width(static_cast<unsigned>(n)) - 1;
        constexpr int rest = n - (1 << high);
        constexpr int gap = (2 << high) - n;
        if constexpr (rest == 0) {
            return hn::ShiftLeft<high>(a);
        } else if constexpr ((rest & (rest - 1)) == 0) {
            return hn::Add(hn::ShiftLeft<high>(a), hn::ShiftLeft<std::countr_zero(unsigned{rest})>(a));
        } else {
            static_assert((gap & (gap - 1)) == 0);
            return hn::Sub(hn::ShiftLeft<high + 1>(a), hn::ShiftLeft<std::countr_zero(unsigned{gap})>(a));
        }
    }
    static HWY_INLINE Int clamp(Int a, std::int64_t low, std::int64_t high) {
        return hn::Min(hn::Max(a, integer(low)), integer(high));
    }
    static HWY_INLINE Int max0(Int a) { return hn::Max(a, integer(0)); }
    static HWY_INLINE Int unsigned_min(Int a, std::int64_t b) {
        return hn::BitCast(di, hn::Min(hn::BitCast(du, a), hn::BitCast(du, integer(b))));
    }

    static HWY_INLINE Mask greater_equal(Real a, Real b) { return hn::Ge(a, b); }
    static HWY_INLINE Mask less(Real a, Real b) { return hn::Lt(a, b); }
    static HWY_INLINE Mask either(Mask a, Mask b) { return hn::Or(a, b); }
    static HWY_INLINE Mask any_bit(Int a, std::int64_t b) {
        return hn::RebindMask(d, hn::TestBit(a, integer(b)));  // one bit
    }
    static HWY_INLINE Flag not_negative(Int a) { return hn::RebindMask(d, hn::Gt(a, integer(-1))); }
    static HWY_INLINE Int select_integer(Mask m, Int a, Int b) {
        return hn::IfThenElse(hn::RebindMask(di, m), a, b);
    }
    static HWY_INLINE Real select(Mask m, Real a, Real b) { return hn::IfThenElse(m, a, b); }
    static HWY_INLINE Int gather(const Whole* base, Int i) { return hn::GatherIndex(di, base, i); }
};

#if HWY_TARGET != HWY_SCALAR
constexpr hn::FixedTag<double, 2> two{};
#endif

}  // namespace hts::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
