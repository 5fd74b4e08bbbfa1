// What a lane of single precision is, a wavelength of one pair or a pair at one wavelength; included once per
// instruction set.
#if defined(HTS_SINGLE_ITEMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_SINGLE_ITEMS_INL
#undef HTS_SINGLE_ITEMS_INL
#else
#define HTS_SINGLE_ITEMS_INL
#endif

#include <cstddef>

#include "hts/evaluation/kernel-inl.hpp"
#include "hts/evaluation/limits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// k^2 lobe |F|^2, the reflectance first, so that nothing overflows.
///   weight   |d|^2
template <class V>
HWY_INLINE V single_scale(V lobe, V weight, V wave_squared, const FresnelTerms<V>& f) {
    return lobe * wave_squared * unpolarised(weight, f);
}

/// Items of one pair from a wavelength on: a lane is a wavelength.
template <std::size_t most_lanes>
struct SingleSpectrum {
    static constexpr hn::CappedTag<float, most_lanes> d{};
    using Lanes = hl::WideLanes<hn::CappedTag<float, most_lanes> >;
    using V = hn::Vec<decltype(d)>;
    using Columns = PreparedSingle;
    static constexpr std::size_t lanes = hn::MaxLanes(d);

    const Columns& p;
    const PairTerms<V>& terms;
    std::size_t first;

    HWY_INLINE V load(typename Columns::Column column, std::size_t i) const {
        return hn::LoadU(d, p[column] + first + i);
    }
    HWY_INLINE FresnelTerms<V> fresnel(std::size_t i) const {
        return fresnel_terms(Lanes{}, terms.cos_squared,
                             IndexTerms<V>{load(Columns::d_real, i), load(Columns::d_imaginary_squared, i)});
    }
    HWY_INLINE V g(std::size_t i) const { return terms.variance * load(Columns::wave_squared, i); }
    HWY_INLINE V t(std::size_t i) const { return terms.argument * load(Columns::wave_squared, i); }
    HWY_INLINE V inverse_g(std::size_t i) const {
        return terms.inverse_variance * load(Columns::inverse_wave_squared, i);
    }
    HWY_INLINE V scale(std::size_t i) const {
        return single_scale(terms.lobe, load(Columns::weight, i), load(Columns::wave_squared, i), fresnel(i));
    }
};

/// Items of one wavelength: a lane is a pair of a block.
template <class Block>
struct SinglePairs {
    static constexpr auto d = Block::d;
    using Lanes = typename Block::Lanes;
    using V = typename Block::V;
    using Columns = PreparedSingle;

    const Block& block;
    V wave_squared, inverse_wave_squared, weight;
    IndexTerms<V> index;

    HWY_INLINE SinglePairs(const Block& of, const Columns& p, std::size_t j)
        : block{of},
          wave_squared{hn::Set(d, p[Columns::wave_squared][j])},
          inverse_wave_squared{hn::Set(d, p[Columns::inverse_wave_squared][j])},
          weight{hn::Set(d, p[Columns::weight][j])},
          index{hn::Set(d, p[Columns::d_real][j]), hn::Set(d, p[Columns::d_imaginary_squared][j])} {}

    HWY_INLINE V g(std::size_t i) const { return hn::Load(d, block.variance + i) * wave_squared; }
    HWY_INLINE V t(std::size_t i) const { return hn::Load(d, block.argument + i) * wave_squared; }
    HWY_INLINE V inverse_g(std::size_t i) const {
        return hn::Load(d, block.inverse_variance + i) * inverse_wave_squared;
    }
    HWY_INLINE V scale(std::size_t i) const {
        return single_scale(hn::Load(d, block.lobe + i), weight, wave_squared,
                            fresnel_terms(Lanes{}, hn::Load(d, block.cos_squared + i), index));
    }
};

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
