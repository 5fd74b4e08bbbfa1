// The specular term of he_unified in lanes, unified_mirror.hpp; included once per instruction set.
#if defined(HTS_UNIFIED_MIRROR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_UNIFIED_MIRROR_INL
#undef HTS_UNIFIED_MIRROR_INL
#else
#define HTS_UNIFIED_MIRROR_INL
#endif

#include "hts/unified/lanes/unified_items-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// tau over tau(alpha) of a direction's azimuth, at wavelengths i ... i + lanes - 1.
template <std::size_t most_lanes>
HWY_INLINE typename Vectors<most_lanes>::V stretch_of(const Prepared& p, const Direction& in, std::size_t i) {
    using V = typename Vectors<most_lanes>::V;
    constexpr typename Vectors<most_lanes>::Lanes o{};
    if (p.surface.axes.isotropic) return o.real(1);
    const V cos_phi = o.real(in.cos_phi()), sin_phi = o.real(in.sin_phi());
    const double mean = p.surface.slope_width;
    if (p.seen.empty())
        return evaluation::slope_width(o, p.surface.axes, mean, cos_phi, sin_phi) * o.real(1 / mean);
    const auto row = [&p, i](Prepared::SeenRow k) HWY_ATTR {
        return hn::LoadU(Vectors<most_lanes>::d, p.seen.data() + k * p.padded + i);
    };
    const V along = row(Prepared::slope_width), across = row(Prepared::slope_width_across);
    return evaluation::width_of(o, p.surface.axes, along, across, cos_phi, sin_phi) / o.sqrt(along * across);
}

/// (|F_s|^2 exp(-x_s) + |F_p|^2 exp(-x_p))/2 at wavelengths i ... i + lanes - 1; its divisions are one where
/// the surface is isotropic.
template <std::size_t most_lanes>
HWY_INLINE typename Vectors<most_lanes>::V mirrored(const Prepared& p, const Direction& in, std::size_t i) {
    using V = typename Vectors<most_lanes>::V;
    constexpr typename Vectors<most_lanes>::Lanes o{};
    const auto load = [&p, i](Prepared::Column column)
                          HWY_ATTR { return hn::LoadU(Vectors<most_lanes>::d, p[column] + i); };
    const double sine = in.sin_theta();
    const V c = o.real(in.cos_theta()), c_squared = c * c, sine_squared = o.real(sine * sine);
    const V d_real = load(Prepared::d_real), d_imaginary = load(Prepared::d_imaginary);
    const V d_imaginary_squared = d_imaginary * d_imaginary;
    const auto f =
        evaluation::fresnel_terms(o, c_squared, evaluation::IndexTerms<V>{d_real, d_imaginary_squared});
    const V to_impedance = c + load(Prepared::impedance_real), beside = load(Prepared::impedance_imaginary);
    const V below = o.mul_add(to_impedance, to_impedance, beside * beside);
    const V s_below = f.s_below * f.s_below;
    const V over = o.real(1) / (s_below * f.p_below * below);
    const V s_share = o.mul_add(d_real, d_real, d_imaginary_squared) * (over * f.p_below * below);
    const V p_share = s_share * (f.p_mean - f.p_cross) * (over * s_below * below);

    const V slant = load(Prepared::mirror_slant) * o.real(sine) * stretch_of<most_lanes>(p, in, i);
    const V slanted = o.sqrt(o.sqrt(o.mul_add(c_squared, c_squared, slant * slant)));
    const V grazing =
        load(Prepared::mirror_grazing) * (sine_squared * sine_squared) * (over * s_below * f.p_below);
    // of 4 (k sigma_0)^2 c, as a power of 2
    const V scale = o.real(-4 * std::numbers::log2e * p.surface.variance) * load(Prepared::wave_squared) * c;
    constexpr int degree = 10;
    return o.real(0.5) * (hl::scaled_exp2<degree>(o, scale * slanted, s_share) +
                          hl::scaled_exp2<degree>(o, scale * (slanted + grazing), p_share));
}

template <std::size_t most_lanes>
HWY_INLINE void mirrored_at_all(const Prepared& p, const Direction& in, double* result) {
    using Items = Vectors<most_lanes>;
    for (std::size_t i = 0; i < p.count; i += Items::lanes)
        Items::store_some(mirrored<most_lanes>(p, in, i), p.count - i, result + i);
}

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
