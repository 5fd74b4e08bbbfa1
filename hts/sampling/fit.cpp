// The mixtures of the sampler: shares of the least variance at each node, by trial
// draws from every component.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <numeric>

#include "hts/sampling/simd.hpp"

namespace hts::sampling_detail {
namespace {

constexpr std::size_t trials = 1200;  // per node: a hundred of each component
constexpr int rounds = 12;
constexpr double least_share = 0.002;          // less is dropped
constexpr double least_uniform_share = 0.004;  // bounds every weight

using Components = std::array<double, components>;

double square(double x) {
    return x * x;
}

/// A cosine that stands for those of a mixture.
double cosine_of(std::size_t index) {
    if (index == 0) return 1.5e-3;
    if (index + 1 == mixture_count) return 1;
    const auto [octave, eighth] = std::div(static_cast<int>(index) - 1, 8);
    return std::ldexp(1 + (eighth + 0.5) / 8, octave - 8);
}

/// How far a lobe reaches in units of that of one term: the root of the mean m of Phi's Poisson sum. Of
/// another correlation half the q at which the lobe has fallen by e, which for exp(-q^2/4m) is the same.
double reach(const Surface& surface, double g) {
    const double mean = g > 0 ? g / -std::expm1(-g) : 1;  // of m >= 1
    if (!surface.correlation() || !(g > 0)) return std::sqrt(mean);
    const double threshold = surface.correlation()->lobe(g, 0).log - 1;
    double below = -20, above = 40;  // ln q
    for (int i = 0; i < 30; ++i) {
        const double middle = (below + above) / 2;
        (surface.correlation()->lobe(g, std::exp(middle)).log > threshold ? below : above) = middle;
    }
    return std::exp(below) / 2;
}

/// The widths that follow Phi: those of the mean m of its Poisson sum. At grazing light cos theta_i
/// understates v_z over the lobe, whose extent in v_xy is 2/(k tau) at least.
Mixture scales(const ScatteringLobe& lobe, const Direction& in) {
    const double k_tau = lobe.wave_number * lobe.surface.correlation_length();
    const double c = in.cos_theta();
    const double s = in.sin_theta();
    const double vertical = 2 * std::min(1.0, std::sqrt(c * c + std::min(1.0, s / k_tau)));
    const double g = square(lobe.wave_number * lobe.effective_roughness(in) * vertical);
    const double extent = reach(lobe.surface, g);
    Mixture m;
    m.alpha = std::clamp(2 / (k_tau * vertical) * extent, 1e-12, 8.0);
    m.beam_radius = std::clamp(2 * extent / k_tau, 1e-12, 30.0);
    m.lowered_skew = (s - 1) / c;
    m.raised_skew = (1 + s) / c;
    m.rate[0] = -std::numbers::log2e / square(m.beam_radius);
    for (std::size_t i = 0; i < 3; ++i) m.rate[i + 1] = -std::numbers::log2e / (widths[i] * square(m.alpha));
    return m;
}

/// Gives a part a share.
void set_factor(Mixture& m, std::size_t part, double share) {
    using std::numbers::inv_pi;
    constexpr double inv_sqrtpi = std::numbers::inv_sqrtpi;
    const std::size_t lane = part < beam ? part % 3 + 1 : 0;
    const double alpha = roots_of_widths[part % 3] * m.alpha;
    // of a facet lobe exp(-x) d^2q = ... |v|^2/(2 v_z^3) d omega
    const double of_facets = share * inv_pi / 2 / square(alpha);
    if (part < raised_half)
        m.lowered[lane] = of_facets;
    else if (part < grazing_half)
        m.raised[lane] = of_facets;
    else if (part < beam)
        m.grazing[lane] = share * inv_sqrtpi / (square(alpha) * alpha);
    else if (part == beam)
        m.grazing[lane] = share * inv_pi / square(m.beam_radius);
    else if (part == cosine)
        m.cosine = share * inv_pi;
    else if (part == uniform)
        m.uniform = share * inv_pi / 2;
    else if (part == uniform_diffuse)
        m.uniform_diffuse = share * inv_pi;
}

/// The fraction of i golden steps of dimension 1, 2 or 3: points that fill a cube evenly.
double golden_fraction(std::size_t i, std::size_t dimension) {
    constexpr std::array<double, 3> step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    const double x = 0.5 + step[dimension] * static_cast<double>(i + 1);
    return x - std::floor(x);
}

/// Mixtures of one component each, all of its share.
std::array<Mixture, components> alone(const Mixture& scales) {
    std::array<Mixture, components> result;
    for (std::size_t i = 0; i < components; ++i) {
        result[i] = scales;
        set_factor(result[i], i, 1);
    }
    return result;
}

/// A direction tried, what is reflected there, and the density of each component.
struct Trial {
    double reflected;  // brdf cos theta_r, over the density of the trials
    Components densities;
};

struct Trials {
    std::vector<Trial> each;
    double albedo;
};

/// The same number of draws from each component.
Trials tried(const ScatteringLobe& lobe, const Direction& in, const Mixture& scales) {
    const bool isotropic = lobe.surface.isotropic();
    const Light light{in.cos_theta(), in.sin_theta()};
    const StretchedLight stretched{lobe.surface, in};
    const std::array<Mixture, components> each = alone(scales);
    Trials result{{}, 0};
    result.each.reserve(trials);
    for (std::size_t i = 0; i < trials; ++i) {
        const Uniforms u{golden_fraction(i, 0), golden_fraction(i, 1), golden_fraction(i, 2)};
        const Vector3 out = isotropic ? forms().drawn_from(scales, light, i % components, u)
                                      : forms().stretched_drawn_from(scales, stretched, i % components, u);
        if (!(out.z > 0)) continue;
        Trial trial{};
        for (std::size_t k = 0; k < components; ++k)
            trial.densities[k] = isotropic ? forms().density(each[k], light, out)
                                           : forms().stretched_density(each[k], stretched, out);
        const double mean =
            std::accumulate(trial.densities.begin(), trial.densities.end(), 0.0) / std::size_t{components};
        trial.reflected = lobe.brdf({in, Direction::from_vector(out_of_frame(in, out))}) * (out.z / mean);
        if (!(trial.reflected > 0 && std::isfinite(trial.reflected))) continue;
        for (double& density : trial.densities) density /= mean;
        result.each.push_back(trial);
        result.albedo += trial.reflected / trials;
    }
    return result;
}

/// Shares of the least second moment of reflected/density: there every component in use has the same
/// integral of reflected^2 density_i/density^2, so a share grows by the root of its own.
///   shares   to start from: those of the angle before, each at least a little
Components shares_of_least_variance(const Trials& trials_of_node, Components shares) {
    for (double& share : shares) share += 0.02;
    for (int round = 0; round < rounds; ++round) {
        Components gain{};
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

/// Factors and sums of the shares of every part.
void set_shares(Mixture& mixture, const std::array<double, parts>& shares) {
    for (std::size_t i = 0; i < diffuse_parts; ++i) set_factor(mixture, i, shares[i]);
    mixture.sums.fill(2);
    std::partial_sum(shares.begin(), shares.end(), mixture.sums.begin());
}

/// The mixture of one light; all shares 0 where nothing is reflected.
///   of_lobe  shares of its components, in place of those of an angle near by
Mixture fitted(const ScatteringLobe& lobe, const Direction& in, Components& of_lobe) {
    Mixture mixture = scales(lobe, in);
    const Trials results = tried(lobe, in, mixture);
    const double mirror = lobe.mirror(in);
    const double total = mirror + results.albedo + lobe.diffuse_albedo;
    std::array<double, parts> shares{};
    if (total > 0) {
        shares[specular] = mirror / total;
        shares[uniform_diffuse] = lobe.diffuse_albedo / total;
    }
    if (results.albedo > 0) {
        of_lobe = shares_of_least_variance(results, of_lobe);
        for (std::size_t i = 0; i < components; ++i) shares[i] = of_lobe[i] * results.albedo / total;
    }
    set_shares(mixture, shares);
    return mixture;
}

/// A direction in the middle of a part of the azimuths.
Direction plane_of(const Surface& surface, std::size_t azimuth) {
    if (surface.isotropic()) return surface.axis();
    const double turn = std::numbers::pi / 2 * (static_cast<double>(azimuth) + 0.5) / azimuth_count;
    const double c = std::cos(turn), s = std::sin(turn);
    return Direction::from_unit_vector({surface.axis().cos_phi() * c - surface.axis().sin_phi() * s,
                                        surface.axis().sin_phi() * c + surface.axis().cos_phi() * s, 0});
}

}  // namespace

std::size_t azimuth_index(const Surface& surface, const Direction& in) noexcept {
    static const std::array<double, azimuth_count - 1> cosines = [] {
        std::array<double, azimuth_count - 1> c{};
        for (std::size_t i = 0; i < c.size(); ++i)
            c[i] = std::cos(std::numbers::pi / 2 * static_cast<double>(i + 1) / azimuth_count);
        return c;
    }();
    const double cosine =
        std::abs(in.cos_phi() * surface.axis().cos_phi() + in.sin_phi() * surface.axis().sin_phi());
    return static_cast<std::size_t>(
        std::count_if(cosines.begin(), cosines.end(), [&](double limit) { return cosine < limit; }));
}

std::vector<Mixture> fitted_mixtures(const ScatteringLobe& lobe) {
    const std::size_t azimuths = lobe.surface.isotropic() ? 1 : azimuth_count;
    std::vector<Mixture> result;
    result.reserve(azimuths * mixture_count);
    for (std::size_t azimuth = 0; azimuth < azimuths; ++azimuth) {
        const Direction plane = plane_of(lobe.surface, azimuth);
        Components shares{};
        for (std::size_t i = 0; i < mixture_count; ++i) {
            const double cosine = cosine_of(i), sine = std::sqrt((1 - cosine) * (1 + cosine));
            const Direction in =
                Direction::from_vector({sine * plane.cos_phi(), sine * plane.sin_phi(), cosine});
            result.push_back(fitted(lobe, in, shares));
        }
    }
    return result;
}

}  // namespace hts::sampling_detail
