// The spectral evaluation of he_unified, compiled for every instruction set and chosen at run time.
#include "hts/unified/lanes/unified_simd.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "hts/phi/phi_sum.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/unified/lanes/unified_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/phi/phi_block-inl.hpp"
#include "hts/unified/lanes/kicks_block-inl.hpp"
#include "hts/unified/lanes/unified_kernel-inl.hpp"
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

using evaluation_detail::is_ordinary;
constexpr std::size_t block_size = 64;

template <std::size_t most_lanes>
struct Vectors {
    static constexpr hn::CappedTag<double, most_lanes> d{};
    using Lanes = hl::WideLanes<hn::CappedTag<double, most_lanes> >;
    using V = hn::Vec<hn::CappedTag<double, most_lanes> >;
    static constexpr std::size_t lanes = hn::MaxLanes(d);

    static constexpr std::size_t whole(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }
    /// The first `count` of a vector, to `to`.
    static HWY_INLINE void store_some(V value, std::size_t count, double* to) {
        if (HWY_LIKELY(count >= lanes)) {
            hn::StoreU(value, d, to);
        } else {
            HWY_ALIGN double all[lanes];
            hn::Store(value, d, all);
            std::copy_n(all, count, to);
        }
    }
};

/// A pair's terms in every lane.
template <std::size_t most_lanes>
HWY_INLINE UnifiedPair<typename Vectors<most_lanes>::V> terms_of_one(const SurfaceTerms& surface,
                                                                     const DirectionPair& pair) {
    using V = typename Vectors<most_lanes>::V;
    constexpr typename Vectors<most_lanes>::Lanes o{};
    constexpr auto two = hl::two;
    constexpr hl::WideLanes<std::remove_const_t<decltype(two)> > both{};
    const auto& [in, out] = pair;
    const auto in_and_out = [two](double a, double b)
                                HWY_ATTR { return hn::InterleaveLower(hn::Set(two, a), hn::Set(two, b)); };
    const auto seen =
        unified_seen(both, surface, in_and_out(in.cos_theta(), out.cos_theta()),
                     in_and_out(in.sin_theta(), out.sin_theta()), in_and_out(in.cos_phi(), out.cos_phi()),
                     in_and_out(in.sin_phi(), out.sin_phi()));
    const auto first = [&o](auto v) HWY_ATTR { return o.real(hn::GetLane(v)); };
    const auto second = [&o, two](auto v) HWY_ATTR { return o.real(hn::GetLane(hn::Reverse2(two, v))); };
    const evaluation::PairAngles<V> angles{
        o.real(in.cos_theta()),  o.real(in.sin_theta()),  o.real(in.cos_phi()),  o.real(in.sin_phi()),
        o.real(out.cos_theta()), o.real(out.sin_theta()), o.real(out.cos_phi()), o.real(out.sin_phi())};
    return unified_pair(o, surface, angles, UnifiedSeen<V>{first(seen.masked), first(seen.return_factor)},
                        UnifiedSeen<V>{second(seen.masked), second(seen.return_factor)});
}

/// Items of one pair from a wavelength on: a lane is a wavelength.
template <std::size_t most_lanes>
struct Spectrum : Vectors<most_lanes> {
    using V = typename Vectors<most_lanes>::V;

    const Prepared& p;
    const UnifiedPair<V>& terms;
    std::size_t first;

    HWY_INLINE Spectrum(const Prepared& of, const UnifiedPair<V>& pair, std::size_t from)
        : p{of}, terms{pair}, first{from} {}
    HWY_INLINE V load(std::size_t column, std::size_t i) const {
        return hn::LoadU(this->d, p[static_cast<Prepared::Column>(column)] + first + i);
    }
    HWY_INLINE const UnifiedPair<V>& pair(std::size_t) const { return terms; }
    HWY_INLINE V g(std::size_t i) const { return terms[variance] * load(Prepared::wave_squared, i); }
    HWY_INLINE V t(std::size_t i) const { return terms[argument] * load(Prepared::wave_squared, i); }
    HWY_INLINE V inverse_g(std::size_t i) const {
        return terms[inverse_variance] * load(Prepared::inverse_wave_squared, i);
    }
    HWY_INLINE bool dense() const { return p.dense; }
};

/// Terms of a block of pairs: a lane is a pair.
struct PairBlock : Vectors<8> {
    HWY_ALIGN double field[fields][block_size];

    /// Fills whole vectors; those beyond `pairs` repeat its last.
    HWY_INLINE bool load(const SurfaceTerms& surface, std::span<const DirectionPair> pairs) {
        constexpr Lanes o{};
        HWY_ALIGN double angle[8][block_size];
        bool ordinary = true;
        const std::size_t count = whole(pairs.size());
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [in, out] = pairs[std::min(i, pairs.size() - 1)];
            const double values[8]{in.cos_theta(),  in.sin_theta(),  in.cos_phi(),  in.sin_phi(),
                                   out.cos_theta(), out.sin_theta(), out.cos_phi(), out.sin_phi()};
            for (std::size_t k = 0; k < 8; ++k) angle[k][i] = values[k];
            ordinary &= is_ordinary(in) && is_ordinary(out);
        }
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto at = [&](std::size_t k) HWY_ATTR { return hn::Load(d, angle[k] + i); };
            const evaluation::PairAngles<V> a{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
            const UnifiedPair<V> terms = unified_pair(
                o, surface, a, unified_seen(o, surface, a.cos_in, a.sin_in, a.cos_phi_in, a.sin_phi_in),
                unified_seen(o, surface, a.cos_out, a.sin_out, a.cos_phi_out, a.sin_phi_out));
            for (std::size_t f = 0; f < fields; ++f) hn::Store(terms.field[f], d, field[f] + i);
        }
        return ordinary;
    }
};

/// Items of one wavelength: a lane is a pair.
struct Pairs : Vectors<8> {
    const PairBlock& block;
    const Prepared& p;
    std::size_t at;

    HWY_INLINE Pairs(const PairBlock& of, const Prepared& prepared, std::size_t wavelength)
        : block{of}, p{prepared}, at{wavelength} {}
    HWY_INLINE V load(std::size_t column, std::size_t) const {
        return hn::Set(d, p[static_cast<Prepared::Column>(column)][at]);
    }
    HWY_INLINE V field(Field f, std::size_t i) const { return hn::Load(d, block.field[f] + i); }
    HWY_INLINE UnifiedPair<V> pair(std::size_t i) const {
        UnifiedPair<V> result;
        for (std::size_t f = 0; f < fields; ++f) result.field[f] = hn::Load(d, block.field[f] + i);
        return result;
    }
    HWY_INLINE V g(std::size_t i) const { return field(variance, i) * load(Prepared::wave_squared, i); }
    HWY_INLINE V t(std::size_t i) const { return field(argument, i) * load(Prepared::wave_squared, i); }
    HWY_INLINE V inverse_g(std::size_t i) const {
        return field(inverse_variance, i) * load(Prepared::inverse_wave_squared, i);
    }
    HWY_INLINE bool dense() const { return p.dense; }
};

/// What multiplies Phi: all of it for unpolarised light, or all but the Jones matrix,
/// which then is kept beside.
template <class Items, bool polarised>
struct Scaled : Items {
    using V = typename Items::V;

    const double* mean;
    double (*kept)[block_size];  // the matrix, part by part

    HWY_INLINE Scaled(const Items& items, const double* kicks, double (*matrices)[block_size])
        : Items{items}, mean{kicks}, kept{matrices} {}
    HWY_INLINE WaveTerms<V> wave(std::size_t i) const {
        WaveTerms<V> result;
        result.d_real = this->load(Prepared::d_real, i);
        result.d_imaginary = this->load(Prepared::d_imaginary, i);
        result.horizon = this->load(Prepared::horizon, i);
        result.lift = this->load(Prepared::lift, i);
        result.returned = this->load(Prepared::returned, i);
        result.dense = this->dense();
        if (result.dense) {
            HTS_UNROLL
            for (std::size_t j = 0; j < root_terms; ++j)
                result.root[j] = {this->load(Prepared::root_real + j, i),
                                  this->load(Prepared::root_imaginary + j, i)};
        }
        return result;
    }
    HWY_INLINE V scale(std::size_t i) const {
        constexpr typename Items::Lanes o{};
        const JonesLanes<V> m = jones(o, this->pair(i), wave(i), hn::Load(this->d, mean + i));
        const V scale = this->load(Prepared::weight, i) * m.shadowing;
        if constexpr (polarised) {
            const V parts[8]{m.ss.re, m.ss.im, m.sp.re, m.sp.im, m.ps.re, m.ps.im, m.pp.re, m.pp.im};
            for (std::size_t k = 0; k < 8; ++k) hn::Store(parts[k], this->d, kept[k] + i);
            return scale;
        } else {
            return scale * o.real(0.5) * ((norm(o, m.ss) + norm(o, m.pp)) + (norm(o, m.sp) + norm(o, m.ps)));
        }
    }
};

/// The lobe of a block of items.
template <class PhiSpec, class KicksSpec, std::size_t most_lanes, class Items, bool polarised>
struct LobeBlock {
    using All = Scaled<Items, polarised>;
    using V = typename Items::V;

    KicksBlock<KicksSpec, most_lanes, Items> kicks;
    HWY_ALIGN double matrices[polarised ? 8 : 1][block_size];
    All items;
    phi::PhiBlock<PhiSpec, All> lobe;

    HWY_INLINE explicit LobeBlock(const Items& of) : items{of, kicks.mean, matrices}, lobe{items} {}
    /// Calls use(i, the lobe of items i ... i + lanes - 1).
    template <class Use>
    HWY_INLINE void each(std::size_t count, Use&& use) {
        kicks.prepare(items, Items::whole(count));
        if (count <= Items::lanes) {
            use(std::size_t{0}, lobe.one_vector());
            return;
        }
        lobe.prepare(Items::whole(count));
        for (std::size_t i = 0; i < count; i += Items::lanes) use(i, lobe.value(i));
    }
};

template <class PhiSpec, class KicksSpec, std::size_t most_lanes>
HWY_INLINE void brdf_of_one(const Prepared& p, const DirectionPair& pair, double* result) {
    using Items = Spectrum<most_lanes>;
    const auto terms = terms_of_one<most_lanes>(p.surface, pair);
    for (std::size_t first = 0; first < p.count; first += block_size) {
        const std::size_t count = std::min(block_size, p.count - first);
        const Items items{p, terms, first};
        LobeBlock<PhiSpec, KicksSpec, most_lanes, Items, false> block{items};
        block.each(count, [&](std::size_t i, typename Items::V lobe) HWY_ATTR {
            Items::store_some(lobe + items.load(Prepared::uniform, i), count - i, result + first + i);
        });
    }
}

template <class PhiSpec, class KicksSpec>
HWY_ATTR bool brdf_one(const Prepared& p, const DirectionPair& pair, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= 4)
        brdf_of_one<PhiSpec, KicksSpec, 4>(p, pair, result);
    else
        brdf_of_one<PhiSpec, KicksSpec, 8>(p, pair, result);
    return true;
}

template <class PhiSpec, class KicksSpec>
HWY_ATTR bool brdf_many(const Prepared& p, std::span<const DirectionPair> pairs, double* result) {
    constexpr auto d = Pairs::d;
    bool ordinary = true;
    for (std::size_t first = 0; first < pairs.size(); first += block_size) {
        const auto some = pairs.subspan(first, std::min(block_size, pairs.size() - first));
        PairBlock terms;
        ordinary &= terms.load(p.surface, some);
        for (std::size_t j = 0; j < p.count; ++j) {
            const Pairs items{terms, p, j};
            LobeBlock<PhiSpec, KicksSpec, 8, Pairs, false> block{items};
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

template <class PhiSpec, class KicksSpec, std::size_t most_lanes>
HWY_INLINE void mueller_of_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    using Items = Spectrum<most_lanes>;
    using V = typename Items::V;
    constexpr typename Items::Lanes o{};
    const auto terms = terms_of_one<most_lanes>(p.surface, pair);
    const V kept = o.real(1 - 2 * p.surface.mixed);
    for (std::size_t first = 0; first < p.count; first += block_size) {
        const std::size_t count = std::min(block_size, p.count - first);
        const Items items{p, terms, first};
        LobeBlock<PhiSpec, KicksSpec, most_lanes, Items, true> block{items};
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

template <class PhiSpec, class KicksSpec>
HWY_ATTR bool mueller_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= 4)
        mueller_of_one<PhiSpec, KicksSpec, 4>(p, pair, result);
    else
        mueller_of_one<PhiSpec, KicksSpec, 8>(p, pair, result);
    return true;
}

template <class PhiSpec, class KicksSpec>
Forms forms_of() {
    return {brdf_one<PhiSpec, KicksSpec>, brdf_many<PhiSpec, KicksSpec>, mueller_one<PhiSpec, KicksSpec>};
}
FormTable form_table() {
    return {forms_of<phi_detail::Low, KicksLow>(), forms_of<phi_detail::Medium, KicksMedium>()};
}

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::unified_detail {

HWY_EXPORT(form_table);

Forms forms(Tolerance tolerance) noexcept {
    const FormTable table = HWY_DYNAMIC_DISPATCH(form_table)();
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
