// What a lane is, a wavelength of one pair or a pair at one wavelength, and the lobes evaluated there;
// included once per instruction set.
#if defined(HTS_EVALUATION_ITEMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_ITEMS_INL
#undef HTS_EVALUATION_ITEMS_INL
#else
#define HTS_EVALUATION_ITEMS_INL
#endif

#include <cstddef>

#include "hts/evaluation/kernel-inl.hpp"
#include "hts/evaluation/limits-inl.hpp"
#include "hts/phi/phi_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Items of one pair from a wavelength on: a lane is a wavelength.
template <class Number, std::size_t most_lanes>
struct Spectrum {
    static constexpr hn::CappedTag<Number, most_lanes> d{};
    using Lanes = hl::WideLanes<hn::CappedTag<Number, most_lanes> >;
    using V = hn::Vec<decltype(d)>;
    using Columns = PreparedAs<Number>;
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
        return lobe_scale(Lanes{}, terms.lobe, load(Columns::weight, i), load(Columns::wave_squared, i),
                          fresnel(i));
    }
};

/// Items of one wavelength: a lane is a pair of a block.
template <class Block>
struct Pairs {
    static constexpr auto d = Block::d;
    using Lanes = typename Block::Lanes;
    using V = typename Block::V;
    using Columns = PreparedAs<typename Lanes::Number>;

    const Block& block;
    V wave_squared, inverse_wave_squared, weight;
    IndexTerms<V> index;

    HWY_INLINE Pairs(const Block& of, const Columns& p, std::size_t j)
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
        return lobe_scale(Lanes{}, hn::Load(d, block.lobe + i), weight, wave_squared,
                          fresnel_terms(Lanes{}, hn::Load(d, block.cos_squared + i), index));
    }
};

/// Phi in full, as a Spec's table has it.
template <class Spec>
struct Full {
    template <class Items>
    using Block = phi_detail::HWY_NAMESPACE::PhiBlock<Spec, Items>;
};
struct FirstOrder {
    template <class Items>
    using Block = LimitBlock<FirstOrderLimit, Items>;
};
struct RoughLimit {
    template <class Items>
    using Block = LimitBlock<GeometricLimit, Items>;
};

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
