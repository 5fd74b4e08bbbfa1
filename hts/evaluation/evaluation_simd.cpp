// The spectral evaluation, compiled for every instruction set and chosen at run time.
#include "hts/evaluation/evaluation_simd.hpp"

#include <algorithm>
#include <string>
#include <type_traits>

#include "hts/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/evaluation/evaluation_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/evaluation/items-inl.hpp"
#include "hts/evaluation/pairs-inl.hpp"
#include "hts/evaluation/turns-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

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
    const auto w = o.real(one_plus_lambert(v));
    return pair_terms(o, surface, pair_shape(o, surface.axes, angles), w, o.real(surface.variance) / w,
                      o.real(shadowing));
}

/// The same with the Fresnel terms that a Mueller matrix multiplies left out.
template <std::size_t most_lanes>
struct PolarisedSpectrum : Spectrum<double, most_lanes> {
    using V = typename Spectrum<double, most_lanes>::V;
    HWY_INLINE V scale(std::size_t i) const {
        const auto f = this->fresnel(i);
        return this->terms.lobe * this->load(Prepared::weight, i) / (f.s_below * f.s_below * f.p_below);
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
    using Items = Spectrum<double, 8>;
    using Block = typename Lobe::template Block<Items>;
    const auto terms = terms_of_one(Items::Lanes{}, p.surface, pair);
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
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
    using Items = Spectrum<double, 4>;
    const auto terms = terms_of_one(Items::Lanes{}, p.surface, pair);
    const Items items{p, terms, 0};
    typename Lobe::template Block<Items> block{items};
    store_some(block.one_vector() + items.load(Prepared::uniform, 0), Items::d, p.count, result);
}

template <class Lobe>
HWY_ATTR bool brdf_one(const Prepared& p, const DirectionPair& pair, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(pair))) return false;
    if (p.count <= Spectrum<double, 4>::lanes)
        brdf_of_one_vector<Lobe>(p, pair, result);
    else
        brdf_of_one<Lobe>(p, pair, result);
    return true;
}

template <class Lobe, std::size_t most_lanes>
HWY_INLINE void mueller_of_one(const Prepared& p, const DirectionPair& pair, Mueller* result) {
    using Items = PolarisedSpectrum<most_lanes>;
    using Block = typename Lobe::template Block<Items>;
    constexpr auto d = Items::d;
    const auto terms = terms_of_one(typename Items::Lanes{}, p.surface, pair);
    const TurnedMueller turned{turns(pair)};
    for (std::size_t first = 0; first < p.count; first += Block::size) {
        const std::size_t count = std::min(Block::size, p.count - first);
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
template <std::size_t most_lanes>
HWY_INLINE void specular_of_one(const Prepared& p, const Direction& in, double* result) {
    using Items = Spectrum<double, most_lanes>;
    constexpr typename Items::Lanes o{};
    const auto terms = terms_of_one(o, p.surface, {in, in.mirror()});
    // at theta_r = theta_i the lobe's factor is tau^2/(4 pi) S
    const auto shadowing = terms.lobe * o.real(4 / p.surface.tau_squared_over_pi);
    for (std::size_t i = 0; i < p.count; i += Items::lanes) {
        const Items items{p, terms, i};
        const auto scale =
            shadowing * items.load(Prepared::weight, 0) * items.load(Prepared::inverse_wave_squared, 0);
        store_some(scaled_exp_of_minus(o, items.g(0), unpolarised(scale, items.fresnel(0))), Items::d,
                   p.count - i, result + i);
    }
}

HWY_ATTR bool specular_one(const Prepared& p, const Direction& in, double* result) {
    if (HWY_UNLIKELY(!is_ordinary(in))) return false;
    if (p.count <= Spectrum<double, 4>::lanes)
        specular_of_one<4>(p, in, result);
    else
        specular_of_one<8>(p, in, result);
    return true;
}

template <class Lobe>
HWY_INLINE bool brdf_of_block(const Prepared& p, std::span<const DirectionPair> pairs,
                              std::span<const DirectionPair> next, double* result) {
    constexpr auto d = PairBlock::d;
    constexpr std::size_t lanes = PairBlock::lanes;
    PairBlock block;
    const bool ordinary = block.load(pairs, next);
    const std::size_t count = (pairs.size() + lanes - 1) / lanes * lanes;
    block.evaluate(p.surface, count);
    for (std::size_t j = 0; j < p.count; ++j) {
        const Pairs<PairBlock> items{block, p, j};
        typename Lobe::template Block<Pairs<PairBlock> > lobes{items};
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

template <class Lobe>
Forms forms_of() {
    return {brdf_one<Lobe>, brdf_many<Lobe>, mueller_one<Lobe>, specular_one};
}
FormTable form_table() {
    return {forms_of<Full<phi_detail::Medium> >(), forms_of<FirstOrder>(), forms_of<RoughLimit>()};
}

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::evaluation_detail {

AxisTerms axis_terms(const Surface& surface) noexcept {
    const auto& [along, across] = surface.correlation_lengths();
    const double height = 2 * surface.rms_roughness(), mean = surface.correlation_length();
    return {surface.isotropic(), surface.axis().cos_phi(), surface.axis().sin_phi(),
            height / along,      height / across,          along / mean,
            across / mean};
}

bool is_ordinary(const Surface& surface, std::span<const SpectralSample> samples) noexcept {
    const auto length = [](double x) { return x >= 1e-6 && x <= 1e6; };
    const auto& [along, across] = surface.correlation_lengths();
    return !surface.correlation() && length(surface.rms_roughness()) && length(along) && length(across) &&
           std::all_of(samples.begin(), samples.end(), [&](const SpectralSample& s) {
               return length(s.wavelength.micrometres()) && s.index.substrate().n() >= 1e-3 &&
                      s.index.substrate().n() <= 1e6 && s.index.substrate().k() <= 1e6;
           });
}

std::vector<Surface> seen_surfaces(const Surface& surface, std::span<const SpectralSample> samples,
                                   DiffuseLobe lobe) {
    if (!surface.correlation()) return {};
    if (lobe == DiffuseLobe::rough_limit) {
        throw Error{
            "lobe rough_limit of a correlation that is not gaussian: must be full, first_order or none"};
    }
    std::vector<Surface> seen;
    seen.reserve(samples.size());
    for (const SpectralSample& sample : samples) {
        const double k_sigma = sample.wavelength.wave_number() * surface.rms_roughness();
        if (4 * k_sigma * k_sigma > Correlation::most_phase_variance) {
            throw Error{"rms roughness " + shortest(surface.rms_roughness()) + " um at the wavelength " +
                        shortest(sample.wavelength.micrometres()) +
                        " um: must be at most 795 wavelengths where the correlation is not gaussian"};
        }
        seen.push_back(surface.seen_by(sample.wavelength));
    }
    if (lobe == DiffuseLobe::full && surface.rms_roughness() > 0) surface.correlation()->prepare();
    return seen;
}

void require_size(const char* call, std::size_t size, std::size_t samples, std::size_t pairs) {
    if (size == pairs * samples) return;
    throw Error{std::string{call} + ": result has " + std::to_string(size) + " values: must be " +
                (pairs == 1 ? "" : "pairs x ") + "samples = " + std::to_string(pairs * samples)};
}

HWY_EXPORT(form_table);

Forms forms(DiffuseLobe lobe) noexcept {
    const FormTable table = HWY_DYNAMIC_DISPATCH(form_table)();
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
