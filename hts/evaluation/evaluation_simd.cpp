// The spectral evaluation, compiled for every instruction set and chosen at run time.
#include "hts/evaluation/evaluation_simd.hpp"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/evaluation/evaluation_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/evaluation/kernel-inl.hpp"
#include "hts/evaluation/limits-inl.hpp"
#include "hts/evaluation/pairs-inl.hpp"
#include "hts/evaluation/seen-inl.hpp"
#include "hts/evaluation/turns-inl.hpp"
#include "hts/phi/phi_block-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace phi = phi_detail::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // no vectors, as on x86 before SSSE3: the exact path

FormTable form_table() {
    return {};
}

#else

/// A pair's terms in every lane.
template <class Lanes>
HWY_INLINE PairTerms<typename Lanes::Real> terms_of_one(const Lanes& o, const SurfaceTerms& surface,
                                                        const DirectionPair& pair) {
    constexpr auto two = hl::two;
    constexpr hl::WideLanes<std::remove_const_t<decltype(two)> > both;
    const auto& [in, out] = pair;
    const auto in_and_out = [two](double a, double b)
                                HWY_ATTR { return hn::InterleaveLower(hn::Set(two, a), hn::Set(two, b)); };
    const auto s =
        seen(both, in_and_out(in.cos_theta(), out.cos_theta()), in_and_out(in.sin_theta(), out.sin_theta()),
             slope_width(both, surface.axes, surface.slope_width, in_and_out(in.cos_phi(), out.cos_phi()),
                         in_and_out(in.sin_phi(), out.sin_phi())));
    const auto swapped = [two](auto v) HWY_ATTR { return hn::Reverse2(two, v); };
    const double v = hn::GetLane(lambert_coordinate(both, s.obstruction + swapped(s.obstruction)));
    const double shadowing = hn::GetLane((s.lit * swapped(s.lit)) / (s.reach * swapped(s.reach)));
    const PairAngles<typename Lanes::Real> angles{
        o.real(in.cos_theta()),  o.real(in.sin_theta()),  o.real(in.cos_phi()),  o.real(in.sin_phi()),
        o.real(out.cos_theta()), o.real(out.sin_theta()), o.real(out.cos_phi()), o.real(out.sin_phi())};
    return pair_terms(o, surface, angles, o.real(one_plus_lambert(v)), o.real(shadowing));
}

/// The same at every wavelength.
template <class Lanes>
struct SharedTerms {
    PairTerms<typename Lanes::Real> all;

    HWY_INLINE SharedTerms(const Prepared& p, const DirectionPair& pair)
        : all{terms_of_one(Lanes{}, p.surface, pair)} {}
    HWY_INLINE void prepare(std::size_t, std::size_t) const {}
    HWY_INLINE const PairTerms<typename Lanes::Real>& operator[](std::size_t) const { return all; }
};

/// Items of one pair from a wavelength on: a lane is a wavelength.
template <std::size_t most_lanes, class Lobe>
struct Spectrum {
    static constexpr hn::CappedTag<double, most_lanes> d{};
    using Lanes = hl::WideLanes<hn::CappedTag<double, most_lanes> >;
    using V = hn::Vec<decltype(d)>;
    static constexpr std::size_t lanes = hn::MaxLanes(d);
    using Terms = typename Lobe::template Terms<Lanes>;

    const Prepared& p;
    const Terms& terms;
    std::size_t first;

    HWY_INLINE V load(Prepared::Column column, std::size_t i) const {
        return hn::LoadU(d, p[column] + first + i);
    }
    HWY_INLINE FresnelTerms<V> fresnel(std::size_t i) const {
        return fresnel_terms(
            Lanes{}, terms[i].cos_squared,
            IndexTerms<V>{load(Prepared::d_real, i), load(Prepared::d_imaginary_squared, i)});
    }
    HWY_INLINE V g(std::size_t i) const { return terms[i].variance * load(Prepared::wave_squared, i); }
    HWY_INLINE V t(std::size_t i) const { return terms[i].argument * load(Prepared::wave_squared, i); }
    HWY_INLINE V inverse_g(std::size_t i) const {
        return terms[i].inverse_variance * load(Prepared::inverse_wave_squared, i);
    }
    HWY_INLINE V scale(std::size_t i) const {
        return unpolarised(terms[i].lobe * load(Prepared::weight, i), fresnel(i));
    }
};

/// The same with the Fresnel terms that a Mueller matrix multiplies left out.
template <std::size_t most_lanes, class Lobe>
struct PolarisedSpectrum : Spectrum<most_lanes, Lobe> {
    using V = typename Spectrum<most_lanes, Lobe>::V;
    HWY_INLINE V scale(std::size_t i) const {
        const auto f = this->fresnel(i);
        return this->terms[i].lobe * this->load(Prepared::weight, i) / (f.s_below * f.s_below * f.p_below);
    }
};

/// The first `count` of a vector, to `to`.
template <class D>
HWY_INLINE void store_some(hn::Vec<D> value, D d, std::size_t count, double* to) {
    if (HWY_LIKELY(count >= hn::MaxLanes(d))) {
        hn::StoreU(value, d, to);
    } else {
        HWY_ALIGN double whole[hn::MaxLanes(d)];
        hn::Store(value, d, whole);
        std::copy_n(whole, count, to);
    }
}

// A function each for few wavelengths and for many, so that neither holds the other's constants.

template <class Lobe>
HWY_ATTR HWY_NOINLINE void brdf_of_one(const Prepared& p, const DirectionPair& pair, double* result) {
    using Items = Spectrum<8, Lobe>;
    using Block = typename Lobe::template Block<8, Items>;
    typename Items::Terms terms{p, pair};
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
        terms.prepare(first, count);
        const Items items{p, terms, first};
        Block block{items};
        block.prepare((count + Items::lanes - 1) / Items::lanes * Items::lanes);
        for (std::size_t i = 0; i < count; i += Items::lanes)
            store_some(block.value(i) + items.load(Prepared::uniform, i), Items::d, count - i,
                       result + first + i);
    }
}

/// The same where the wavelengths fit one vector.
template <class Lobe>
HWY_ATTR HWY_NOINLINE void brdf_of_one_vector(const Prepared& p, const DirectionPair& pair, double* result) {
    using Items = Spectrum<4, Lobe>;
    typename Items::Terms terms{p, pair};
    terms.prepare(0, p.count);
    const Items items{p, terms, 0};
    typename Lobe::template Block<4, Items> block{items};
    store_some(block.one_vector() + items.load(Prepared::uniform, 0), Items::d, p.count, result);
}

template <class Lobe>
HWY_ATTR bool brdf_one(const Prepared& p, const DirectionPair& pair, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= Spectrum<4, Lobe>::lanes)
        brdf_of_one_vector<Lobe>(p, pair, result);
    else
        brdf_of_one<Lobe>(p, pair, result);
    return true;
}

template <class Lobe, std::size_t most_lanes>
HWY_INLINE void mueller_of_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    using Items = PolarisedSpectrum<most_lanes, Lobe>;
    using Block = typename Lobe::template Block<most_lanes, Items>;
    constexpr auto d = Items::d;
    typename Items::Terms terms{p, pair};
    const TurnedMueller turned{turns(pair)};
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
        terms.prepare(first, count);
        const Items items{{p, terms, first}};
        Block block{items};
        block.prepare((count + Items::lanes - 1) / Items::lanes * Items::lanes);
        HWY_ALIGN double diagonal[Block::size], beside[Block::size], real[Block::size],
            imaginary[Block::size];
        for (std::size_t i = 0; i < count; i += Items::lanes) {
            const auto m = fresnel_mueller(typename Items::Lanes{}, items.fresnel(i));
            const auto lobe = block.value(i);
            hn::Store(m.p * lobe, d, diagonal + i);
            hn::Store(m.q * lobe, d, beside + i);
            hn::Store(m.real * lobe, d, real + i);
            hn::Store(m.imaginary * lobe, d, imaginary + i);
        }
        for (std::size_t i = 0; i < count; ++i) {
            turned.store(diagonal[i], beside[i], real[i], imaginary[i], p[Prepared::uniform][first + i],
                         reinterpret_cast<double*>(result + first + i));
        }
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

/// |F|^2 exp(-g) S of a direction and its mirror direction: a pair's terms without the lobe.
template <class Lobe, std::size_t most_lanes>
HWY_INLINE void specular_of_one(const Prepared& p, const Direction& in, double* result) {
    using Items = Spectrum<most_lanes, Lobe>;
    constexpr typename Items::Lanes o{};
    typename Items::Terms terms{p, {in, in.mirror()}};
    for (std::size_t i = 0; i < p.count; i += Items::lanes) {
        terms.prepare(i, Items::lanes);
        // at theta_r = theta_i the lobe's factor is tau^2/(4 pi) S
        const auto shadowing = terms[0].lobe * o.real(4 / p.surface.tau_squared_over_pi);
        const Items items{p, terms, i};
        const auto scale =
            shadowing * items.load(Prepared::weight, 0) * items.load(Prepared::inverse_wave_squared, 0);
        store_some(scaled_exp_of_minus(o, items.g(0), unpolarised(scale, items.fresnel(0))), Items::d,
                   p.count - i, result + i);
    }
}

template <class Lobe>
HWY_ATTR bool specular_one(const Prepared& p, const Direction& in, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(in))) return false;
    if (p.count <= Spectrum<4, Lobe>::lanes)
        specular_of_one<Lobe, 4>(p, in, result);
    else
        specular_of_one<Lobe, 8>(p, in, result);
    return true;
}

/// Items of one wavelength: a lane is a pair.
struct Pairs {
    static constexpr auto d = PairBlock::d;
    using V = PairBlock::V;

    const PairBlock& block;
    const Prepared& p;
    V wave_squared, inverse_wave_squared, weight;
    IndexTerms<V> index;

    HWY_INLINE Pairs(const PairBlock& of, const Prepared& prepared, std::size_t j)
        : block{of},
          p{prepared},
          wave_squared{hn::Set(d, p[Prepared::wave_squared][j])},
          inverse_wave_squared{hn::Set(d, p[Prepared::inverse_wave_squared][j])},
          weight{hn::Set(d, p[Prepared::weight][j])},
          index{hn::Set(d, p[Prepared::d_real][j]), hn::Set(d, p[Prepared::d_imaginary_squared][j])} {}

    HWY_INLINE V g(std::size_t i) const { return hn::Load(d, block.variance + i) * wave_squared; }
    HWY_INLINE V t(std::size_t i) const { return hn::Load(d, block.argument + i) * wave_squared; }
    HWY_INLINE V inverse_g(std::size_t i) const {
        return hn::Load(d, block.inverse_variance + i) * inverse_wave_squared;
    }
    HWY_INLINE V scale(std::size_t i) const {
        return unpolarised(hn::Load(d, block.lobe + i) * weight,
                           fresnel_terms(PairBlock::Lanes{}, hn::Load(d, block.cos_squared + i), index));
    }
};

template <class Lobe>
HWY_INLINE bool brdf_of_block(const Prepared& p, std::span<const DirectionPair> pairs,
                              std::span<const DirectionPair> next, double* result) {
    constexpr auto d = PairBlock::d;
    constexpr std::size_t lanes = PairBlock::lanes;
    PairBlock block;
    const bool ordinary = block.load(pairs, next);
    const std::size_t count = (pairs.size() + lanes - 1) / lanes * lanes;
    typename Lobe::Pairs seen{block, p.surface, count};
    for (std::size_t j = 0; j < p.count; ++j) {
        seen.see(p, j, count);
        const Pairs items{block, p, j};
        typename Lobe::template Block<8, Pairs> lobes{items};
        lobes.prepare(count);
        HWY_ALIGN double values[PairBlock::size];
        const auto uniform = hn::Set(d, p[Prepared::uniform][j]);
        for (std::size_t i = 0; i < count; i += lanes) hn::Store(lobes.value(i) + uniform, d, values + i);
        for (std::size_t i = 0; i < pairs.size(); ++i) result[i * p.count + j] = values[i];
    }
    return ordinary;
}

template <class Lobe>
HWY_ATTR bool brdf_many(const Prepared& p, std::span<const DirectionPair> pairs, double* result) {
    bool ordinary = true;
    if (pairs.size() < fewest_pairs(p.count, PairBlock::lanes)) {
        for (const DirectionPair& pair : pairs) {
            ordinary &= brdf_one<Lobe>(p, pair, result);
            result += p.count;
        }
        return ordinary;
    }
    constexpr std::size_t size = PairBlock::size;
    for (std::size_t first = 0; first < pairs.size(); first += size) {
        const auto block = [pairs, size](std::size_t at) {
            const std::size_t begin = std::min(at, pairs.size());
            return pairs.subspan(begin, std::min(size, pairs.size() - begin));
        };
        ordinary &= brdf_of_block<Lobe>(p, block(first), block(first + size), result + first * p.count);
    }
    return ordinary;
}

/// Lobes of the Gaussian correlation: what a pair contributes is the same at every wavelength.
struct OfSurface {
    using Pairs = SharedPairs;
    template <class Lanes>
    using Terms = SharedTerms<Lanes>;
};
/// Phi in full, as a Spec's table has it.
template <class Spec>
struct Full : OfSurface {
    template <std::size_t most_lanes, class Items>
    using Block = phi::PhiBlock<Spec, Items>;
};
struct FirstOrder : OfSurface {
    template <std::size_t most_lanes, class Items>
    using Block = FirstOrderBlock<Items>;
};
struct RoughLimit : OfSurface {
    template <std::size_t most_lanes, class Items>
    using Block = RoughLimitBlock<Items>;
};
/// 2 D of another correlation.
struct Correlated {
    using Pairs = SeenPairs;
    template <class Lanes>
    using Terms = SeenTerms<Lanes>;
    template <std::size_t most_lanes, class Items>
    using Block = CorrelatedBlock<most_lanes, Items>;
};

template <class Lobe>
Forms forms_of() {
    return {brdf_one<Lobe>, brdf_many<Lobe>, mueller_one<Lobe>, specular_one<Lobe>};
}
FormTable form_table() {
    return {forms_of<Full<phi_detail::Low> >(), forms_of<Full<phi_detail::Medium> >(), forms_of<FirstOrder>(),
            forms_of<RoughLimit>(), forms_of<Correlated>()};
}

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::evaluation_detail {

HWY_EXPORT(form_table);

Forms forms(Tolerance tolerance, DiffuseLobe lobe, bool correlated) noexcept {
    const FormTable table = HWY_DYNAMIC_DISPATCH(form_table)();
    if (correlated) return table.correlated;
    switch (lobe) {
        case DiffuseLobe::first_order:
            return table.first_order;
        case DiffuseLobe::rough_limit:
            return table.rough_limit;
        default:
            // leaves the low form of Phi room for the rounding of the rest
            return tolerance.relative_error() >= phi_detail::Low::error ? table.low : table.medium;
    }
}

}  // namespace hts::evaluation_detail
#endif
