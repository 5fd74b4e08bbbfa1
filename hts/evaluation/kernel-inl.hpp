// The directional-diffuse term in lanes, formula by formula; included once per instruction set.
//
// A lane is a direction in `seen`, a pair in `pair_terms`, and a pair at a wavelength in `fresnel_terms`. V
// is a Highway vector of double or float or, for one item, double; o is its Lanes of lanes-inl.hpp. Errors
// are those in double; in float all are below 1e-6.
#if defined(HTS_EVALUATION_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_KERNEL_INL
#undef HTS_EVALUATION_KERNEL_INL
#else
#define HTS_EVALUATION_KERNEL_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "hts/evaluation/evaluation_simd.hpp"
#include "hts/evaluation/evaluation_table.hpp"
#include "hts/lanes/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {

using lanes::HWY_NAMESPACE::polynomial;

template <class Lanes>
constexpr bool is_single = sizeof(typename Lanes::Number) == sizeof(float);

/// exp(-s) for 0 <= s <= 60.
///   error   relative, at most 6e-11
template <class Lanes, class V>
HWY_INLINE V exp_of_minus(const Lanes& o, V s) {
    const V e = s * o.real(-std::numbers::log2e);
    if constexpr (is_single<Lanes>) {
        return lanes::HWY_NAMESPACE::exp2<5>(o, e);
    } else {
        const V shifted = e + o.real(0x1.8p52 + 1023);  // the rounded exponent, biased, in the last bits
        const V f = e - (shifted - o.real(0x1.8p52 + 1023));
        const V power = o.from_bits(o.template shift_left<52>(o.bits(shifted)));
        return polynomial(o, exp2_coefficients, f) * power;
    }
}

/// What one direction contributes, with S_1 / cos theta as a quotient still to be divided.
template <class V>
struct Seen {
    V obstruction;  // K
    V lit;          // 1 - erfc(c)/2
    V reach;        // cos theta + (sigma_0/tau) sin theta ierfc(c)
    V masked;       // cos theta Lambda, (sigma_0/tau) sin theta ierfc(c)
};

/// exp(c^2) erfc(c) / y at a position in y.
template <class Lanes, class V>
HWY_INLINE V erfcx_over_y(const Lanes& o, V position) {
    if constexpr (is_single<Lanes>)
        return polynomial(o, single_erfcx_coefficients, position);
    else
        return polynomial(o, erfcx_coefficients, position);
}

inline constexpr double erfcx_first = erfcx_centre / (erfcx_centre + erfcx_far);

/// The same from c = cosine/width_sine, at most erfcx_far, and y = erfcx_centre/(erfcx_centre + c).
template <class Lanes, class V>
HWY_INLINE Seen<V> seen_at(const Lanes& o, V cosine, V tangent, V width_sine, V c, V y) {
    constexpr double length = 1 - erfcx_first;
    const V position = o.mul_add(y, o.real(1 / length), o.real(-(1 + erfcx_first) / (2 * length)));
    const V erfcx = y * erfcx_over_y(o, position);
    const V gaussian = exp_of_minus(o, c * c);
    const V complement = gaussian * erfcx;
    const V ierfc = gaussian * o.neg_mul_add(c, erfcx, o.real(std::numbers::inv_sqrtpi));
    const V half = o.real(0.5);
    return {tangent * complement, o.neg_mul_add(half, complement, o.real(1)),
            o.mul_add(half * width_sine, ierfc, cosine), half * width_sine * ierfc};
}

/// hts::visibility in lanes.
///   cosine   >= lowest_cosine      width_sine   the width of the slopes times sine, >= 0
///   error    of K and of the quotient 1e-10, relative or beside 1e-12
template <class Lanes, class V>
HWY_INLINE Seen<V> seen_across(const Lanes& o, V cosine, V sine, V width_times_sine) {
    const V width_sine = o.max(width_times_sine, o.real(is_single<Lanes> ? 1e-30 : 1e-300));
    const V c = o.min(cosine / width_sine, o.real(erfcx_far));
    const V centred = o.real(erfcx_centre) * width_sine;
    const V y = o.max(centred / (centred + cosine), o.real(erfcx_first));
    return seen_at(o, cosine, sine / cosine, width_sine, c, y);
}
template <class Lanes, class V>
HWY_INLINE Seen<V> seen(const Lanes& o, V cosine, V sine, V slope_width) {
    return seen_across(o, cosine, sine, slope_width * sine);
}

/// The coordinate v of `lambert_coefficients` for the obstruction of a pair: x = K^2 / 8 pi.
template <class Lanes, class V>
HWY_INLINE V lambert_coordinate(const Lanes& o, V obstruction) {
    constexpr double scale = std::numbers::e * std::numbers::inv_pi / 8;
    return o.mul_add(obstruction * o.real(scale), obstruction, o.real(1));
}

/// 1 + W_0 from that coordinate: one piece of a table, so value by value. Its result is a vector of one
/// lane's worth, to be stored.
///   error   relative, at most 5e-12
HWY_INLINE double one_plus_lambert(double v) {
    constexpr hwy::HWY_NAMESPACE::CappedTag<double, 2> two;
    constexpr std::uint64_t last = lambert_octaves * (1U << lambert_log2_pieces) - 1;
    constexpr std::uint64_t bias = std::uint64_t{1023} << lambert_log2_pieces;
    const auto bits = std::bit_cast<std::uint64_t>(v);
    const std::uint64_t offset = (bits >> (52 - lambert_log2_pieces)) - bias;
    const std::uint64_t piece = offset < last ? offset : last;  // the last for infinity and NaN
    const std::uint64_t fraction = (bits << lambert_log2_pieces) & ((std::uint64_t{1} << 52) - 1);
    const double x = std::bit_cast<double>(fraction | std::uint64_t{1023} << 52) - 1.5;
    const double* const c = lambert_coefficients.data() + piece * lambert_coefficients_per_piece;
    namespace hn = hwy::HWY_NAMESPACE;
    const auto x2 = hn::Set(two, x * x);
    auto sum = hn::MulAdd(hn::Load(two, c + 6), x2, hn::Load(two, c + 4));
    sum = hn::MulAdd(sum, x2, hn::Load(two, c + 2));
    sum = hn::MulAdd(sum, x2, hn::Load(two, c));
    return hn::GetLane(hn::MulAdd(hn::Reverse2(two, sum), hn::Set(two, x), sum));
}

#if HWY_TARGET != HWY_SCALAR
/// The same in single precision: 1 + W_0, its reciprocal, and both again.
///   error   relative, at most 5e-7
HWY_INLINE hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::FixedTag<float, 4> > one_plus_lambert(float v) {
    namespace hn = hwy::HWY_NAMESPACE;
    constexpr hn::FixedTag<float, 4> four;
    constexpr std::uint32_t last = lambert_octaves * (1U << single_lambert_log2_pieces) - 1;
    constexpr std::uint32_t bias = std::uint32_t{127} << single_lambert_log2_pieces;
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const std::uint32_t piece = std::min((bits >> (23 - single_lambert_log2_pieces)) - bias, last);
    const std::uint32_t fraction = (bits << single_lambert_log2_pieces) & ((std::uint32_t{1} << 23) - 1);
    const float x = std::bit_cast<float>(fraction | std::uint32_t{127} << 23) - 1.5F;
    const float* const c = single_lambert_coefficients.data() + piece * single_lambert_row;
    const auto sum = hn::MulAdd(hn::Load(four, c + 4), hn::Set(four, x * x), hn::Load(four, c));
    return hn::MulAdd(hn::Shuffle1032(sum), hn::Set(four, x), sum);  // right in the lower half
}
#endif

/// Cosines and sines of a pair's angles.
template <class V>
struct PairAngles {
    V cos_in, sin_in, cos_phi_in, sin_phi_in;
    V cos_out, sin_out, cos_phi_out, sin_phi_out;
};

/// sin theta_r - sin theta_i
template <class Lanes, class V>
HWY_INLINE V sine_difference(const Lanes& o, const PairAngles<V>& a) {
    const V one = o.real(1);
    const V sines = a.sin_in + a.sin_out;
    const V by_cosines = (a.cos_in - a.cos_out) * (a.cos_in + a.cos_out) / o.max(sines, one);
    return o.select(o.less(sines, one), a.sin_out - a.sin_in, by_cosines);
}

/// |v_xy|^2 as hts::wave_vector_change has it.
template <class Lanes, class V>
HWY_INLINE V horizontal_squared(const Lanes& o, const PairAngles<V>& a) {
    const V along = sine_difference(o, a);
    const V x = a.cos_phi_in + a.cos_phi_out;
    const V y = a.sin_phi_in + a.sin_phi_out;
    const V across = o.mul_add(x, x, y * y);
    return o.mul_add(along, along, a.sin_in * a.sin_out * across);
}

/// The square of (x', y'), a vector of the plane along the axes, each times its factor.
template <class Lanes, class V>
HWY_INLINE V squared_along_axes(const Lanes& o, const AxisTerms& axes, V x, V y, double along,
                                double across) {
    const V c = o.real(axes.cosine), s = o.real(axes.sine);
    const V first = o.mul_add(x, c, y * s) * o.real(along);
    const V second = o.neg_mul_add(x, s, y * c) * o.real(across);
    return o.mul_add(first, first, second * second);
}

/// Surface::slope_width of a direction of an azimuth.
///   mean   of all azimuths, which an isotropic surface has everywhere
template <class Lanes, class V>
HWY_INLINE V slope_width(const Lanes& o, const AxisTerms& axes, double mean, V cos_phi, V sin_phi) {
    if (axes.isotropic) return o.real(mean);
    return o.sqrt(squared_along_axes(o, axes, cos_phi, sin_phi, axes.width_along, axes.width_across));
}

/// Slope width of a direction, from those along both axes at the wavelengths of the lanes.
template <class Lanes, class V>
HWY_INLINE V width_of(const Lanes& o, const AxisTerms& axes, V along, V across, V cos_phi, V sin_phi) {
    if (axes.isotropic) return along;
    const V c = o.real(axes.cosine), s = o.real(axes.sine);
    const V first = o.mul_add(cos_phi, c, sin_phi * s) * along;
    const V second = o.neg_mul_add(cos_phi, s, sin_phi * c) * across;
    return o.sqrt(o.mul_add(first, first, second * second));
}

/// The square of hts::stretched_horizontal.
///   horizontal   |v_xy|^2
template <class Lanes, class V>
HWY_INLINE V stretched_squared(const Lanes& o, const AxisTerms& axes, const PairAngles<V>& a, V horizontal) {
    if (axes.isotropic) return horizontal;
    const V half = o.real(0.5);
    const V difference = half * sine_difference(o, a), sum = half * (a.sin_in + a.sin_out);
    const V x = o.mul_add(difference, a.cos_phi_out - a.cos_phi_in, sum * (a.cos_phi_out + a.cos_phi_in));
    const V y = o.mul_add(difference, a.sin_phi_out - a.sin_phi_in, sum * (a.sin_phi_out + a.sin_phi_in));
    return squared_along_axes(o, axes, x, y, axes.stretch_along, axes.stretch_across);
}

/// v of a pair: v_z, |v_xy|^2 and the same stretched along the axes of the surface.
template <class V>
struct PairShape {
    V vertical, horizontal, stretched;
};
template <class Lanes, class V>
HWY_INLINE PairShape<V> pair_shape(const Lanes& o, const AxisTerms& axes, const PairAngles<V>& a) {
    const V horizontal = horizontal_squared(o, a);
    return {a.cos_in + a.cos_out, horizontal, stretched_squared(o, axes, a, horizontal)};
}

/// What a pair contributes, whatever the wavelength. With k the wave number: g = k^2 variance,
/// 1/g = inverse_variance / k^2, t = k^2 argument, f_dd = k^2 lobe Phi |F|^2.
template <class V>
struct PairTerms {
    V variance, inverse_variance, argument, lobe;
    V cos_squared;  // of theta_d
};

///   one_plus_w         1 + W_0
///   visible_variance   sigma_0^2 over it, that of the heights that are lit and seen
template <class Lanes, class V, class Surface>
HWY_INLINE PairTerms<V> pair_terms(const Lanes& o, const Surface& surface, const PairShape<V>& shape,
                                   V one_plus_w, V visible_variance, V shadowing_over_cosines) {
    const V vertical_squared = shape.vertical * shape.vertical;
    const V inverse_vertical_squared = o.real(1) / vertical_squared;
    const V cos_squared = o.min((shape.horizontal + vertical_squared) * o.real(0.25), o.real(1));
    return {visible_variance * vertical_squared,
            o.real(surface.inverse_variance) * inverse_vertical_squared * one_plus_w,
            o.real(surface.quarter_tau_squared) * shape.stretched,
            o.real(surface.tau_squared_over_pi) * (cos_squared * cos_squared) * inverse_vertical_squared *
                shadowing_over_cosines,
            cos_squared};
}
template <class Lanes, class V>
HWY_INLINE PairTerms<V> pair_terms(const Lanes& o, const SurfaceTerms& surface, const PairAngles<V>& a,
                                   V one_plus_w, V shadowing_over_cosines) {
    return pair_terms(o, surface, pair_shape(o, surface.axes, a), one_plus_w,
                      o.real(surface.variance) / one_plus_w, shadowing_over_cosines);
}

/// Optical constants at a wavelength: d = N^2 - 1.
template <class V>
struct IndexTerms {
    V d_real, d_imaginary_squared;  // d_imaginary = 2nk
};

/// Fresnel in real arithmetic, r = sqrt(N^2 - sin^2) = A + iB, M = |r|^2:
///   |F_s|^2 = |d|^2 / |c + r|^4,                  |c + r|^2 = M + c^2 + 2 A c
///   |F_p|^2 = |F_s|^2 |c r - s^2|^2 / |c r + s^2|^2,  |c r +- s^2|^2 = M c^2 + s^4 +- 2 A c s^2
/// No difference cancels as N -> 1.
template <class V>
struct FresnelTerms {
    V s_below;  // |c + r|^2
    V p_mean;   // M c^2 + s^4
    V p_below;  // |c r + s^2|^2
    V p_cross;  // 2 A c s^2
    V cos_squared, sine_squared;
    V modulus;  // M
    V real;     // Re r^2
};

template <class Lanes, class V>
HWY_INLINE FresnelTerms<V> fresnel_terms(const Lanes& o, V cos_squared, const IndexTerms<V>& index) {
    const V real = index.d_real + cos_squared;
    const V modulus = o.sqrt(o.mul_add(real, real, index.d_imaginary_squared));
    const V two_ac = o.sqrt(o.max(o.real(2) * cos_squared * (modulus + real), o.real(0)));
    const V sine_squared = o.real(1) - cos_squared;
    const V p_mean = o.mul_add(modulus, cos_squared, sine_squared * sine_squared);
    const V p_cross = two_ac * sine_squared;
    return {modulus + cos_squared + two_ac,
            p_mean,
            p_mean + p_cross,
            p_cross,
            cos_squared,
            sine_squared,
            modulus,
            real};
}

/// scale |F|^2 / |d|^2 for unpolarised light: (|F_s|^2 + |F_p|^2)/2 with one division.
template <class V>
HWY_INLINE V unpolarised(V scale, const FresnelTerms<V>& f) {
    return scale * f.p_mean / (f.s_below * f.s_below * f.p_below);
}

/// Mueller matrix of diag(F_s, F_p): p on both ends of the diagonal's first half, q beside it, and F_s F_p*.
/// All times |c + r|^4 |c r + s^2|^2 / |d|^2.
template <class V>
struct FresnelMueller {
    V p, q, real, imaginary;
};

/// By F_s F_p* = |F_s|^2 (s^4 - M c^2 + 2i c s^2 B) / |c r + s^2|^2.
template <class Lanes, class V>
HWY_INLINE FresnelMueller<V> fresnel_mueller(const Lanes& o, const FresnelTerms<V>& f) {
    const V two_bc = o.sqrt(o.max(o.real(2) * f.cos_squared * (f.modulus - f.real), o.real(0)));
    return {f.p_mean, f.p_cross, o.neg_mul_add(f.modulus, f.cos_squared, f.sine_squared * f.sine_squared),
            two_bc * f.sine_squared};
}

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
