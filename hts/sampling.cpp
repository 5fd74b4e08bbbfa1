#include "hts/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "hts/roughness.hpp"

namespace hts {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inv_pi = std::numbers::inv_pi;

double square(double x) {
    return x * x;
}

// --- the mixture -----------------------------------------------------------------------------------------

/// The densities of the header, each facet lobe once per width.
enum Component : std::size_t {
    visible_half,
    visible_1,
    visible_2,
    raised_half,
    raised_1,
    raised_2,
    grazing_1,
    grazing_4,
    grazing_16,
    beam,
    cosine,
    uniform,
    components
};

/// alpha^2 of a facet lobe over that of the mixture.
constexpr std::array<double, 9> width{0.5, 1, 2, 0.5, 1, 2, 1, 4, 16};

/// What a mixture consists of at one angle of incidence: probability of each component, of the other lobes, and scales.
enum Entry : std::size_t {
    specular_share = components,
    uniform_diffuse_share,
    inverse_alpha_squared,
    beam_scale,
    entries
};

using Mixture = std::array<double, entries>;

/// The light as (sine, 0, cosine). Any skew keeps the densities normalised, and a distant cotangent only ends a lobe, so
/// zeros may be moved.
struct Light {
    double cosine, sine, inverse_cosine;

    explicit Light(const Direction& in)
        : cosine{in.cos_theta()}, sine{in.sin_theta()}, inverse_cosine{1 / std::max(cosine, 1e-9)} {}

    [[nodiscard]] double visible_skew() const { return sine * inverse_cosine; }
    [[nodiscard]] double raised_skew() const { return (1 + sine) * inverse_cosine; }
    [[nodiscard]] double cotangent() const { return cosine / std::max(sine, 1e-9); }
};

/// 1 + q_x a, moved into 0 ... 2.
double skewed(double a, double q_x) {
    return std::clamp(1 + a * q_x, 0.0, 2.0);
}

using Densities = std::array<double, components>;

/// Density of each component in solid angle [1/sr], 0 of one that is not wanted.
///   out   unit, z > 0
template <class Wanted>
Densities densities(const Light& light, const Mixture& mixture, Vector3 out, const Wanted& wanted) {
    const double inverse_alpha = mixture[inverse_alpha_squared];
    Densities d{};
    const double v_x = light.sine + out.x;
    const double v_z = light.cosine + out.z;
    const double horizontal = v_x * v_x + out.y * out.y;
    if (wanted(beam))
        d[beam] = mixture[beam_scale] * inv_pi * out.z * std::exp(-mixture[beam_scale] * horizontal);
    d[cosine] = out.z * inv_pi * (1 + light.sine * out.x);
    d[uniform] = inv_pi / 2;
    if (v_z < 1e-90) return d;
    const double inverse_v_z = 1 / v_z;
    const double q_x = v_x * inverse_v_z;
    const double q_squared = horizontal * inverse_v_z * inverse_v_z;
    const double x = q_squared * inverse_alpha;
    // solid angle per slopes: |v|^2 / (2 v_z^3)
    const double peak = inverse_alpha * (inv_pi / 2) * (1 + q_squared) * inverse_v_z;
    const double e2 = std::exp(-x / 2);
    const double e1 = e2 * e2;
    const double visible = peak * skewed(light.visible_skew(), q_x);
    const double raised = peak * skewed(light.raised_skew(), q_x);
    d[visible_half] = visible * e1 * e1 * 2;
    d[visible_1] = visible * e1;
    d[visible_2] = visible * e2 / 2;
    d[raised_half] = raised * e1 * e1 * 2;
    d[raised_1] = raised * e1;
    d[raised_2] = raised * e2 / 2;
    if (q_x * light.sine > light.cosine && (wanted(grazing_1) || wanted(grazing_4) || wanted(grazing_16))) {
        const double tail = std::exp((square(light.cotangent()) * inverse_alpha - x) / 16);
        const double tail_4 = square(square(tail));
        const double scaled = peak * 2 * std::sqrt(pi * inverse_alpha) * q_x;
        d[grazing_1] = scaled * square(square(tail_4));
        d[grazing_4] = scaled * tail_4 / 8;
        d[grazing_16] = scaled * tail / 64;
    }
    return d;
}

/// Density of all of them, and of the uniform-diffuse lobe.
double density(const Light& light, const Mixture& mixture, Vector3 out) {
    const Densities each =
        densities(light, mixture, out, [&mixture](Component component) { return mixture[component] > 0; });
    double sum = mixture[uniform_diffuse_share] * out.z * inv_pi;
    for (std::size_t i = 0; i < components; ++i) sum += mixture[i] * each[i];
    return sum;
}

/// A point of the plane, normal with variance 1/2 per axis.
struct PlanePoint {
    double x, y;
};

PlanePoint on_circle(double radius, double u) {
    const double azimuth = 2 * pi * u;
    return {radius * std::cos(azimuth), radius * std::sin(azimuth)};
}

PlanePoint normal_point(double u1, double u2) {
    return on_circle(std::sqrt(-std::log(1 - u1)), u2);
}

/// x, or -x with the probability that makes the density p(x) = skew/2 of p(x) + p(-x).
double reversed(double x, double skew, double u) {
    return 2 * u < skew ? x : -x;
}

/// Where the facet of slopes q mirrors the light.
Vector3 mirrored(const Light& light, PlanePoint q) {
    const double k = 2 * (light.sine * q.x + light.cosine) / (1 + q.x * q.x + q.y * q.y);
    return {k * q.x - light.sine, k * q.y, k - light.cosine};
}

PlanePoint facet(const Light& light, Component component, double alpha, const DirectionSampler::Uniforms& u) {
    PlanePoint q = normal_point(u[1], u[2]);
    q.x *= alpha;
    q.y *= alpha;
    if (component < grazing_1) {
        const double skew = component < raised_half ? light.visible_skew() : light.raised_skew();
        return {reversed(q.x, skewed(skew, q.x), u[0]), q.y};
    }
    // |q|^2 of the normal point serves for q_x, its one azimuth and another radius for q_y
    const double q_y = alpha * on_circle(std::sqrt(-std::log(1 - u[0])), u[2]).y;
    return {std::sqrt(square(light.cotangent()) - square(alpha) * std::log(1 - u[1])), q_y};
}

Vector3 hemisphere_point(double z, double u) {
    const PlanePoint p = on_circle(std::sqrt((1 - z) * (1 + z)), u);
    return {p.x, p.y, z};
}

/// Draws from one component; z <= 0 where the draw is none.
Vector3 drawn(const Light& light, const Mixture& mixture, Component component,
              const DirectionSampler::Uniforms& u) {
    switch (component) {
        case uniform:
            return hemisphere_point(1 - u[1], u[2]);
        case cosine: {
            Vector3 out = hemisphere_point(std::sqrt(1 - u[1]), u[2]);
            out.x = reversed(out.x, 1 + light.sine * out.x, u[0]);
            return out;
        }
        case beam: {
            const PlanePoint p = normal_point(u[1], u[2]);
            const double scale = 1 / std::sqrt(mixture[beam_scale]);
            const double x = scale * p.x - light.sine;
            const double y = scale * p.y;
            return {x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))};
        }
        default:
            return mirrored(light, facet(light, component,
                                         std::sqrt(width[component] / mixture[inverse_alpha_squared]), u));
    }
}

// --- its shares ------------------------------------------------------------------------------------------

constexpr std::size_t node_count = 33;
constexpr std::size_t trials = 1200;  // per node: a hundred of each component
constexpr int rounds = 30;
constexpr double least_share = 0.002;          // less is dropped, to save its cost
constexpr double least_uniform_share = 0.004;  // bounds every weight

/// Nodes lie evenly in sqrt(cos theta), the more densely the more the light grazes.
double node_cosine(std::size_t node) {
    return std::max(square(static_cast<double>(node) / (node_count - 1)), 1e-4);
}

/// The widths that follow Phi: those of the mean m of its Poisson sum. At grazing light cos theta_i understates v_z over
/// the lobe, whose extent in v_xy is 2/(k tau) at least.
void set_scales(Mixture& mixture, const Surface& surface, const View& in, double wave_number) {
    const double k_tau = wave_number * surface.correlation_length();
    const double c = in.direction.cos_theta();
    const double vertical =
        2 * std::min(1.0, std::sqrt(c * c + std::min(1.0, in.direction.sin_theta() / k_tau)));
    const double sigma = surface.rms_roughness() * effective_roughness_ratio(2 * in.visibility.obstruction);
    const double g = square(wave_number * sigma * vertical);
    const double mean = g > 0 ? g / -std::expm1(-g) : 1;  // of m >= 1
    const double alpha = std::clamp(2 / (k_tau * vertical) * std::sqrt(mean), 1e-12, 8.0);
    mixture[inverse_alpha_squared] = 1 / square(alpha);
    mixture[beam_scale] = std::clamp(square(k_tau) / (8 * mean), 1e-3, 1e24);
}

/// The fraction of i golden steps of dimension 1, 2 or 3: points that fill a cube evenly.
double golden_fraction(std::size_t i, std::size_t dimension) {
    constexpr std::array<double, 3> step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    const double x = 0.5 + step[dimension] * static_cast<double>(i + 1);
    return x - std::floor(x);
}

/// A direction tried, what is reflected there, and the density of each component.
struct Trial {
    double reflected;  // brdf cos theta_r, over the density of the trials
    Densities densities;
};

struct Trials {
    std::vector<Trial> each;
    double albedo;
};

/// The same number of draws from each component.
///   lobe   the directional-diffuse term alone
Trials tried(const PreparedReflectance& lobe, const Direction& in, const Mixture& scales) {
    const Light light{in};
    Trials result{{}, 0};
    for (std::size_t i = 0; i < trials; ++i) {
        const auto component = static_cast<Component>(i % components);
        const Vector3 out = drawn(light, scales, component,
                                  {golden_fraction(i, 0), golden_fraction(i, 1), golden_fraction(i, 2)});
        if (!(out.z > 0)) continue;
        const Densities d = densities(light, scales, out, [](Component) { return true; });
        double mean = 0;
        for (const double density : d) mean += density / std::size_t{components};
        double brdf = 0;
        lobe.brdf({in, Direction::from_vector(out)}, {&brdf, 1});
        const double reflected = brdf * out.z / mean;
        if (!(reflected > 0 && std::isfinite(reflected))) continue;
        result.each.push_back({reflected, d});
        result.albedo += reflected / trials;
        for (double& density : result.each.back().densities) density /= mean;
    }
    return result;
}

/// Shares of the least second moment of reflected/density: there every component in use has the same
/// integral of reflected^2 density_i/density^2, so a share grows by the root of its own.
Densities shares_of_least_variance(const Trials& trials_of_node) {
    Densities shares;
    shares.fill(1.0 / std::size_t{components});
    for (int round = 0; round < rounds; ++round) {
        Densities gain{};
        for (const Trial& trial : trials_of_node.each) {
            double mixed = 0;
            for (std::size_t i = 0; i < components; ++i) mixed += shares[i] * trial.densities[i];
            const double factor = square(trial.reflected / trials_of_node.albedo / mixed);
            for (std::size_t i = 0; i < components; ++i) gain[i] += factor * trial.densities[i];
        }
        double sum = 0;
        for (std::size_t i = 0; i < components; ++i) sum += shares[i] *= std::sqrt(gain[i]);
        for (double& share : shares) share /= sum;
    }
    for (double& share : shares) share = share < least_share ? 0 : share;
    shares[uniform] = std::max(shares[uniform], least_uniform_share);
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= sum;
    return shares;
}

/// The mixture at one angle; empty where nothing is reflected.
///   lobe   the directional-diffuse term alone
Mixture fitted(const PreparedReflectance& lobe, double uniform_diffuse_albedo, double cosine_in) {
    const SpectralSample& sample = lobe.samples().front();
    const Direction in = Direction::from_vector({std::sqrt((1 - cosine_in) * (1 + cosine_in)), 0, cosine_in});
    const View seen = view(lobe.surface(), in);
    Mixture mixture{};
    set_scales(mixture, lobe.surface(), seen, sample.wavelength.wave_number());
    const Trials results = tried(lobe, in, mixture);
    const double specular =
        specular_reflectance(lobe.surface(), seen, sample.wavelength, sample.index).value();
    const double total = specular + results.albedo + uniform_diffuse_albedo;
    if (!(total > 0)) return mixture;
    mixture[specular_share] = specular / total;
    mixture[uniform_diffuse_share] = uniform_diffuse_albedo / total;
    if (!(results.albedo > 0)) return mixture;
    const Densities shares = shares_of_least_variance(results);
    for (std::size_t i = 0; i < components; ++i) mixture[i] = shares[i] * results.albedo / total;
    return mixture;
}

/// Interpolated between the two nodes about a direction.
Mixture mixture_at(std::span<const double> nodes, const Direction& in) {
    const double place = std::sqrt(in.cos_theta()) * (node_count - 1);
    const std::size_t node = std::min(static_cast<std::size_t>(place), node_count - 2);
    const double second = place - static_cast<double>(node);
    const double* const a = nodes.data() + node * entries;
    Mixture mixture;
    for (std::size_t i = 0; i < entries; ++i) mixture[i] = (1 - second) * a[i] + second * a[i + entries];
    return mixture;
}

/// What a uniform number chooses, and where within its share: again uniform.
struct Choice {
    std::size_t entry;  // a component, specular_share, uniform_diffuse_share, or more: nothing
    double rest;
};

Choice chosen(const Mixture& mixture, double u) {
    std::size_t entry = 0;
    double sum = 0;
    double below = 0;
    for (std::size_t i = 0; i <= uniform_diffuse_share; ++i) {
        sum += mixture[i];
        const bool passed = u >= sum;
        entry += passed ? 1 : 0;
        below = passed ? sum : below;
    }
    const double share = entry <= uniform_diffuse_share ? mixture[entry] : 1;
    return {entry, std::min((u - below) / share, 1 - 0x1p-53)};
}

Vector3 in_frame_of(const Direction& in, const Direction& out) {
    return {out.sin_theta() * (out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi()),
            out.sin_theta() * (out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi()), out.cos_theta()};
}

Direction out_of_frame(const Direction& in, Vector3 v) {
    return Direction::from_unit_vector(
        {v.x * in.cos_phi() - v.y * in.sin_phi(), v.x * in.sin_phi() + v.y * in.cos_phi(), v.z});
}

}  // namespace

const char* name(Lobe lobe) noexcept {
    switch (lobe) {
        case Lobe::none:
            return "none";
        case Lobe::specular:
            return "specular";
        case Lobe::directional_diffuse:
            return "directional_diffuse";
        case Lobe::uniform_diffuse:
            return "uniform_diffuse";
    }
    return "";
}

DirectionSampler::DirectionSampler(const Surface& surface, const SpectralSample& sample, Tolerance tolerance)
    : reflectance_{surface, {sample}, tolerance} {
    const SpectralSample without_uniform{sample.wavelength, sample.index, 0};
    const PreparedReflectance directional{
        surface, {without_uniform}, Tolerance{accuracy::finest_lane_tolerance}};
    nodes_.reserve(node_count * entries);
    for (std::size_t i = 0; i < node_count; ++i) {
        const Mixture mixture = fitted(directional, sample.uniform_diffuse * pi, node_cosine(i));
        nodes_.insert(nodes_.end(), mixture.begin(), mixture.end());
    }
}

std::size_t DirectionSampler::bytes() const noexcept {
    return sizeof *this - sizeof reflectance_ + reflectance_.bytes() + nodes_.size() * sizeof(double);
}

double DirectionSampler::specular_probability(const Direction& in) const noexcept {
    return mixture_at(nodes_, in)[specular_share];
}

double DirectionSampler::pdf(const Direction& in, const Direction& out) const noexcept {
    if (!(out.cos_theta() > 0)) return 0;
    return density(Light{in}, mixture_at(nodes_, in), in_frame_of(in, out));
}

DirectionDraw DirectionSampler::draw(const Direction& in, const Uniforms& u) const noexcept {
    const Mixture mixture = mixture_at(nodes_, in);
    const Choice choice = chosen(mixture, u[0]);
    if (choice.entry == specular_share) return {in.mirror(), Lobe::specular, mixture[specular_share]};
    if (choice.entry > uniform_diffuse_share) return {in.mirror(), Lobe::none, 0};
    const Light light{in};
    const bool is_uniform = choice.entry == uniform_diffuse_share;
    const Vector3 out =
        is_uniform ? hemisphere_point(std::sqrt(1 - u[1]), u[2])
                   : drawn(light, mixture, static_cast<Component>(choice.entry), {choice.rest, u[1], u[2]});
    if (!(out.z > 0)) return {in.mirror(), Lobe::none, 0};
    return {out_of_frame(in, out), is_uniform ? Lobe::uniform_diffuse : Lobe::directional_diffuse,
            density(light, mixture, out)};
}

WeightedDirection DirectionSampler::sample(const Direction& in, const Uniforms& u) const noexcept {
    const DirectionDraw drawn_one = draw(in, u);
    const auto& [out, lobe, pdf] = drawn_one;
    if (lobe == Lobe::none) return {out, lobe, 0, 0};
    double value = 0;
    if (lobe == Lobe::specular) {
        const SpectralSample& sample = reflectance_.samples().front();
        value = specular_reflectance(surface(), view(surface(), in), sample.wavelength, sample.index).value();
    } else {
        reflectance_.brdf({in, out}, {&value, 1});
        value *= out.cos_theta();
    }
    return {out, lobe, value / pdf, pdf};
}

}  // namespace hts
