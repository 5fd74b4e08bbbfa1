// The polynomials of a table of Phi, item by item: a row of coefficients fills a vector. Included once per
// instruction set.
#if defined(HTS_PHI_CELLS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_PHI_CELLS_INL
#undef HTS_PHI_CELLS_INL
#else
#define HTS_PHI_CELLS_INL
#endif

#include <cstddef>

#include "hts/lanes/polynomials-inl.hpp"
#include "hts/phi/phi_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::phi_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// A vector of Tag as one of NarrowTag, whose numbers are the coefficients', and back.
template <class NarrowTag, class Tag>
HWY_INLINE hn::Vec<NarrowTag> narrowed(Tag /*d*/, hn::Vec<Tag> v) {
    if constexpr (sizeof(hn::TFromD<NarrowTag>) < sizeof(hn::TFromD<Tag>))
        return hn::DemoteTo(NarrowTag{}, v);
    else
        return v;
}
template <class Tag, class NarrowTag>
HWY_INLINE hn::Vec<Tag> widened(NarrowTag /*n*/, hn::Vec<NarrowTag> v) {
    if constexpr (sizeof(hn::TFromD<NarrowTag>) < sizeof(hn::TFromD<Tag>))
        return hn::PromoteTo(Tag{}, v);
    else
        return v;
}

/// Sums of the cells' polynomials over x and over whole groups of z powers: `width` remain for each lane.
template <class Spec, class Tag>
struct Cells {
    using T = typename Spec::Coefficient;
    static constexpr hn::CappedTag<T, 4> pack{};
    static constexpr std::size_t width = hn::MaxLanes(pack);  // powers of z in a vector
    static constexpr std::size_t packs = Spec::lanes / width;
    static_assert(width == 4 || width == 2);
    using NarrowTag = hn::Rebind<T, Tag>;

    static HWY_INLINE hn::Vec<decltype(pack)> sums(const T* cell, T x, T z) {
        hn::Vec<decltype(pack)> sum[packs];
        hl::polynomials<Spec::rows, packs>(sum, hn::Set(pack, x), hn::Set(pack, x * x),
                                           [cell](int i, std::size_t k) HWY_ATTR {
                                               return hn::Load(pack, cell + i * Spec::lanes + k * width);
                                           });
        if constexpr (packs > 1) {
            const T z2 = z * z;
            const auto zw = hn::Set(pack, width == 2 ? z2 : z2 * z2);
            HTS_UNROLL
            for (std::size_t k = packs - 1; k > 0; --k) sum[k - 1] = hn::MulAdd(sum[k], zw, sum[k - 1]);
        }
        return sum[0];
    }

    /// What `value` computes, for one lane.
    static HWY_INLINE T fold(hn::Vec<decltype(pack)> sum, T z) {
        if constexpr (width == 4) {
            constexpr hn::CappedTag<T, 2> half{};
            const auto lower = hn::LowerHalf(half, sum), upper = hn::UpperHalf(half, sum);
            return last(hn::MulAdd(upper, hn::Set(half, z * z), lower), z);
        } else
            return last(sum, z);
    }
    template <class V>
    static HWY_INLINE T last(V pair, T z) {
        constexpr hn::CappedTag<T, 2> half{};
        return hn::GetLane(hn::MulAdd(hn::Reverse2(half, pair), hn::Set(half, z), pair));
    }

    static HWY_INLINE hn::Vec<NarrowTag> narrow(hn::Vec<Tag> v) { return narrowed<NarrowTag>(Tag{}, v); }

    static HWY_INLINE hn::Vec<Tag> value(const T* sums, hn::Vec<NarrowTag> z) {
        constexpr NarrowTag n{};
        hn::Vec<NarrowTag> a, b, c, e;
        if constexpr (width == 4) {
            hn::LoadInterleaved4(n, sums, a, b, c, e);
            const auto z2 = hn::Mul(z, z);
            a = hn::MulAdd(hn::MulAdd(e, z2, b), z, hn::MulAdd(c, z2, a));
        } else {
            hn::LoadInterleaved2(n, sums, a, b);
            a = hn::MulAdd(b, z, a);
        }
        return widened<Tag>(n, a);
    }
};

/// Sums of F and W over x^2: what remains for each lane is F and W of the even powers, then of the odd ones.
template <class Spec, class Tag>
struct LineSums {
    using T = typename Spec::Line;
    using NarrowTag = hn::Rebind<T, Tag>;
    static constexpr hn::CappedTag<T, 4> pack{};
    static constexpr std::size_t width = hn::MaxLanes(pack);
    static_assert(Spec::line_rows % 2 == 0);

    /// Four numbers, to `sums`.
    static HWY_INLINE void store(const T* line, T x, T* sums) {
        const auto x2 = hn::Set(pack, x * x);
        HTS_UNROLL
        for (std::size_t k = 0; k < 4; k += width) {
            auto sum = hn::Load(pack, line + 2 * Spec::line_rows - 4 + k);
            HTS_UNROLL
            for (int i = Spec::line_rows / 2 - 2; i >= 0; --i)
                sum = hn::MulAdd(sum, x2, hn::Load(pack, line + 4 * i + k));
            hn::Store(sum, pack, sums + k);
        }
    }

    static HWY_INLINE hn::Vec<NarrowTag> narrow(hn::Vec<Tag> v) { return narrowed<NarrowTag>(Tag{}, v); }

    struct Values {
        hn::Vec<Tag> slope, width;
    };
    static HWY_INLINE Values values(const T* sums, hn::Vec<NarrowTag> x) {
        constexpr NarrowTag n{};
        hn::Vec<NarrowTag> even_f, even_w, odd_f, odd_w;
        hn::LoadInterleaved4(n, sums, even_f, even_w, odd_f, odd_w);
        return {widened<Tag>(n, hn::MulAdd(odd_f, x, even_f)), widened<Tag>(n, hn::MulAdd(odd_w, x, even_w))};
    }
};

/// log2(Phi / factor)
template <class Lanes>
HWY_INLINE typename Lanes::Real exponent(const Lanes& o, typename Lanes::Real multiplier,
                                         typename Lanes::Real slope, typename Lanes::Real width,
                                         typename Lanes::Real cell) {
    return o.neg_mul_add(multiplier, slope, o.add(width, cell));
}

#endif

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
