// What pairs of directions contribute whatever the wavelength, a lane to a pair; included once per
// instruction set.
#if defined(HTS_EVALUATION_PAIRS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_PAIRS_INL
#undef HTS_EVALUATION_PAIRS_INL
#else
#define HTS_EVALUATION_PAIRS_INL
#endif

#include <algorithm>
#include <cstddef>
#include <span>

#include "hts/evaluation/kernel-inl.hpp"
#include "hwy/cache_control.h"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Terms of a block of pairs: a lane is a pair.
struct PairBlock {
    static constexpr hn::CappedTag<double, 8> d{};
    using Lanes = hl::WideLanes<hn::CappedTag<double, 8> >;
    using V = hn::Vec<decltype(d)>;
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    HWY_ALIGN double cos_in[size], sin_in[size], cos_phi_in[size], sin_phi_in[size];
    HWY_ALIGN double cos_out[size], sin_out[size], cos_phi_out[size], sin_phi_out[size];
    HWY_ALIGN double lambert[size], shadowing[size];
    HWY_ALIGN double variance[size], inverse_variance[size], argument[size], lobe[size], cos_squared[size];

    /// Fills whole vectors; those beyond `pairs` repeat its last.
    HWY_INLINE bool load(std::span<const DirectionPair> pairs, std::span<const DirectionPair> next) {
        for (const DirectionPair& pair : next) hwy::Prefetch(&pair);
        bool ordinary = true;
        const std::size_t whole = (pairs.size() + lanes - 1) / lanes * lanes;
        for (std::size_t i = 0; i < whole; ++i) {
            const auto& [in, out] = pairs[std::min(i, pairs.size() - 1)];
            cos_in[i] = in.cos_theta();
            sin_in[i] = in.sin_theta();
            cos_phi_in[i] = in.cos_phi();
            sin_phi_in[i] = in.sin_phi();
            cos_out[i] = out.cos_theta();
            sin_out[i] = out.sin_theta();
            cos_phi_out[i] = out.cos_phi();
            sin_phi_out[i] = out.sin_phi();
            ordinary &= is_ordinary(pairs[std::min(i, pairs.size() - 1)]);
        }
        return ordinary;
    }

    HWY_INLINE void evaluate(const SurfaceTerms& surface, std::size_t count) {
        constexpr Lanes o{};
        const auto at = [](const double* a, std::size_t i) HWY_ATTR { return hn::Load(d, a + i); };
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto width = [&](const double* cosine, const double* sine) HWY_ATTR {
                return slope_width(o, surface.axes, surface.slope_width, at(cosine, i), at(sine, i));
            };
            const auto in = seen(o, at(cos_in, i), at(sin_in, i), width(cos_phi_in, sin_phi_in));
            const auto out = seen(o, at(cos_out, i), at(sin_out, i), width(cos_phi_out, sin_phi_out));
            hn::Store(lambert_coordinate(o, in.obstruction + out.obstruction), d, lambert + i);
            hn::Store((in.lit * out.lit) / (in.reach * out.reach), d, shadowing + i);
        }
        for (std::size_t i = 0; i < count; ++i) lambert[i] = one_plus_lambert(lambert[i]);
        for (std::size_t i = 0; i < count; i += lanes) {
            const PairAngles<V> angles{at(cos_in, i),      at(sin_in, i),     at(cos_phi_in, i),
                                       at(sin_phi_in, i),  at(cos_out, i),    at(sin_out, i),
                                       at(cos_phi_out, i), at(sin_phi_out, i)};
            const auto terms = pair_terms(o, surface, angles, at(lambert, i), at(shadowing, i));
            hn::Store(terms.variance, d, variance + i);
            hn::Store(terms.inverse_variance, d, inverse_variance + i);
            hn::Store(terms.argument, d, argument + i);
            hn::Store(terms.lobe, d, lobe + i);
            hn::Store(terms.cos_squared, d, cos_squared + i);
        }
    }
};

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
