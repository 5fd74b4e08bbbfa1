// Density and draws of the sampler's mixture, formula by formula; included once per instruction set.
#if defined(HTS_SAMPLING_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_SAMPLING_KERNEL_INL
#undef HTS_SAMPLING_KERNEL_INL
#else
#define HTS_SAMPLING_KERNEL_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "hts/lanes/polynomials-inl.hpp"
#include "hts/sampling/simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::sampling_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

constexpr hl::Plain o{};

// --- elementary functions --------------------------------------------------------------------------------

/// 1/(2i + 1): of atanh(z)/z in powers of z^2
constexpr std::array<double, 10> atanh_coefficients = [] {
    std::array<double, 10> c{};
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = 1.0 / static_cast<double>(2 * i + 1);
    return c;
}();

/// -log(x) for normal x <= 1.
///   error   relative, 1e-15
HWY_INLINE double minus_log(double x) {
    constexpr std::int64_t root_half = 0x3fe6a09e667f3bcd;
    const std::int64_t above = o.bits(x) - root_half;
    const std::int64_t exponent = above >> 52;
    const double m = o.from_bits(o.bits(x) - (exponent << 52));  // sqrt(1/2) ... sqrt(2)
    const double z = (1 - m) / (1 + m);
    return o.mul_add(2 * z, hl::polynomial(o, atanh_coefficients, z * z),
                     static_cast<double>(-exponent) * std::numbers::ln2);
}

/// Taylor's coefficients of sin(y)/y and of cos(y) in powers of w^2, y = pi w / 2.
template <std::size_t size>
constexpr std::array<double, size> taylor(int first) {
    std::array<double, size> c{};
    const double quarter = std::numbers::pi / 2;
    double term = first == 1 ? quarter : 1;
    for (std::size_t i = 0; i < size; ++i) {
        c[i] = term;
        const int n = first + 2 * static_cast<int>(i);
        term *= -quarter * quarter / ((n + 1) * (n + 2));
    }
    return c;
}
constexpr auto sine_coefficients = taylor<8>(1);
constexpr auto cosine_coefficients = taylor<8>(0);

/// A point of the plane.
struct PlanePoint {
    double x, y;
};

/// The point of the unit circle u turns from (-1, 0), by doubling a quarter of its azimuth twice.
///   error   1e-15
HWY_INLINE PlanePoint on_circle(double u) {
    const double w = u - 0.5;
    const double s1 = w * hl::polynomial(o, sine_coefficients, w * w);
    const double c1 = hl::polynomial(o, cosine_coefficients, w * w);
    const double s2 = 2 * s1 * c1;
    const double c2 = 1 - 2 * s1 * s1;
    return {1 - 2 * s2 * s2, 2 * s2 * c2};
}

// --- stretching ------------------------------------------------------------------------------------------

/// |S v|^2; S is 1 above an isotropic surface.
///   squared   |v|^2
HWY_INLINE double stretched_squared(const Light& /*light*/, PlanePoint /*v*/, double squared) {
    return squared;
}
HWY_INLINE double stretched_squared(const StretchedLight& light, PlanePoint v, double /*squared*/) {
    const double x = o.mul_add(light.xx, v.x, light.xy * v.y);
    const double y = o.mul_add(light.xy, v.x, light.yy * v.y);
    return o.mul_add(x, x, y * y);
}

/// What a normal density of slopes becomes when it is cut in two by q_x = 0 and weighted by q_x.
HWY_INLINE double over_reach(const Light& /*light*/, double density) {
    return density;
}
HWY_INLINE double over_reach(const StretchedLight& light, double density) {
    return density / light.reach;
}

/// S^-1 p
HWY_INLINE PlanePoint unstretched(const Light& /*light*/, PlanePoint p) {
    return p;
}
HWY_INLINE PlanePoint unstretched(const StretchedLight& light, PlanePoint p) {
    return {light.yy * p.x - light.xy * p.y, light.xx * p.y - light.xy * p.x};
}

/// S^-1 of a point given along the direction in which S^-1 reaches farthest in x, and across it.
HWY_INLINE PlanePoint unstretched_forward(const Light& /*light*/, PlanePoint p) {
    return p;
}
HWY_INLINE PlanePoint unstretched_forward(const StretchedLight& light, PlanePoint p) {
    const double c = light.yy / light.reach, s = -light.xy / light.reach;
    return unstretched(light, {c * p.x - s * p.y, s * p.x + c * p.y});
}

/// |v|^2
///   squared   the same before it was unstretched
HWY_INLINE double unstretched_squared(const Light& /*light*/, PlanePoint /*v*/, double squared) {
    return squared;
}
HWY_INLINE double unstretched_squared(const StretchedLight& /*light*/, PlanePoint v, double /*squared*/) {
    return o.mul_add(v.x, v.x, v.y * v.y);
}

/// The point or its partner, which has the opposite x and the same density: mirrored above an isotropic
/// surface, else the point across the centre.
HWY_INLINE PlanePoint partner(const Light& /*light*/, PlanePoint v) {
    return {-v.x, v.y};
}
HWY_INLINE PlanePoint partner(const StretchedLight& /*light*/, PlanePoint v) {
    return {-v.x, -v.y};
}
template <class AnyLight>
HWY_INLINE PlanePoint forward(const AnyLight& light, PlanePoint v) {
    return v.x >= 0 ? v : partner(light, v);
}

// --- densities -------------------------------------------------------------------------------------------

/// `out` where the light is (sine, 0, cosine).
HWY_INLINE Vector3 in_frame_of(const Direction& in, const Direction& out) {
    const double across = out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi();
    const double along = o.mul_add(out.cos_phi(), in.cos_phi(), out.sin_phi() * in.sin_phi());
    return {out.sin_theta() * along, out.sin_theta() * across, out.cos_theta()};
}

struct Skews {
    double lowered, raised;
};

/// factor (1 + q_x a), the bracket moved into 0 ... 2, for both skews a; 2 in its place where the facet of
/// -q_x mirrors the light to below the horizon. No jumps, since none could be foreseen.
HWY_INLINE Skews skewed(const Mixture& m, const Light& light, double q_x, double q_squared, double factor) {
    const double partner = o.neg_mul_add(2 * light.sine, q_x, light.cosine * (1 - q_squared));  // > 0: above
#if HWY_TARGET == HWY_SCALAR
    const auto one = [&](double a) {
        return factor * (partner > 0 ? o.min(o.max(o.mul_add(a, q_x, 1.0), 0.0), 2.0) : 2.0);
    };
    return {one(m.lowered_skew), one(m.raised_skew)};
#else
    constexpr hn::CappedTag<double, 2> two;
    const auto most = hn::Set(two, 2.0);
    const auto bracket = hn::MulAdd(hn::Load(two, &m.lowered_skew), hn::Set(two, q_x), hn::Set(two, 1.0));
    const auto inside = hn::Min(hn::Max(bracket, hn::Zero(two)), most);
    const auto either = hn::IfThenElse(hn::Gt(hn::Set(two, partner), hn::Zero(two)), inside, most);
    const auto both = hn::Mul(either, hn::Set(two, factor));
    return {hn::GetLane(both), hn::GetLane(hn::Reverse2(two, both))};
#endif
}

/// Sum over all diffuse parts. Since every density is at least that of the uniform one, what lies below
/// 2^-1021 of another is not missed.
template <class AnyLight>
HWY_INLINE double density(const Mixture& m, const AnyLight& light, Vector3 out) {
    constexpr hn::CappedTag<double, lanes> d;
    constexpr hl::WideLanes<hn::CappedTag<double, lanes>> wide;
    const double v_x = light.sine + out.x;
    const double horizontal = o.mul_add(v_x, v_x, out.y * out.y);
    const double inverse_v_z = 1 / o.max(light.cosine + out.z, 1e-60);
    const double q_x = v_x * inverse_v_z;
    const double q_squared = horizontal * (inverse_v_z * inverse_v_z);
    const double per_slopes = o.mul_add(q_squared, inverse_v_z, inverse_v_z);  // |v|^2 / v_z^3
    const Skews skews = skewed(m, light, q_x, q_squared, per_slopes);
    const auto lowered = hn::Set(d, skews.lowered);
    const auto raised = hn::Set(d, skews.raised);
    const double extent = stretched_squared(light, {v_x, out.y}, horizontal);
    const auto facets = hn::Set(d, extent * (inverse_v_z * inverse_v_z));
    const auto grazing =
        hn::Mul(hn::Max(hn::Set(d, q_x), hn::Zero(d)), hn::Set(d, over_reach(light, per_slopes)));
    // the beam's, doubled where the point across its centre lies outside the circle of directions
    const double across = o.neg_mul_add(2 * light.sine, v_x, light.cosine * light.cosine) - horizontal;
    const auto z = hn::Set(d, out.z);
    const auto projected = hn::IfThenElse(hn::Gt(hn::Set(d, across), hn::Zero(d)), z, hn::Add(z, z));
    const auto first = hn::FirstN(d, 1);
    auto sum = hn::Zero(d);
    HTS_UNROLL
    for (std::size_t i = 0; i < lanes; i += hn::MaxLanes(d)) {
        const auto at = [&](const Mixture::Lanes& values) HWY_ATTR { return hn::Load(d, values.data() + i); };
        const auto variable = i == 0 ? hn::IfThenElse(first, hn::Set(d, extent), facets) : facets;
        const auto beside = i == 0 ? hn::IfThenElse(first, projected, grazing) : grazing;
        const auto exponent = hn::Max(hn::Mul(at(m.rate), variable), hn::Set(d, -1021.0));
        auto factor = hn::Mul(at(m.grazing), beside);
        factor = hn::MulAdd(at(m.lowered), lowered, factor);
        factor = hn::MulAdd(at(m.raised), raised, factor);
        sum = hn::MulAdd(hl::exp2<10>(wide, exponent), factor, sum);
    }
    const double flat = o.mul_add(m.cosine, o.mul_add(light.sine, out.x, 1.0), m.uniform_diffuse);
    return hn::GetLane(hn::SumOfLanes(d, sum)) + o.mul_add(out.z, flat, m.uniform);
}

// --- draws -----------------------------------------------------------------------------------------------

/// The part that a uniform number chooses, `parts` or more for none.
HWY_INLINE std::size_t chosen(const Mixture& m, double u) {
    constexpr hn::CappedTag<double, 4> d;
    std::size_t part = 0;
    HTS_UNROLL
    for (std::size_t i = 0; i < m.sums.size(); i += hn::MaxLanes(d))
        part += hn::CountTrue(d, hn::Ge(hn::Set(d, u), hn::Load(d, m.sums.data() + i)));
    return part;
}

/// x, or -x with the probability that makes the density p(x) = skew/2 of p(x) + p(-x).
HWY_INLINE double reversed(double x, double skew, double u) {
    return 2 * u < skew ? x : -x;
}
template <class AnyLight>
HWY_INLINE PlanePoint reversed(const AnyLight& light, PlanePoint v, double skew, double u) {
    return 2 * u < skew ? v : partner(light, v);
}

/// Where the facet of slopes q mirrors the light.
HWY_INLINE Vector3 mirrored(const Light& light, PlanePoint q) {
    const double k =
        2 * o.mul_add(light.sine, q.x, light.cosine) / o.mul_add(q.x, q.x, o.mul_add(q.y, q.y, 1.0));
    return {o.mul_add(k, q.x, -light.sine), k * q.y, k - light.cosine};
}

template <class AnyLight>
HWY_INLINE PlanePoint facet(const Mixture& m, const AnyLight& light, std::size_t part, PlanePoint turn,
                            const Uniforms& u) {
    const double alpha = roots_of_widths[part % 3] * m.alpha;
    const double radius = alpha * std::sqrt(minus_log(1 - u[1]));
    if (part >= grazing_half)
        return unstretched_forward(light, {radius, alpha * std::sqrt(minus_log(1 - u[0])) * turn.y});
    // the more raised of the pair first: if one is above the horizon, it is
    const PlanePoint q = forward(light, unstretched(light, {radius * turn.x, radius * turn.y}));
    const Skews skews = skewed(m, light, q.x, unstretched_squared(light, q, radius * radius), 1);
    return reversed(light, q, part < raised_half ? skews.lowered : skews.raised, u[0]);
}

HWY_INLINE Vector3 hemisphere_point(double z, PlanePoint turn) {
    const double radius = std::sqrt((1 - z) * (1 + z));
    return {radius * turn.x, radius * turn.y, z};
}

/// v_xy of the beam, or its partner: either if both lie inside the circle of
/// directions, else the one that does.
template <class AnyLight>
HWY_INLINE PlanePoint drawn_across(const AnyLight& light, PlanePoint v, double horizontal, double u) {
    const PlanePoint in_front = forward(light, v);
    const double across = light.cosine * light.cosine - 2 * light.sine * in_front.x - horizontal;
    return reversed(light, in_front, across > 0 ? 1 : 2, u);
}

template <class AnyLight>
HWY_INLINE Vector3 drawn_from(const Mixture& m, const AnyLight& light, std::size_t part, const Uniforms& u) {
    const PlanePoint turn = on_circle(u[2]);
    if (part < beam) return mirrored(light, facet(m, light, part, turn, u));
    if (part == beam) {
        const double radius = m.beam_radius * std::sqrt(minus_log(1 - u[1]));
        const PlanePoint v = unstretched(light, {radius * turn.x, radius * turn.y});
        const auto [v_x, y] = drawn_across(light, v, unstretched_squared(light, v, radius * radius), u[0]);
        const double x = v_x - light.sine;
        return {x, y, std::sqrt(o.max(1 - x * x - y * y, 0.0))};
    }
    Vector3 out = hemisphere_point(part == uniform ? 1 - u[1] : std::sqrt(1 - u[1]), turn);
    if (part == cosine) out.x = reversed(out.x, 1 + light.sine * out.x, u[0]);
    return out;
}

template <class AnyLight>
HWY_INLINE Drawn draw(const Mixture& m, const AnyLight& light, const Uniforms& u) {
    const std::size_t part = chosen(m, u[0]);
    if (part >= diffuse_parts) return {{0, 0, 0}, part, 0};
    const double below = part > 0 ? m.sums[part - 1] : 0;
    // NaN only if rounding chose a part of share 0
    const double rest = o.min((u[0] - below) / o.max(m.sums[part] - below, 1e-300), 1 - 0x1p-53);
    const Vector3 out = drawn_from(m, light, part, {rest, u[1], u[2]});
    return {out, part, out.z > 0 ? density(m, light, out) : 0};
}

}  // namespace hts::sampling_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
