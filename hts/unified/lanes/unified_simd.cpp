// The spectral evaluation of he_unified, compiled for every instruction set and chosen at run time.
#include "hts/unified/lanes/unified_simd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "hts/phi/phi_sum.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/unified/lanes/unified_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/correlation/lobe_block-inl.hpp"
#include "hts/phi/phi_block-inl.hpp"
#include "hts/unified/lanes/kicks_block-inl.hpp"
#include "hts/unified/lanes/mirror-inl.hpp"
#include "hts/unified/lanes/unified_items-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace phi = phi_detail::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // no vectors: the exact path

FormTable form_table() {
    return {};
}

#else

/// The lobe of a block of items.
template <class PhiSpec, class KicksSpec, std::size_t most_lanes, class Items, Kept what>
struct LobeBlock {
    HWY_ALIGN double matrices[parts_of(what)][block_size];
    Scaled<Items, what> items;
    Plain<Items> plain;
    phi::PhiBlock<PhiSpec, Plain<Items> > lobe;
    KicksBlock<KicksSpec, Items> kicks;

    HWY_INLINE explicit LobeBlock(const Items& of) : items{of, matrices}, plain{of}, lobe{plain} {}
    /// Calls use(i, the lobe of items i ... i + lanes - 1).
    template <class Use>
    HWY_INLINE void each(std::size_t count, Use&& use) {
        lobe.prepare(Items::whole(count), kicks);
        kicks.prepare(Items::whole(count));
        for (std::size_t i = 0; i < count; i += Items::lanes)
            use(i, lobe.value(i) * items.scale(i, kicks.value(items, i)));
    }
};

/// The same with 2 D of another correlation.
template <std::size_t most_lanes, class Items, Kept what>
struct CorrelatedBlock {
    correlation_detail::HWY_NAMESPACE::LobeBlock<most_lanes, true> lobe;
    HWY_ALIGN double matrices[parts_of(what)][block_size];
    Scaled<Items, what> items;

    HWY_INLINE explicit CorrelatedBlock(const Items& of) : items{of, matrices} {}
    template <class Use>
    HWY_INLINE void each(std::size_t count, Use&& use) {
        lobe.prepare(*items.p.correlation, items, Items::whole(count));
        for (std::size_t i = 0; i < count; i += Items::lanes) {
            const typename Items::V mean = hn::Load(Items::d, lobe.mean + i);
            use(i, lobe.value(i, items.scale(i, mean)));
        }
    }
};

/// What the lobe is made of: Phi of the Gaussian correlation, or another.
template <class PhiSpec, class KicksSpec>
struct Gaussian {
    static constexpr bool sees_slopes = false;
    template <std::size_t most_lanes>
    using Items = Spectrum<most_lanes>;
    template <std::size_t most_lanes, class Items, Kept what>
    using Block = LobeBlock<PhiSpec, KicksSpec, most_lanes, Items, what>;
};
struct Correlated {
    static constexpr bool sees_slopes = true;
    template <std::size_t most_lanes>
    using Items = SeenSpectrum<most_lanes>;
    template <std::size_t most_lanes, class Items, Kept what>
    using Block = CorrelatedBlock<most_lanes, Items, what>;
};

template <class Lobe, std::size_t most_lanes>
HWY_INLINE void brdf_of_one(const Prepared& p, const DirectionPair& pair, double* result) {
    using Items = typename Lobe::template Items<most_lanes>;
    const auto terms = terms_of_one<most_lanes>(p.surface, pair);
    for (std::size_t first = 0; first < p.count; first += block_size) {
        const std::size_t count = std::min(block_size, p.count - first);
        const Items items{p, terms, pair, first};
        typename Lobe::template Block<most_lanes, Items, Kept::nothing> block{items};
        block.each(count, [&](std::size_t i, typename Items::V lobe) HWY_ATTR {
            Items::store_some(lobe + items.load(Prepared::uniform, i), count - i, result + first + i);
        });
    }
}

template <class Lobe>
HWY_ATTR bool brdf_one(const Prepared& p, const DirectionPair& pair, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= 4)
        brdf_of_one<Lobe, 4>(p, pair, result);
    else
        brdf_of_one<Lobe, 8>(p, pair, result);
    return true;
}

template <class Lobe>
HWY_ATTR bool brdf_many(const Prepared& p, std::span<const DirectionPair> pairs, double* result) {
    constexpr auto d = Pairs::d;
    bool ordinary = true;
    for (std::size_t first = 0; first < pairs.size(); first += block_size) {
        const auto some = pairs.subspan(first, std::min(block_size, pairs.size() - first));
        PairBlock terms;
        ordinary &= terms.load(p.surface, some);
        for (std::size_t j = 0; j < p.count; ++j) {
            if constexpr (Lobe::sees_slopes) terms.see(p, j, PairBlock::whole(some.size()));
            const Pairs items{terms, p, j};
            typename Lobe::template Block<8, Pairs, Kept::nothing> block{items};
            HWY_ALIGN double values[block_size];
            block.each(some.size(), [&](std::size_t i, Pairs::V lobe) HWY_ATTR {
                hn::Store(lobe + items.load(Prepared::uniform, i), d, values + i);
            });
            for (std::size_t i = 0; i < some.size(); ++i) result[(first + i) * p.count + j] = values[i];
        }
    }
    return ordinary;
}

/// Elements of the Mueller matrix of M times `lobe`, row by row; those that change sign where s and p
/// are exchanged times `kept`.
template <class Lanes, class V>
HWY_INLINE void mueller_elements(const Lanes& o, const double (*matrix)[block_size], V lobe, V uniform,
                                 V kept, V (&m)[16]) {
    const auto part = [&](std::size_t k) HWY_ATTR {
        return Complex<V>{hn::Load(Lanes::d, matrix[k]), hn::Load(Lanes::d, matrix[k + 1])};
    };
    const Complex<V> ss = part(0), sp = part(2), ps = part(4), pp = part(6);
    const V half = o.real(0.5) * lobe, odd = kept * lobe, zero = o.real(0);
    const V a = half * norm(o, ss), b = half * norm(o, sp), c = half * norm(o, ps), e = half * norm(o, pp);
    const Complex<V> columns_s = times_conjugate(o, ss, ps), columns_p = times_conjugate(o, sp, pp);
    const Complex<V> rows_s = times_conjugate(o, ss, sp), rows_p = times_conjugate(o, ps, pp);
    const Complex<V> straight = times_conjugate(o, ss, pp), crossed = times_conjugate(o, sp, ps);
    m[0] = ((a + e) + (b + c)) + uniform;
    m[1] = kept * ((a - e) + (c - b));
    m[2] = lobe * (rows_s.re + rows_p.re);
    m[3] = odd * (rows_s.im + rows_p.im);
    m[4] = kept * ((a - e) + (b - c));
    m[5] = (a + e) - (b + c);
    m[6] = odd * (rows_s.re - rows_p.re);
    m[7] = lobe * (rows_s.im - rows_p.im);
    m[8] = lobe * (columns_s.re + columns_p.re);
    m[9] = odd * (columns_s.re - columns_p.re);
    m[10] = lobe * (straight.re + crossed.re);
    m[11] = odd * (straight.im - crossed.im);
    m[12] = zero - odd * (columns_s.im + columns_p.im);
    m[13] = lobe * (columns_p.im - columns_s.im);
    m[14] = zero - odd * (straight.im + crossed.im);
    m[15] = lobe * (straight.re - crossed.re);
}

template <class Lobe, std::size_t most_lanes>
HWY_INLINE void mueller_of_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    using Items = typename Lobe::template Items<most_lanes>;
    using V = typename Items::V;
    constexpr typename Items::Lanes o{};
    const auto terms = terms_of_one<most_lanes>(p.surface, pair);
    const V kept = o.real(1 - 2 * p.surface.mixed);
    for (std::size_t first = 0; first < p.count; first += block_size) {
        const std::size_t count = std::min(block_size, p.count - first);
        const Items items{p, terms, pair, first};
        typename Lobe::template Block<most_lanes, Items, Kept::matrix> block{items};
        block.each(count, [&](std::size_t i, V lobe) HWY_ATTR {
            V m[16];
            mueller_elements(o, reinterpret_cast<const double(*)[block_size]>(&block.matrices[0][i]), lobe,
                             items.load(Prepared::uniform, i), kept, m);
            HWY_ALIGN double elements[16][Items::lanes];
            for (std::size_t k = 0; k < 16; ++k) hn::Store(m[k], Items::d, elements[k]);
            for (std::size_t j = 0; j < std::min(Items::lanes, count - i); ++j) {
                auto* const to = reinterpret_cast<double*>(result + first + i + j);
                for (std::size_t k = 0; k < 16; ++k) to[k] = elements[k][j];
            }
        });
    }
}

template <class Lobe>
HWY_ATTR bool mueller_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= 4)
        mueller_of_one<Lobe, 4>(p, pair, result);
    else
        mueller_of_one<Lobe, 8>(p, pair, result);
    return true;
}

template <class Lobe, std::size_t most_lanes>
HWY_INLINE void shares_of_one(const Prepared& p, const DirectionPair& pair, std::size_t first,
                              std::size_t count, double* lobes, double* shares) {
    using Items = typename Lobe::template Items<most_lanes>;
    const auto terms = terms_of_one<most_lanes>(p.surface, pair);
    const Items items{p, terms, pair, first};
    typename Lobe::template Block<most_lanes, Items, Kept::share> block{items};
    block.each(count, [&](std::size_t i, typename Items::V lobe) HWY_ATTR {
        Items::store_some(lobe, count - i, lobes + i);
        Items::store_some(hn::Load(Items::d, block.matrices[0] + i), count - i, shares + i);
    });
}

template <class Lobe>
HWY_ATTR bool shares_one(const Prepared& p, const DirectionPair& pair, std::size_t first, std::size_t count,
                         double* lobes, double* shares) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= 4)
        shares_of_one<Lobe, 4>(p, pair, first, count, lobes, shares);
    else
        shares_of_one<Lobe, 8>(p, pair, first, count, lobes, shares);
    return true;
}

HWY_ATTR bool specular_one(const Prepared& p, const Direction& in, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(in))) return false;
    if (p.count <= 4)
        mirrored_at_all<4>(p, in, result);
    else
        mirrored_at_all<8>(p, in, result);
    return true;
}

template <class Lobe>
Forms forms_of() {
    return {brdf_one<Lobe>, brdf_many<Lobe>, mueller_one<Lobe>, shares_one<Lobe>, specular_one};
}
FormTable form_table() {
    return {forms_of<Gaussian<phi_detail::Low, KicksLow> >(),
            forms_of<Gaussian<phi_detail::Medium, KicksMedium> >(), forms_of<Correlated>()};
}

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::unified_detail {

HWY_EXPORT(form_table);

Forms forms(Tolerance tolerance, bool correlated) noexcept {
    const FormTable table = HWY_DYNAMIC_DISPATCH(form_table)();
    if (correlated) return table.correlated;
    return tolerance.relative_error() >= phi_detail::Low::error ? table.low : table.medium;
}

double far_mean_kicks(double g, double t) noexcept {
    constexpr double log_of_nothing = -700;
    const bool any = g > 0 && t >= 0 && std::isfinite(g) && std::isfinite(t);
    if (!any || phi_detail::log_phi_bound(g, t) < log_of_nothing) return 0;
    const phi_detail::PhiSum sum = phi_detail::phi_sum(g, t);
    return sum.rest / sum.inverse_mean;
}

}  // namespace hts::unified_detail
#endif
