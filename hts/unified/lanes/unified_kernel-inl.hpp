// The lobe of he_unified in lanes, formula by formula; included once per instruction set.
//
// V is a Highway vector; o is its Lanes of lanes-inl.hpp. A lane is a pair in `unified_pair`, a pair
// at a wavelength elsewhere.
#if defined(HTS_UNIFIED_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_UNIFIED_KERNEL_INL
#undef HTS_UNIFIED_KERNEL_INL
#else
#define HTS_UNIFIED_KERNEL_INL
#endif

#include <cstddef>

#include "hts/evaluation/kernel-inl.hpp"
#include "hts/unified/lanes/unified_simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace evaluation = evaluation_detail::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// What one direction contributes.
template <class V>
struct UnifiedSeen {
    V masked;         // cos theta Lambda
    V return_factor;  // m
};

/// m in powers of x = 2 y - 1, of a row of coefficients.
template <class Lanes, class V>
HWY_INLINE V return_row(const Lanes& o, const std::array<double, ReturnFactor::terms>& row,
                        const V (&powers)[4]) {
    static_assert(ReturnFactor::terms == 20);
    return o.mul_add(hl::estrin<16, 4>(o, row, powers), powers[3] * powers[3],
                     hl::estrin<0, 16>(o, row, powers));
}

/// The same of all rows at a width, by Clenshaw's recurrence.
template <class Lanes, class V>
HWY_INLINE V return_rows(const Lanes& o, const SurfaceTerms& surface, V width, const V (&powers)[4]) {
    const V z = (width - o.real(surface.return_centre)) * o.real(surface.return_scale), two_z = z + z;
    V next = o.real(0), after = o.real(0);
    for (std::size_t i = surface.return_rows.size(); i-- > 1;) {
        const V here = o.mul_add(two_z, next, return_row(o, surface.return_rows[i], powers) - after);
        after = next;
        next = here;
    }
    return o.mul_add(z, next, return_row(o, surface.return_rows[0], powers) - after);
}

/// Of a direction, from the slope width along its azimuth.
template <class Lanes, class V>
HWY_INLINE UnifiedSeen<V> seen_of_width(const Lanes& o, const SurfaceTerms& surface, V cosine, V sine,
                                        V slope_width) {
    const V return_width =
        surface.axes.isotropic ? o.real(surface.return_width) : o.min(slope_width, o.real(2));
    const V width_sine = return_width * sine;
    const V y = width_sine / (width_sine + cosine);
    const V x = o.mul_add(y, o.real(2), o.real(-1));
    const V x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    const V powers[4]{x, x2, x4, x8};
    return {evaluation::seen(o, cosine, sine, slope_width).masked,
            surface.axes.isotropic ? return_row(o, surface.return_factor, powers)
                                   : return_rows(o, surface, return_width, powers)};
}

template <class Lanes, class V>
HWY_INLINE UnifiedSeen<V> unified_seen(const Lanes& o, const SurfaceTerms& surface, V cosine, V sine,
                                       V cos_phi, V sin_phi) {
    return seen_of_width(o, surface, cosine, sine,
                         evaluation::slope_width(o, surface.axes, surface.slope_width, cos_phi, sin_phi));
}

/// The two terms of a pair that follow the slopes which a wavelength sees.
template <class V>
struct SeenPair {
    V masked, returns;
};

///   row   of Prepared::seen, at the wavelengths of the lanes
template <class Lanes, class V, class Row>
HWY_INLINE UnifiedSeen<V> seen_at_wave(const Lanes& o, const SurfaceTerms& surface, const Row& row, V cosine,
                                       V sine, V cos_phi, V sin_phi) {
    if (!surface.axes.isotropic) {
        const V along = row(Prepared::slope_width), across = row(Prepared::slope_width_across);
        return seen_of_width(o, surface, cosine, sine,
                             evaluation::width_of(o, surface.axes, along, across, cos_phi, sin_phi));
    }
    const V width_sine = row(Prepared::return_width) * sine;
    const V y = width_sine / (width_sine + cosine);
    const V x = o.mul_add(y, o.real(2), o.real(-1)), x2 = x * x;
    constexpr std::size_t first = Prepared::return_factor, last = first + ReturnFactor::terms - 1;
    static_assert(ReturnFactor::terms % 2 == 0);
    V odd = row(last), even = row(last - 1);
    for (std::size_t k = last - 2; k > first; k -= 2) {
        odd = o.mul_add(odd, x2, row(k));
        even = o.mul_add(even, x2, row(k - 1));
    }
    return {evaluation::seen(o, cosine, sine, row(Prepared::slope_width)).masked, o.mul_add(odd, x, even)};
}

template <class Lanes, class V, class Row>
HWY_INLINE SeenPair<V> seen_pair(const Lanes& o, const SurfaceTerms& surface, const Row& row,
                                 const evaluation::PairAngles<V>& a) {
    const UnifiedSeen<V> in = seen_at_wave(o, surface, row, a.cos_in, a.sin_in, a.cos_phi_in, a.sin_phi_in),
                         out = seen_at_wave(o, surface, row, a.cos_out, a.sin_out, a.cos_phi_out,
                                            a.sin_phi_out);
    return {o.mul_add(in.masked, a.cos_out, out.masked * a.cos_in),
            o.mul_add(in.return_factor, out.return_factor, o.real(-1))};
}

/// What a pair contributes, whatever the wavelength.
enum Field : std::size_t {
    variance,  // g = k^2 variance
    inverse_variance,
    argument,  // t = k^2 argument
    cos_in,
    cos_out,
    cosines,
    sines,
    cos_phi,  // phi of the reflected ray from the forward direction
    sin_phi,
    bend,       // s_i s_r - cos phi, with its digits also where phi and both cosines are small
    cos_facet,  // cos theta_d
    masked,     // c_r masked_i + c_i masked_r
    returns,    // m m - 1
    ss_of_s,    // of the facet's Jones matrix: element ss for F_s = 1, F_p = 0, ...
    ss_of_p,
    sp_of_s,
    ps_of_s,
    kirchhoff,  // |v|^2 / (2 v_z)
    bragg,      // 2 c_i c_r / v_z
    fields
};

template <class V>
struct UnifiedPair {
    V field[fields];
    HWY_INLINE V operator[](Field f) const { return field[f]; }
};

template <class Lanes, class V>
HWY_INLINE UnifiedPair<V> unified_pair(const Lanes& o, const SurfaceTerms& surface,
                                       const evaluation::PairAngles<V>& a, const UnifiedSeen<V>& in,
                                       const UnifiedSeen<V>& out) {
    const V one = o.real(1), half = o.real(0.5);
    const V vertical = a.cos_in + a.cos_out;
    const V inverse = one / vertical;
    const V horizontal = evaluation::horizontal_squared(o, a);
    const V squared = o.mul_add(vertical, vertical, horizontal);
    const V cos_delta = o.mul_add(a.cos_phi_in, a.cos_phi_out, a.sin_phi_in * a.sin_phi_out);
    const V sin_delta = o.neg_mul_add(a.sin_phi_in, a.cos_phi_out, a.cos_phi_in * a.sin_phi_out);
    // turns of both rays' frames into that of the facet, as facet_jones has them, times one length
    const V x_in = o.neg_mul_add(a.cos_in * a.sin_out, cos_delta, a.sin_in * a.cos_out);
    const V y_in = a.sin_out * sin_delta;  // its negative, twice
    const V x_out = o.neg_mul_add(a.cos_out * a.sin_in, cos_delta, a.sin_out * a.cos_in);
    const V y_out = a.sin_in * sin_delta;
    const V length_squared = o.mul_add(x_in, x_in, y_in * y_in);
    const auto coincide = o.less(length_squared, o.real(1e-16));
    const V over = one / o.max(length_squared, o.real(1e-16));
    const V zero = o.real(0);
    UnifiedPair<V> p;
    p.field[variance] = o.real(surface.variance) * (vertical * vertical);
    p.field[inverse_variance] = o.real(surface.inverse_variance) * (inverse * inverse);
    p.field[argument] =
        o.real(surface.quarter_tau_squared) * evaluation::stretched_squared(o, surface.axes, a, horizontal);
    p.field[cos_in] = a.cos_in;
    p.field[cos_out] = a.cos_out;
    p.field[cosines] = a.cos_in * a.cos_out;
    p.field[sines] = a.sin_in * a.sin_out;
    p.field[cos_phi] = zero - cos_delta;
    p.field[sin_phi] = zero - sin_delta;
    const V x_turn = a.cos_phi_in + a.cos_phi_out, y_turn = a.sin_phi_in + a.sin_phi_out;
    const V tilt = a.sin_in - a.sin_out;
    p.field[bend] = half * (o.mul_add(x_turn, x_turn, y_turn * y_turn) -
                            o.mul_add(tilt, tilt, o.mul_add(a.cos_in, a.cos_in, a.cos_out * a.cos_out)));
    p.field[cos_facet] = o.sqrt(o.min(squared * o.real(0.25), one));
    p.field[masked] = o.mul_add(in.masked, a.cos_out, out.masked * a.cos_in);
    p.field[returns] = o.mul_add(in.return_factor, out.return_factor, o.real(-1));
    // at backscatter s of the incident ray serves as s of the facet
    p.field[ss_of_s] = o.select(coincide, zero - cos_delta, x_out * x_in * over);
    p.field[ss_of_p] = o.select(coincide, zero, y_out * y_in * over);
    p.field[sp_of_s] = o.select(coincide, zero, zero - x_out * y_in * over);
    p.field[ps_of_s] = o.select(coincide, zero - a.cos_out * sin_delta, zero - y_out * x_in * over);
    p.field[kirchhoff] = half * squared * inverse;
    p.field[bragg] = o.real(2) * (a.cos_in * a.cos_out) * inverse;
    return p;
}

/// A complex number.
template <class V>
struct Complex {
    V re, im;
};

template <class Lanes, class V>
HWY_INLINE Complex<V> times(const Lanes& o, const Complex<V>& a, const Complex<V>& b) {
    return {o.neg_mul_add(a.im, b.im, a.re * b.re), o.mul_add(a.re, b.im, a.im * b.re)};
}
/// a times the conjugate of b.
template <class Lanes, class V>
HWY_INLINE Complex<V> times_conjugate(const Lanes& o, const Complex<V>& a, const Complex<V>& b) {
    return {o.mul_add(a.im, b.im, a.re * b.re), o.neg_mul_add(a.re, b.im, a.im * b.re)};
}
template <class Lanes, class V>
HWY_INLINE V norm(const Lanes& o, const Complex<V>& a) {
    return o.mul_add(a.re, a.re, a.im * a.im);
}
/// One over a number, from one over its norm.
template <class Lanes, class V>
HWY_INLINE Complex<V> reciprocal(const Lanes& o, const Complex<V>& a, V over_norm) {
    return {a.re * over_norm, o.real(0) - a.im * over_norm};
}

/// Optical constants and roughness at a wavelength.
template <class V>
struct WaveTerms {
    V d_real, d_imaginary;  // d = N^2 - 1
    V horizon, lift, returned;
    bool dense;
    Complex<V> root[root_terms];  // where dense
};

/// r = sqrt(d + c^2), principal, at three cosines.
template <class V>
struct Roots {
    Complex<V> facet, in, out;
};

template <class Lanes, class V>
HWY_INLINE Complex<V> dense_root(const Lanes& o, const WaveTerms<V>& wave, V cosine) {
    const V x = o.neg_mul_add(cosine, cosine, o.real(1));
    Complex<V> sum = wave.root[root_terms - 1];
    HTS_UNROLL
    for (int i = root_terms - 2; i >= 0; --i)
        sum = {o.mul_add(sum.re, x, wave.root[i].re), o.mul_add(sum.im, x, wave.root[i].im)};
    return sum;
}

/// The larger of both parts, and the real part of r^2.
template <class V>
struct HalfRoot {
    V larger, real;
};
template <class Lanes, class V>
HWY_INLINE HalfRoot<V> half_root(const Lanes& o, const WaveTerms<V>& wave, V cosine) {
    const V real = o.mul_add(cosine, cosine, wave.d_real);
    const V size = o.max(real, o.real(0) - real);
    const V modulus = o.sqrt(o.mul_add(real, real, wave.d_imaginary * wave.d_imaginary));
    return {o.sqrt(o.max(o.real(0.5) * (modulus + size), o.real(1e-80))), real};
}
template <class Lanes, class V>
HWY_INLINE Complex<V> whole_root(const Lanes& o, const HalfRoot<V>& half, V smaller) {
    const auto left = o.less(half.real, o.real(0));
    return {o.select(left, smaller, half.larger), o.select(left, half.larger, smaller)};
}

template <class Lanes, class V>
HWY_INLINE Roots<V> roots(const Lanes& o, const UnifiedPair<V>& pair, const WaveTerms<V>& wave) {
    if (wave.dense)
        return {dense_root(o, wave, pair[cos_facet]), dense_root(o, wave, pair[cos_in]),
                dense_root(o, wave, pair[cos_out])};
    const HalfRoot<V> a = half_root(o, wave, pair[cos_facet]), b = half_root(o, wave, pair[cos_in]),
                      c = half_root(o, wave, pair[cos_out]);
    // the smaller parts, Im r^2/(2 larger), with one division
    const V bc = b.larger * c.larger;
    const V over = o.real(0.5) * wave.d_imaginary / (a.larger * bc);
    const V over_a = over * a.larger;
    return {whole_root(o, a, over * bc), whole_root(o, b, over_a * c.larger),
            whole_root(o, c, over_a * b.larger)};
}

/// The Jones matrix M over N^2 - 1 and c_i + c_r, and G over c_i c_r.
template <class V>
struct JonesLanes {
    Complex<V> ss, sp, ps, pp;
    V shadowing;
};

/// What of (1 + a)^4 is above 1.
template <class Lanes, class V>
HWY_INLINE V fourth_power_less_one(const Lanes& o, V a) {
    return a * o.mul_add(a, o.mul_add(a, o.mul_add(a, o.real(1), o.real(4)), o.real(6)), o.real(4));
}

/// What Bragg's matrix has of one ray: c + r and e (c + Z) + r.
template <class V>
struct RayLanes {
    Complex<V> s, p;
};
template <class Lanes, class V>
HWY_INLINE RayLanes<V> ray(const Lanes& o, const WaveTerms<V>& wave, V cosine, const Complex<V>& root) {
    const V lifted = cosine + wave.lift;
    return {{cosine + root.re, root.im},
            {o.mul_add(wave.d_real, lifted, lifted + root.re), o.mul_add(wave.d_imaginary, lifted, root.im)}};
}

/// G over c_i c_r, and the share of Kirchhoff's matrix in M, 1 - beta'.
template <class V>
struct ShareLanes {
    V shadowing, share;
};
template <class Lanes, class V>
HWY_INLINE ShareLanes<V> kirchhoff_share(const Lanes& o, const UnifiedPair<V>& pair, V horizon, V returned,
                                         V mean) {
    const V one = o.real(1), all = one + mean;
    const V in_horizon = fourth_power_less_one(o, horizon * pair[cos_in]);
    const V out_horizon = fourth_power_less_one(o, horizon * pair[cos_out]);
    const V outer = all * ((one + in_horizon) * (one + out_horizon));
    const V spread = o.mul_add(all, pair[cosines], mean * pair[masked]);
    const V over = one / (outer * spread);
    return {o.mul_add(returned * mean, pair[returns], all) * (outer * over),
            mean * (in_horizon * out_horizon) * (spread * over)};
}

/// unified_lobe in lanes. All its divisions are one.
///   F_s and F_p over N^2 - 1 are -1/(c + r)^2, and times (s^2 - c r)/(s^2 + c r)
///   mean   H of kicks_table.hpp
template <class Lanes, class V>
HWY_INLINE JonesLanes<V> jones(const Lanes& o, const UnifiedPair<V>& pair, const WaveTerms<V>& wave, V mean) {
    const V zero = o.real(0), one = o.real(1);
    const Roots<V> r = roots(o, pair, wave);
    const V c = pair[cos_facet], sine_squared = o.neg_mul_add(c, c, one);
    const Complex<V> above{c + r.facet.re, r.facet.im};
    const Complex<V> plus{o.mul_add(c, r.facet.re, sine_squared), c * r.facet.im};
    const Complex<V> minus{o.neg_mul_add(c, r.facet.re, sine_squared), zero - plus.im};
    const Complex<V> facet_below = times(o, times(o, above, above), plus);
    const RayLanes<V> in = ray(o, wave, pair[cos_in], r.in), out = ray(o, wave, pair[cos_out], r.out);
    const Complex<V> s_both = times(o, in.s, out.s), p_both = times(o, in.p, out.p);
    const Complex<V> bragg_below = times(o, s_both, p_both);

    const V all = one + mean;  // beta = 1/all, w = mean/all
    const V in_horizon = fourth_power_less_one(o, wave.horizon * pair[cos_in]);
    const V out_horizon = fourth_power_less_one(o, wave.horizon * pair[cos_out]);
    const V outer = all * ((one + in_horizon) * (one + out_horizon));
    const V spread = o.mul_add(all, pair[cosines], mean * pair[masked]);
    const V shares = outer * spread, facet_norm = norm(o, facet_below), bragg_norm = norm(o, bragg_below);
    const V over = one / (shares * (facet_norm * bragg_norm));
    const V over_shares = over * (facet_norm * bragg_norm);
    const Complex<V> over_facet = reciprocal(o, facet_below, over * (shares * bragg_norm));
    const Complex<V> over_bragg = reciprocal(o, bragg_below, over * (shares * facet_norm));
    const V share = mean * (in_horizon * out_horizon) * (spread * over_shares);

    const V of_facet = zero - share * pair[kirchhoff], of_bragg = (one - share) * pair[bragg];
    const Complex<V> s = times(o, plus, over_facet), p = times(o, minus, over_facet);
    const V a = of_facet * pair[ss_of_s], b = of_facet * pair[ss_of_p];
    const V e = of_facet * pair[sp_of_s], f = of_facet * pair[ps_of_s];
    const V straight = of_bragg * pair[cos_phi], across = zero - of_bragg * pair[sin_phi];
    const V down = of_bragg * pair[sines];
    const Complex<V> ss = times(o, p_both, over_bragg);
    const Complex<V> both = times(o, r.in, r.out);
    const Complex<V> upper{o.neg_mul_add(wave.d_real, down, straight * both.re - down),
                           o.neg_mul_add(wave.d_imaginary, down, straight * both.im)};
    const Complex<V> pp = times(o, upper, times(o, s_both, over_bragg));
    const Complex<V> sp = times(o, times(o, r.in, times(o, in.s, out.p)), over_bragg);
    const Complex<V> ps = times(o, times(o, r.out, times(o, out.s, in.p)), over_bragg);
    return {{o.mul_add(a, s.re, o.mul_add(b, p.re, zero - straight * ss.re)),
             o.mul_add(a, s.im, o.mul_add(b, p.im, zero - straight * ss.im))},
            {o.mul_add(e, s.re, o.neg_mul_add(f, p.re, across * sp.re)),
             o.mul_add(e, s.im, o.neg_mul_add(f, p.im, across * sp.im))},
            {o.mul_add(f, s.re, o.neg_mul_add(e, p.re, across * ps.re)),
             o.mul_add(f, s.im, o.neg_mul_add(e, p.im, across * ps.im))},
            {o.mul_add(b, s.re, o.mul_add(a, p.re, pp.re)), o.mul_add(b, s.im, o.mul_add(a, p.im, pp.im))},
            o.mul_add(wave.returned * mean, pair[returns], all) * (outer * over_shares)};
}

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
