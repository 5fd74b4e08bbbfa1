// What a pair contributes where every wavelength sees slopes of its own; included once per instruction set.
#if defined(HTS_EVALUATION_SEEN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_SEEN_INL
#undef HTS_EVALUATION_SEEN_INL
#else
#define HTS_EVALUATION_SEEN_INL
#endif

#include <cstddef>

#include "hts/correlation/lobe_block-inl.hpp"
#include "hts/evaluation/pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Shadowing of a pair, as yet without its quotient, and what the effective roughness follows.
template <class V>
struct PairSeen {
    V lambert;     // coordinate of lambert_coefficients
    V lit, reach;  // products over both directions
};

/// `seen` of both directions with one division.
template <class Lanes, class V>
HWY_INLINE PairSeen<V> pair_seen(const Lanes& o, const PairAngles<V>& a, V tan_in, V tan_out, V width_in,
                                 V width_out) {
    const V least = o.real(1e-100), centre = o.real(erfcx_centre);
    const V in = o.max(width_in * a.sin_in, least), out = o.max(width_out * a.sin_out, least);
    const V in_sum = o.mul_add(centre, in, a.cos_in), out_sum = o.mul_add(centre, out, a.cos_out);
    const V in_below = in * in_sum, out_below = out * out_sum;
    const V over = o.real(1) / (in_below * out_below);
    const V over_in = over * out_below, over_out = over * in_below;
    const V far = o.real(erfcx_far), first = o.real(erfcx_first);
    const Seen<V> i = seen_at(o, a.cos_in, tan_in, in, o.min(a.cos_in * in_sum * over_in, far),
                              o.max(centre * in * (in * over_in), first)),
                  r = seen_at(o, a.cos_out, tan_out, out, o.min(a.cos_out * out_sum * over_out, far),
                              o.max(centre * out * (out * over_out), first));
    return {lambert_coordinate(o, i.obstruction + r.obstruction), i.lit * r.lit, i.reach * r.reach};
}

/// What the pair contributes, from the same of one that is neither shadowed nor obstructed.
template <class Lanes, class V>
HWY_INLINE PairTerms<V> with_seen(const Lanes& o, const PairTerms<V>& bare, V one_plus_w, V lit, V reach) {
    const V over = o.real(1) / (reach * one_plus_w);
    return {bare.variance * (reach * over), bare.inverse_variance * one_plus_w, bare.argument,
            bare.lobe * (lit * (one_plus_w * over)), bare.cos_squared};
}

/// Terms of one pair at the wavelengths of a block: a lane is a wavelength.
template <class Lanes>
struct SeenTerms {
    using V = typename Lanes::Real;
    static constexpr auto d = Lanes::d;
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    const Prepared& p;
    PairAngles<V> a;
    V tan_in, tan_out;
    PairTerms<V> bare;
    PairTerms<V> each[size / lanes];

    HWY_INLINE SeenTerms(const Prepared& of, const DirectionPair& pair)
        : p{of},
          a{Lanes::real(pair.in.cos_theta()),  Lanes::real(pair.in.sin_theta()),
            Lanes::real(pair.in.cos_phi()),    Lanes::real(pair.in.sin_phi()),
            Lanes::real(pair.out.cos_theta()), Lanes::real(pair.out.sin_theta()),
            Lanes::real(pair.out.cos_phi()),   Lanes::real(pair.out.sin_phi())},
          tan_in{a.sin_in / a.cos_in},
          tan_out{a.sin_out / a.cos_out},
          bare{pair_terms(Lanes{}, of.surface, a, Lanes::real(1), Lanes::real(1))} {}

    HWY_INLINE void prepare(std::size_t first, std::size_t count) {
        constexpr Lanes o{};
        const AxisTerms& axes = p.surface.axes;
        for (std::size_t i = 0; i < count; i += lanes) {
            const V along = hn::LoadU(d, p.widths.data() + first + i),
                    across = hn::LoadU(d, p.widths.data() + p.padded + first + i);
            const PairSeen<V> at =
                pair_seen(o, a, tan_in, tan_out, width_of(o, axes, along, across, a.cos_phi_in, a.sin_phi_in),
                          width_of(o, axes, along, across, a.cos_phi_out, a.sin_phi_out));
            HWY_ALIGN double lambert[lanes];
            hn::Store(at.lambert, d, lambert);
            for (double& v : lambert) v = one_plus_lambert(v);
            each[i / lanes] = with_seen(o, bare, hn::Load(d, lambert), at.lit, at.reach);
        }
    }
    HWY_INLINE const PairTerms<V>& operator[](std::size_t i) const { return each[i / lanes]; }
};

/// The same of a block of pairs, one wavelength after the other: a lane is a pair.
struct SeenPairs {
    static constexpr auto d = PairBlock::d;
    using Lanes = PairBlock::Lanes;
    using V = PairBlock::V;
    static constexpr std::size_t lanes = PairBlock::lanes, size = PairBlock::size;

    PairBlock& block;
    HWY_ALIGN double tan_in[size], tan_out[size], lit[size], reach[size];
    HWY_ALIGN double variance[size], inverse_variance[size], lobe[size];  // not shadowed, not obstructed

    HWY_INLINE SeenPairs(PairBlock& of, const SurfaceTerms& surface, std::size_t count) : block{of} {
        for (std::size_t i = 0; i < count; i += lanes) {
            const PairAngles<V> a = angles(i);
            const PairTerms<V> bare = pair_terms(Lanes{}, surface, a, Lanes::real(1), Lanes::real(1));
            hn::Store(a.sin_in / a.cos_in, d, tan_in + i);
            hn::Store(a.sin_out / a.cos_out, d, tan_out + i);
            hn::Store(bare.variance, d, variance + i);
            hn::Store(bare.inverse_variance, d, inverse_variance + i);
            hn::Store(bare.lobe, d, lobe + i);
            hn::Store(bare.argument, d, block.argument + i);
            hn::Store(bare.cos_squared, d, block.cos_squared + i);
        }
    }
    HWY_INLINE void see(const Prepared& p, std::size_t wavelength, std::size_t count) {
        constexpr Lanes o{};
        const AxisTerms& axes = p.surface.axes;
        const V along = o.real(p.widths[wavelength]), across = o.real(p.widths[p.padded + wavelength]);
        for (std::size_t i = 0; i < count; i += lanes) {
            const PairAngles<V> a = angles(i);
            const PairSeen<V> at = pair_seen(o, a, hn::Load(d, tan_in + i), hn::Load(d, tan_out + i),
                                             width_of(o, axes, along, across, a.cos_phi_in, a.sin_phi_in),
                                             width_of(o, axes, along, across, a.cos_phi_out, a.sin_phi_out));
            hn::Store(at.lambert, d, block.lambert + i);
            hn::Store(at.lit, d, lit + i);
            hn::Store(at.reach, d, reach + i);
        }
        for (std::size_t i = 0; i < count; ++i) block.lambert[i] = one_plus_lambert(block.lambert[i]);
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto at = [i](const double* from) HWY_ATTR { return hn::Load(d, from + i); };
            const PairTerms<V> bare{at(variance), at(inverse_variance), o.real(0), at(lobe), o.real(0)};
            const PairTerms<V> terms = with_seen(o, bare, at(block.lambert), at(lit), at(reach));
            hn::Store(terms.variance, d, block.variance + i);
            hn::Store(terms.inverse_variance, d, block.inverse_variance + i);
            hn::Store(terms.lobe, d, block.lobe + i);
        }
    }

  private:
    HWY_INLINE PairAngles<V> angles(std::size_t i) const {
        const auto at = [i](const double* from) HWY_ATTR { return hn::Load(d, from + i); };
        return {at(block.cos_in),  at(block.sin_in),  at(block.cos_phi_in),  at(block.sin_phi_in),
                at(block.cos_out), at(block.sin_out), at(block.cos_phi_out), at(block.sin_phi_out)};
    }
};
/// Where every wavelength sees the same, in its place.
struct SharedPairs {
    HWY_INLINE SharedPairs(PairBlock& block, const SurfaceTerms& surface, std::size_t count) {
        block.evaluate(surface, count);
    }
    HWY_INLINE void see(const Prepared&, std::size_t, std::size_t) const {}
};

/// scale 2 D for a block of items, as PhiBlock has scale Phi.
template <std::size_t most_lanes, class Items>
struct CorrelatedBlock {
    using V = hn::Vec<hn::CappedTag<double, most_lanes>>;
    static constexpr std::size_t size = 64;

    const Items& items;
    correlation_detail::HWY_NAMESPACE::LobeBlock<most_lanes, false> lobe;

    explicit HWY_INLINE CorrelatedBlock(const Items& of) : items{of} {}
    HWY_INLINE void prepare(std::size_t count) { lobe.prepare(*items.p.correlation, items, count); }
    HWY_INLINE V value(std::size_t i) const { return lobe.value(i, items.scale(i)); }
    HWY_INLINE V one_vector() {
        prepare(hn::MaxLanes(hn::CappedTag<double, most_lanes>{}));
        return value(0);
    }
};

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
