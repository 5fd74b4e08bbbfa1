// The spectral evaluation, compiled for every instruction set and chosen at run time.
#include "hts/evaluation_simd.hpp"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/evaluation_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/evaluation_kernel-inl.hpp"
#include "hts/evaluation_lobes-inl.hpp"
#include "hts/evaluation_pairs-inl.hpp"
#include "hts/evaluation_turns-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // no vectors, as on x86 before SSSE3: the exact path

Forms forms_low() {
    return {};
}
Forms forms_medium() {
    return {};
}

#else

/// A pair's terms in every lane.
template <class Lanes>
HWY_INLINE PairTerms<typename Lanes::Real> terms_of_one(const Lanes& o, const SurfaceTerms& surface,
                                                        const DirectionPair& pair) {
    constexpr auto two = phi::two;
    constexpr hl::WideLanes<std::remove_const_t<decltype(two)> > both;
    const auto& [in, out] = pair;
    const auto in_and_out = [two](double a, double b)
                                HWY_ATTR { return hn::InterleaveLower(hn::Set(two, a), hn::Set(two, b)); };
    const auto s = seen(both, in_and_out(in.cos_theta(), out.cos_theta()),
                        in_and_out(in.sin_theta(), out.sin_theta()), both.real(surface.slope_width));
    const auto swapped = [two](auto v) HWY_ATTR { return hn::Reverse2(two, v); };
    const double v = hn::GetLane(lambert_coordinate(both, s.obstruction + swapped(s.obstruction)));
    const double shadowing = hn::GetLane((s.lit * swapped(s.lit)) / (s.reach * swapped(s.reach)));
    const PairAngles<typename Lanes::Real> angles{
        o.real(in.cos_theta()),  o.real(in.sin_theta()),  o.real(in.cos_phi()),  o.real(in.sin_phi()),
        o.real(out.cos_theta()), o.real(out.sin_theta()), o.real(out.cos_phi()), o.real(out.sin_phi())};
    return pair_terms(o, surface, angles, o.real(one_plus_lambert(v)), o.real(shadowing));
}

/// Items of one pair: a lane is a wavelength.
template <class Spec, std::size_t most_lanes>
HWY_INLINE void brdf_of_one(const Prepared& p, const DirectionPair& pair, double* result) {
    using Block = Lobes<Spec, most_lanes>;
    using V = typename Block::V;
    constexpr auto d = Block::d;
    constexpr typename Block::Lanes o{};
    const PairTerms<V> terms = terms_of_one(o, p.surface, pair);
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
        Block block;
        for (std::size_t i = 0; i < count; i += Block::lanes) {
            const std::size_t j = first + i;
            const V wave = hn::LoadU(d, p[Prepared::wave_squared] + j);
            const auto fresnel =
                fresnel_terms(o, terms.cos_squared,
                              IndexTerms<V>{hn::LoadU(d, p[Prepared::d_real] + j),
                                            hn::LoadU(d, p[Prepared::d_imaginary_squared] + j)});
            block.place(i, terms.variance * wave, terms.argument * wave,
                        terms.inverse_variance * hn::LoadU(d, p[Prepared::inverse_wave_squared] + j),
                        unpolarised(terms.lobe * hn::LoadU(d, p[Prepared::weight] + j), fresnel));
        }
        block.add_polynomials((count + Block::lanes - 1) / Block::lanes * Block::lanes);
        for (std::size_t i = 0; i < count; i += Block::lanes) {
            const V value = block.value(i) + hn::LoadU(d, p[Prepared::uniform] + first + i);
            if (HWY_LIKELY(i + Block::lanes <= count)) {
                hn::StoreU(value, d, result + first + i);
            } else {
                HWY_ALIGN double rest[Block::lanes];
                hn::Store(value, d, rest);
                std::copy_n(rest, count - i, result + first + i);
            }
        }
    }
}

/// The same where the wavelengths fit one vector.
template <class Spec>
HWY_INLINE void brdf_of_one_vector(const Prepared& p, const DirectionPair& pair, double* result) {
    using Block = Lobes<Spec, 4>;
    using V = typename Block::V;
    constexpr auto d = Block::d;
    constexpr typename Block::Lanes o{};
    const PairTerms<V> terms = terms_of_one(o, p.surface, pair);
    const V wave = hn::LoadU(d, p[Prepared::wave_squared]);
    const auto fresnel = fresnel_terms(
        o, terms.cos_squared,
        IndexTerms<V>{hn::LoadU(d, p[Prepared::d_real]), hn::LoadU(d, p[Prepared::d_imaginary_squared])});
    Block block;
    const V lobe = block.one_vector(terms.variance * wave, terms.argument * wave,
                                    terms.inverse_variance * hn::LoadU(d, p[Prepared::inverse_wave_squared]),
                                    unpolarised(terms.lobe * hn::LoadU(d, p[Prepared::weight]), fresnel));
    const V value = lobe + hn::LoadU(d, p[Prepared::uniform]);
    if (HWY_LIKELY(p.count == Block::lanes)) {
        hn::StoreU(value, d, result);
    } else {
        HWY_ALIGN double whole[Block::lanes];
        hn::Store(value, d, whole);
        std::copy_n(whole, p.count, result);
    }
}

template <class Spec>
HWY_ATTR bool brdf_one(const Prepared& p, const DirectionPair& pair, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= Lobes<Spec, 4>::lanes)
        brdf_of_one_vector<Spec>(p, pair, result);
    else
        brdf_of_one<Spec, 8>(p, pair, result);
    return true;
}

template <class Spec, std::size_t most_lanes>
HWY_INLINE void mueller_of_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    using Block = Lobes<Spec, most_lanes>;
    using V = typename Block::V;
    constexpr auto d = Block::d;
    constexpr typename Block::Lanes o{};
    const PairTerms<V> terms = terms_of_one(o, p.surface, pair);
    const TurnedMueller turned{turns(pair)};
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
        Block block;
        HWY_ALIGN double diagonal[Block::size], beside[Block::size], real[Block::size],
            imaginary[Block::size];
        for (std::size_t i = 0; i < count; i += Block::lanes) {
            const std::size_t j = first + i;
            const V wave = hn::LoadU(d, p[Prepared::wave_squared] + j);
            const auto fresnel =
                fresnel_terms(o, terms.cos_squared,
                              IndexTerms<V>{hn::LoadU(d, p[Prepared::d_real] + j),
                                            hn::LoadU(d, p[Prepared::d_imaginary_squared] + j)});
            block.place(i, terms.variance * wave, terms.argument * wave,
                        terms.inverse_variance * hn::LoadU(d, p[Prepared::inverse_wave_squared] + j),
                        terms.lobe * hn::LoadU(d, p[Prepared::weight] + j) /
                            (fresnel.s_below * fresnel.s_below * fresnel.p_below));
            const auto m = fresnel_mueller(o, fresnel);
            hn::Store(m.p, d, diagonal + i);
            hn::Store(m.q, d, beside + i);
            hn::Store(m.real, d, real + i);
            hn::Store(m.imaginary, d, imaginary + i);
        }
        block.add_polynomials((count + Block::lanes - 1) / Block::lanes * Block::lanes);
        for (std::size_t i = 0; i < count; i += Block::lanes) {
            const V lobe = block.value(i);
            for (double* a : {diagonal, beside, real, imaginary})
                hn::Store(hn::Load(d, a + i) * lobe, d, a + i);
        }
        for (std::size_t i = 0; i < count; ++i) {
            turned.store(diagonal[i], beside[i], real[i], imaginary[i], p[Prepared::uniform][first + i],
                         reinterpret_cast<double*>(result + first + i));
        }
    }
}

template <class Spec>
HWY_ATTR bool mueller_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= 4)
        mueller_of_one<Spec, 4>(p, pair, result);
    else
        mueller_of_one<Spec, 8>(p, pair, result);
    return true;
}

template <class Spec>
HWY_INLINE bool brdf_of_block(const Prepared& p, std::span<const DirectionPair> pairs,
                              std::span<const DirectionPair> next, double* result) {
    using Block = Lobes<Spec, 8>;
    using V = typename Block::V;
    constexpr auto d = Block::d;
    constexpr typename Block::Lanes o{};
    PairBlock block;
    const bool ordinary = block.load(pairs, next);
    const std::size_t count = (pairs.size() + Block::lanes - 1) / Block::lanes * Block::lanes;
    block.evaluate(p.surface, count);
    for (std::size_t j = 0; j < p.count; ++j) {
        Block lobes;
        const V wave = o.real(p[Prepared::wave_squared][j]);
        const V inverse_wave = o.real(p[Prepared::inverse_wave_squared][j]);
        const IndexTerms<V> index{o.real(p[Prepared::d_real][j]),
                                  o.real(p[Prepared::d_imaginary_squared][j])};
        const V weight = o.real(p[Prepared::weight][j]);
        const V uniform = o.real(p[Prepared::uniform][j]);
        for (std::size_t i = 0; i < count; i += Block::lanes) {
            const auto fresnel = fresnel_terms(o, hn::Load(d, block.cos_squared + i), index);
            lobes.place(i, hn::Load(d, block.variance + i) * wave, hn::Load(d, block.argument + i) * wave,
                        hn::Load(d, block.inverse_variance + i) * inverse_wave,
                        unpolarised(hn::Load(d, block.lobe + i) * weight, fresnel));
        }
        lobes.add_polynomials(count);
        HWY_ALIGN double values[Block::size];
        for (std::size_t i = 0; i < count; i += Block::lanes)
            hn::Store(lobes.value(i) + uniform, d, values + i);
        for (std::size_t i = 0; i < pairs.size(); ++i) result[i * p.count + j] = values[i];
    }
    return ordinary;
}

template <class Spec>
HWY_ATTR bool brdf_many(const Prepared& p, std::span<const DirectionPair> pairs, double* result) {
    bool ordinary = true;
    constexpr std::size_t size = PairBlock::size;
    for (std::size_t first = 0; first < pairs.size(); first += size) {
        const auto block = [pairs, size](std::size_t at) {
            const std::size_t begin = std::min(at, pairs.size());
            return pairs.subspan(begin, std::min(size, pairs.size() - begin));
        };
        ordinary &= brdf_of_block<Spec>(p, block(first), block(first + size), result + first * p.count);
    }
    return ordinary;
}

Forms forms_low() {
    return {brdf_one<phi_detail::Low>, brdf_many<phi_detail::Low>, mueller_one<phi_detail::Low>};
}
Forms forms_medium() {
    return {brdf_one<phi_detail::Medium>, brdf_many<phi_detail::Medium>, mueller_one<phi_detail::Medium>};
}

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::evaluation_detail {

HWY_EXPORT(forms_low);
HWY_EXPORT(forms_medium);

Forms forms(Tolerance tolerance) noexcept {
    // leaves the low form of Phi room for the rounding of the rest
    const bool low = tolerance.relative_error() >= phi_detail::Low::error;
    return low ? HWY_DYNAMIC_DISPATCH(forms_low)() : HWY_DYNAMIC_DISPATCH(forms_medium)();
}

}  // namespace hts::evaluation_detail
#endif
