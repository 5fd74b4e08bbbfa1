// What the lobe of he_unified is evaluated for, a block of wavelengths or of pairs; included once per
// instruction set.
#if defined(HTS_UNIFIED_ITEMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_UNIFIED_ITEMS_INL
#undef HTS_UNIFIED_ITEMS_INL
#else
#define HTS_UNIFIED_ITEMS_INL
#endif

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

#include "hts/phi/phi_cells-inl.hpp"
#include "hts/unified/lanes/conductor-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace phi = phi_detail::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

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

/// A pair's angles in every lane.
template <std::size_t most_lanes>
HWY_INLINE evaluation::PairAngles<typename Vectors<most_lanes>::V> angles_of(const DirectionPair& pair) {
    constexpr typename Vectors<most_lanes>::Lanes o{};
    const auto& [in, out] = pair;
    return {o.real(in.cos_theta()),  o.real(in.sin_theta()),  o.real(in.cos_phi()),  o.real(in.sin_phi()),
            o.real(out.cos_theta()), o.real(out.sin_theta()), o.real(out.cos_phi()), o.real(out.sin_phi())};
}

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
    return unified_pair(o, surface, angles_of<most_lanes>(pair),
                        UnifiedSeen<V>{first(seen.masked), first(seen.return_factor)},
                        UnifiedSeen<V>{second(seen.masked), second(seen.return_factor)});
}

/// Items of one pair from a wavelength on: a lane is a wavelength.
template <std::size_t most_lanes>
struct Spectrum : Vectors<most_lanes> {
    using V = typename Vectors<most_lanes>::V;

    const Prepared& p;
    const UnifiedPair<V>& terms;
    std::size_t first;

    HWY_INLINE Spectrum(const Prepared& of, const UnifiedPair<V>& pair, const DirectionPair&,
                        std::size_t from)
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

/// The same where every wavelength sees slopes of its own.
template <std::size_t most_lanes>
struct SeenSpectrum : Spectrum<most_lanes> {
    using V = typename Vectors<most_lanes>::V;
    HWY_ALIGN double masked_at[block_size], returns_at[block_size];

    HWY_INLINE SeenSpectrum(const Prepared& of, const UnifiedPair<V>& pair, const DirectionPair& directions,
                            std::size_t from)
        : Spectrum<most_lanes>{of, pair, directions, from} {
        constexpr typename Vectors<most_lanes>::Lanes o{};
        const evaluation::PairAngles<V> angles = angles_of<most_lanes>(directions);
        for (std::size_t i = 0; i < std::min(block_size, of.padded - from); i += this->lanes) {
            const auto row = [&of, from, i](std::size_t k) HWY_ATTR {
                return hn::LoadU(Vectors<most_lanes>::d, of.seen.data() + k * of.padded + from + i);
            };
            const SeenPair<V> at = seen_pair(o, of.surface, row, angles);
            hn::Store(at.masked, this->d, masked_at + i);
            hn::Store(at.returns, this->d, returns_at + i);
        }
    }
    HWY_INLINE UnifiedPair<V> pair(std::size_t i) const {
        UnifiedPair<V> at = this->terms;
        at.field[masked] = hn::Load(this->d, masked_at + i);
        at.field[returns] = hn::Load(this->d, returns_at + i);
        return at;
    }
};

/// Terms of a block of pairs: a lane is a pair.
struct PairBlock : Vectors<8> {
    HWY_ALIGN double field[fields][block_size], angle[8][block_size];

    /// Fills whole vectors; those beyond `pairs` repeat its last.
    HWY_INLINE bool load(const SurfaceTerms& surface, std::span<const DirectionPair> pairs) {
        constexpr Lanes o{};
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
    /// With the slopes that a wavelength sees.
    HWY_INLINE void see(const Prepared& p, std::size_t wavelength, std::size_t count) {
        const auto row = [&p, wavelength](std::size_t k)
                             HWY_ATTR { return hn::Set(d, p.seen[k * p.padded + wavelength]); };
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto at = [&](std::size_t k) HWY_ATTR { return hn::Load(d, angle[k] + i); };
            const evaluation::PairAngles<V> a{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
            const SeenPair<V> pair = seen_pair(Lanes{}, p.surface, row, a);
            hn::Store(pair.masked, d, field[masked] + i);
            hn::Store(pair.returns, d, field[returns] + i);
        }
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

/// What is kept beside the lobe: nothing of unpolarised light; the Jones matrix, which then does not multiply
/// the lobe; or the share of Kirchhoff's in it, for a matrix that the caller makes.
enum class Kept { nothing, matrix, share };
constexpr std::size_t parts_of(Kept kept) {
    return kept == Kept::matrix ? 8 : 1;
}

/// Items whose Phi nothing multiplies.
template <class Items>
struct Plain : Items {
    HWY_INLINE explicit Plain(const Items& items) : Items{items} {}
    HWY_INLINE typename Items::V scale(std::size_t) const { return hn::Set(this->d, 1.0); }
};

/// What multiplies Phi.
template <class Items, Kept what>
struct Scaled : Items {
    using V = typename Items::V;

    double (*kept)[block_size];  // part by part

    HWY_INLINE Scaled(const Items& items, double (*matrices)[block_size]) : Items{items}, kept{matrices} {}
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
    ///   mean   H of kicks_table.hpp
    HWY_INLINE V scale(std::size_t i, V mean) const {
        constexpr typename Items::Lanes o{};
        if constexpr (what == Kept::share) {
            const ShareLanes<V> of = kirchhoff_share(o, this->pair(i), this->load(Prepared::horizon, i),
                                                     this->load(Prepared::returned, i), mean);
            hn::Store(of.share, this->d, kept[0] + i);
            return this->load(Prepared::weight, i) * of.shadowing;
        } else if (what == Kept::nothing && this->p.conductor) {
            return scale_of_conductor(i, mean);
        } else {
            return scale_of_matrix(i, mean);
        }
    }

  private:
    HWY_INLINE V scale_of_conductor(std::size_t i, V mean) const {
        constexpr typename Items::Lanes o{};
        const UnifiedPair<V>& pair = this->pair(i);
        const V d_imaginary = this->load(Prepared::d_imaginary, i);
        const auto facet = evaluation::fresnel_terms(
            o, pair[cos_facet] * pair[cos_facet],
            evaluation::IndexTerms<V>{this->load(Prepared::d_real, i), d_imaginary * d_imaginary});
        return this->load(Prepared::weight, i) *
               conductor_scale(o, pair, facet, this->load(Prepared::horizon, i),
                               this->load(Prepared::lift, i), this->load(Prepared::returned, i), mean);
    }
    HWY_INLINE V scale_of_matrix(std::size_t i, V mean) const {
        constexpr typename Items::Lanes o{};
        const JonesLanes<V> m = jones(o, this->pair(i), wave(i), mean);
        const V scale = this->load(Prepared::weight, i) * m.shadowing;
        if constexpr (what == Kept::matrix) {
            const V parts[8]{m.ss.re, m.ss.im, m.sp.re, m.sp.im, m.ps.re, m.ps.im, m.pp.re, m.pp.im};
            for (std::size_t k = 0; k < 8; ++k) hn::Store(parts[k], this->d, kept[k] + i);
            return scale;
        } else {
            return scale * o.real(0.5) * ((norm(o, m.ss) + norm(o, m.pp)) + (norm(o, m.sp) + norm(o, m.ps)));
        }
    }
};

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
