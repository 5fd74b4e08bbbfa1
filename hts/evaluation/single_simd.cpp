// The evaluation in single precision, compiled for every instruction set and chosen at run time.
#include "hts/evaluation/single_simd.hpp"

#include <algorithm>
#include <cmath>

#include "hts/evaluation/prepared.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/evaluation/single_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/evaluation/single_items-inl.hpp"
#include "hts/phi/phi_block-inl.hpp"
#include "hwy/cache_control.h"
#include "hwy/highway.h"

#ifndef HTS_SINGLE_FORM_TABLE
#define HTS_SINGLE_FORM_TABLE
namespace hts::evaluation_detail {
struct SingleFormTable {
    SingleForms full, first_order, rough_limit;
};
}  // namespace hts::evaluation_detail
#endif

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // no vectors: double precision has no lanes there either

SingleFormTable single_form_table() {
    return {};
}

#else

using SingleSurface = SurfaceTermsAs<float>;

/// What the lanes read of a pair.
struct SinglePair {
    float cos_in, sin_in, width_in;  // the width of the slopes along a direction, times its sine
    float cos_out, sin_out, width_out;
    float horizontal, stretched;  // |v_xy|^2, and stretched along the axes
};

/// In double where numbers nearly cancel.
HWY_INLINE SinglePair single_pair(const SingleSurface& surface, const DirectionPair& pair) {
    constexpr hl::Plain o{};
    const auto& [in, out] = pair;
    const PairAngles<double> angles{in.cos_theta(),  in.sin_theta(),  in.cos_phi(),  in.sin_phi(),
                                    out.cos_theta(), out.sin_theta(), out.cos_phi(), out.sin_phi()};
    const auto shape = pair_shape(o, surface.axes, angles);
    const auto width = [&](const Direction& w) HWY_ATTR {
        return static_cast<float>(
            slope_width(o, surface.axes, surface.slope_width, w.cos_phi(), w.sin_phi()) * w.sin_theta());
    };
    return {static_cast<float>(in.cos_theta()),   static_cast<float>(in.sin_theta()),  width(in),
            static_cast<float>(out.cos_theta()),  static_cast<float>(out.sin_theta()), width(out),
            static_cast<float>(shape.horizontal), static_cast<float>(shape.stretched)};
}

/// (x, y) along the axes of a surface, each times its factor: the length's square.
HWY_INLINE float squared_along_axes(const AxisTerms& axes, float x, float y, double along, double across) {
    constexpr hl::Plain o{};
    return static_cast<float>(squared_along_axes(o, axes, double{x}, double{y}, along, across));
}

/// Sums of floats that nearly cancel are exact.
HWY_INLINE SinglePair single_pair(const SingleSurface& surface, const VectorPair& pair) {
    const auto& [in, out] = pair;
    const AxisTerms& axes = surface.axes;
    const float x = in.x + out.x, y = in.y + out.y;
    const float horizontal = x * x + y * y;
    const float sine_in = std::sqrt(in.x * in.x + in.y * in.y);
    const float sine_out = std::sqrt(out.x * out.x + out.y * out.y);
    if (axes.isotropic) {
        const float width = surface.slope_width;
        return {in.z, sine_in, width * sine_in, out.z, sine_out, width * sine_out, horizontal, horizontal};
    }
    const auto width = [&axes](const Vector3f& w) HWY_ATTR {
        return std::sqrt(squared_along_axes(axes, w.x, w.y, axes.width_along, axes.width_across));
    };
    return {in.z,       sine_in,
            width(in),  out.z,
            sine_out,   width(out),
            horizontal, squared_along_axes(axes, x, y, axes.stretch_along, axes.stretch_across)};
}

HWY_INLINE bool is_ordinary_pair(const DirectionPair& pair) {
    return is_ordinary(pair);
}
HWY_INLINE bool is_ordinary_pair(const VectorPair& pair) {
    return pair.in.z >= lowest_single_cosine && pair.out.z >= lowest_single_cosine;
}

/// A pair's terms in every lane.
template <class Lanes>
HWY_INLINE PairTerms<typename Lanes::Real> terms_of_one(const Lanes& o, const SingleSurface& surface,
                                                        const SinglePair& pair) {
    constexpr hn::CappedTag<float, 2> two{};
    constexpr hl::WideLanes<hn::CappedTag<float, 2> > both;
    const auto in_and_out = [two](float a, float b)
                                HWY_ATTR { return hn::InterleaveLower(hn::Set(two, a), hn::Set(two, b)); };
    const auto s =
        seen_across(both, in_and_out(pair.cos_in, pair.cos_out), in_and_out(pair.sin_in, pair.sin_out),
                    in_and_out(pair.width_in, pair.width_out));
    const auto swapped = [two](auto v) HWY_ATTR { return hn::Reverse2(two, v); };
    const float coordinate = hn::GetLane(lambert_coordinate(both, s.obstruction + swapped(s.obstruction)));
    const auto w = one_plus_lambert(coordinate);
    const float over_w = hn::GetLane(hn::Reverse2(hn::FixedTag<float, 4>{}, w));
    const auto shadowing = (s.lit * swapped(s.lit)) / (s.reach * swapped(s.reach));
    const auto all = [](auto v) HWY_ATTR { return hn::Set(Lanes::d, hn::GetLane(v)); };
    const PairShape<typename Lanes::Real> shape{
        hn::Set(Lanes::d, pair.cos_in) + hn::Set(Lanes::d, pair.cos_out), hn::Set(Lanes::d, pair.horizontal),
        hn::Set(Lanes::d, pair.stretched)};
    return pair_terms(o, surface, shape, all(w), hn::Set(Lanes::d, surface.variance * over_w),
                      all(shadowing));
}

/// Terms of a block of pairs: a lane is a pair.
struct SingleBlock {
    static constexpr hn::CappedTag<float, 16> d{};
    using Lanes = hl::WideLanes<hn::CappedTag<float, 16> >;
    using V = hn::Vec<decltype(d)>;
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    HWY_ALIGN float cos_in[size], sin_in[size], width_in[size], cos_out[size], sin_out[size], width_out[size],
        horizontal[size], stretched[size];
    HWY_ALIGN float lambert[size], shadowing[size], one_plus_w[2 * size];
    HWY_ALIGN float variance[size], inverse_variance[size], argument[size], lobe[size], cos_squared[size];

    /// Fills whole vectors; those beyond `pairs` repeat its last. Whether all are ordinary.
    template <class Pair>
    HWY_INLINE bool load(const SingleSurface& surface, std::span<const Pair> pairs,
                         std::span<const Pair> next) {
        for (const Pair& pair : next) hwy::Prefetch(&pair);
        bool ordinary = true;
        for (std::size_t i = 0; i < whole(pairs.size()); ++i) {
            const Pair& pair = pairs[std::min(i, pairs.size() - 1)];
            const SinglePair of = single_pair(surface, pair);
            cos_in[i] = of.cos_in;
            sin_in[i] = of.sin_in;
            width_in[i] = of.width_in;
            cos_out[i] = of.cos_out;
            sin_out[i] = of.sin_out;
            width_out[i] = of.width_out;
            horizontal[i] = of.horizontal;
            stretched[i] = of.stretched;
            ordinary &= is_ordinary_pair(pair);
        }
        return ordinary;
    }
    static HWY_INLINE std::size_t whole(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

    HWY_INLINE void evaluate(const SingleSurface& surface, std::size_t count) {
        constexpr Lanes o{};
        const auto at = [](const float* a, std::size_t i) HWY_ATTR { return hn::Load(d, a + i); };
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto in = seen_across(o, at(cos_in, i), at(sin_in, i), at(width_in, i));
            const auto out = seen_across(o, at(cos_out, i), at(sin_out, i), at(width_out, i));
            hn::Store(lambert_coordinate(o, in.obstruction + out.obstruction), d, lambert + i);
            hn::Store((in.lit * out.lit) / (in.reach * out.reach), d, shadowing + i);
        }
        constexpr hn::FixedTag<float, 2> two;
        for (std::size_t i = 0; i < count; ++i)
            hn::Store(hn::LowerHalf(two, one_plus_lambert(lambert[i])), two, one_plus_w + 2 * i);
        for (std::size_t i = 0; i < count; i += lanes) {
            V w, over_w;
            hn::LoadInterleaved2(d, one_plus_w + 2 * i, w, over_w);
            const PairShape<V> shape{at(cos_in, i) + at(cos_out, i), at(horizontal, i), at(stretched, i)};
            const auto terms =
                pair_terms(o, surface, shape, w, o.real(surface.variance) * over_w, at(shadowing, i));
            hn::Store(terms.variance, d, variance + i);
            hn::Store(terms.inverse_variance, d, inverse_variance + i);
            hn::Store(terms.argument, d, argument + i);
            hn::Store(terms.lobe, d, lobe + i);
            hn::Store(terms.cos_squared, d, cos_squared + i);
        }
    }
};

// A function each for few wavelengths and for many, so that neither holds the other's constants.

template <class Lobe, class Pair, class Result>
HWY_ATTR HWY_NOINLINE void brdf_of_one_vector(const PreparedSingle& p, const Pair& pair, Result* result) {
    using Items = SingleSpectrum<4>;
    const auto terms = terms_of_one(Items::Lanes{}, p.surface, single_pair(p.surface, pair));
    const Items items{p, terms, 0};
    typename Lobe::template Block<Items> block{items};
    HWY_ALIGN float values[4] = {};
    hn::Store(block.one_vector() + items.load(PreparedSingle::uniform, 0), Items::d, values);
    std::copy_n(values, std::min(p.count, std::size_t{4}), result);
}

template <class Lobe, class Pair, class Result>
HWY_ATTR HWY_NOINLINE void brdf_of_one(const PreparedSingle& p, const Pair& pair, Result* result) {
    using Items = SingleSpectrum<8>;
    using Block = typename Lobe::template Block<Items>;
    const auto terms = terms_of_one(Items::Lanes{}, p.surface, single_pair(p.surface, pair));
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
        const Items items{p, terms, first};
        Block block{items};
        block.prepare((count + Items::lanes - 1) / Items::lanes * Items::lanes);
        for (std::size_t i = 0; i < count; i += Items::lanes) {
            HWY_ALIGN float values[Items::lanes] = {};
            hn::Store(block.value(i) + items.load(PreparedSingle::uniform, i), Items::d, values);
            std::copy_n(values, std::min(Items::lanes, count - i), result + first + i);
        }
    }
}

template <class Lobe, class Pair, class Result>
HWY_ATTR bool brdf_one(const PreparedSingle& p, const Pair& pair, Result* result) {
    if (HWY_UNLIKELY(!is_ordinary_pair(pair))) return false;
    if (p.count <= 4)
        brdf_of_one_vector<Lobe>(p, pair, result);
    else
        brdf_of_one<Lobe>(p, pair, result);
    return true;
}

/// A block of pairs at one wavelength.
template <class Lobe>
HWY_ATTR HWY_NOINLINE void values_at(const PreparedSingle& p, const SingleBlock& pairs, std::size_t j,
                                     std::size_t count, float* values) {
    const SinglePairs<SingleBlock> items{pairs, p, j};
    typename Lobe::template Block<SinglePairs<SingleBlock> > lobes{items};
    lobes.prepare(count);
    const auto uniform = hn::Set(SingleBlock::d, p[PreparedSingle::uniform][j]);
    for (std::size_t i = 0; i < count; i += SingleBlock::lanes)
        hn::Store(lobes.value(i) + uniform, SingleBlock::d, values + i);
}

template <class Lobe, class Pair, class Result>
HWY_ATTR bool brdf_many(const PreparedSingle& p, std::span<const Pair> pairs, Result* result) {
    bool ordinary = true;
    if (pairs.size() < fewest_pairs(p.count, SingleBlock::lanes)) {
        for (const Pair& pair : pairs) {
            ordinary &= brdf_one<Lobe>(p, pair, result);
            result += p.count;
        }
        return ordinary;
    }
    constexpr std::size_t size = SingleBlock::size;
    for (std::size_t first = 0; first < pairs.size(); first += size) {
        const auto from = [pairs, size](std::size_t at) {
            const std::size_t begin = std::min(at, pairs.size());
            return pairs.subspan(begin, std::min(size, pairs.size() - begin));
        };
        const auto here = from(first);
        SingleBlock block;
        ordinary &= block.load(p.surface, here, from(first + size));
        const std::size_t count = SingleBlock::whole(here.size());
        block.evaluate(p.surface, count);
        HWY_ALIGN float values[size];
        Result* const to = result + first * p.count;
        for (std::size_t j = 0; j < p.count; ++j) {
            values_at<Lobe>(p, block, j, count, values);
            for (std::size_t i = 0; i < here.size(); ++i) to[i * p.count + j] = values[i];
        }
    }
    return ordinary;
}

struct SingleFull {
    template <class Items>
    using Block = phi_detail::HWY_NAMESPACE::PhiBlock<phi_detail::Low, Items>;
};
struct SingleFirstOrder {
    template <class Items>
    using Block = FirstOrderBlock<Items>;
};
struct SingleRoughLimit {
    template <class Items>
    using Block = RoughLimitBlock<Items>;
};

template <class Lobe>
SingleForms single_forms_of() {
    return {brdf_one<Lobe, DirectionPair, double>, brdf_one<Lobe, VectorPair, float>,
            brdf_many<Lobe, DirectionPair, double>, brdf_many<Lobe, VectorPair, float>};
}
SingleFormTable single_form_table() {
    return {single_forms_of<SingleFull>(), single_forms_of<SingleFirstOrder>(),
            single_forms_of<SingleRoughLimit>()};
}

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::evaluation_detail {

bool fits_single(const Surface& surface, std::span<const SpectralSample> samples) noexcept {
    const auto length = [](double x) { return x >= 1e-3 && x <= 1e4; };
    const auto& [along, across] = surface.correlation_lengths();
    return !surface.correlation() && is_ordinary(surface, samples) && length(surface.rms_roughness()) &&
           length(along) && length(across) && std::ranges::all_of(samples, [](const SpectralSample& s) {
               const double wavelength = s.wavelength.micrometres();
               const auto columns = index_columns(s);
               const bool reflects_all =
                   columns.d_real < 0 && columns.d_imaginary_squared < 1e-6 * columns.d_real * columns.d_real;
               return wavelength >= 0.05 && wavelength <= 1e3 && s.index.substrate().n() <= 1e3 &&
                      s.index.substrate().k() <= 1e3 && (s.index.coated() || !reflects_all);
           });
}

HWY_EXPORT(single_form_table);

SingleForms single_forms(DiffuseLobe lobe) noexcept {
    const SingleFormTable table = HWY_DYNAMIC_DISPATCH(single_form_table)();
    switch (lobe) {
        case DiffuseLobe::first_order:
            return table.first_order;
        case DiffuseLobe::rough_limit:
            return table.rough_limit;
        default:
            return table.full;
    }
}

}  // namespace hts::evaluation_detail
#endif
