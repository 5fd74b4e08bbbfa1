// What a pair contributes where every wavelength sees slopes of its own; included once per instruction set.
#if defined(HTS_EVALUATION_SEEN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_SEEN_INL
#undef HTS_EVALUATION_SEEN_INL
#else
#define HTS_EVALUATION_SEEN_INL
#endif

#include <cstddef>

#include "hts/correlation/lobe_block-inl.hpp"
#include "hts/evaluation/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Terms of one pair at the wavelengths of a block: a lane is a wavelength. The same bits as PairBlock's,
/// whose lanes are pairs.
template <class Lanes>
struct SeenTerms {
    using V = typename Lanes::Real;
    static constexpr auto d = Lanes::d;
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    const Prepared& p;
    PairAngles<V> angles;
    PairTerms<V> each[size / lanes];

    HWY_INLINE SeenTerms(const Prepared& of, const DirectionPair& pair)
        : p{of}, angles{Lanes::real(pair.in.cos_theta()),  Lanes::real(pair.in.sin_theta()),
                        Lanes::real(pair.in.cos_phi()),    Lanes::real(pair.in.sin_phi()),
                        Lanes::real(pair.out.cos_theta()), Lanes::real(pair.out.sin_theta()),
                        Lanes::real(pair.out.cos_phi()),   Lanes::real(pair.out.sin_phi())} {}

    HWY_INLINE void prepare(std::size_t first, std::size_t count) {
        constexpr Lanes o{};
        for (std::size_t i = 0; i < count; i += lanes) {
            const V along = hn::LoadU(d, p.widths.data() + first + i),
                    across = hn::LoadU(d, p.widths.data() + p.padded + first + i);
            const auto in = seen(o, angles.cos_in, angles.sin_in,
                                 width(along, across, angles.cos_phi_in, angles.sin_phi_in)),
                       out = seen(o, angles.cos_out, angles.sin_out,
                                  width(along, across, angles.cos_phi_out, angles.sin_phi_out));
            HWY_ALIGN double lambert[lanes];
            hn::Store(lambert_coordinate(o, in.obstruction + out.obstruction), d, lambert);
            for (double& v : lambert) v = one_plus_lambert(v);
            each[i / lanes] = pair_terms(o, p.surface, angles, hn::Load(d, lambert),
                                         (in.lit * out.lit) / (in.reach * out.reach));
        }
    }
    HWY_INLINE const PairTerms<V>& operator[](std::size_t i) const { return each[i / lanes]; }

  private:
    HWY_INLINE V width(V along, V across, V cos_phi, V sin_phi) const {
        constexpr Lanes o{};
        const AxisTerms& axes = p.surface.axes;
        if (axes.isotropic) return along;
        const V c = o.real(axes.cosine), s = o.real(axes.sine);
        const V first = o.mul_add(cos_phi, c, sin_phi * s) * along;
        const V second = o.neg_mul_add(cos_phi, s, sin_phi * c) * across;
        return o.sqrt(o.mul_add(first, first, second * second));
    }
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
