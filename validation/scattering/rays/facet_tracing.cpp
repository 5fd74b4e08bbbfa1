#include "validation/scattering/rays/facet_tracing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hts/sampling/random.hpp"
#include "hts/terms.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/parallel.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;
constexpr double period_over_tau = 24;
constexpr double half_width = 15;  // of the plane of incidence, in degrees of azimuth
constexpr double bin_width = 5;
constexpr std::size_t bin_count = 36;

/// So short that the lobe is that of geometric optics (g above 1e4 up to 89 deg).
Wavelength short_wavelength(double slope) {
    return Wavelength::from_micrometres(slope / 1000);
}

FacetSurface surface_number(double slope, int number, const TracingSettings& settings) {
    const auto samples = static_cast<std::size_t>(period_over_tau * settings.samples_per_tau);
    const auto part = static_cast<std::uint64_t>(std::lround(1e4 * slope));
    return FacetSurface{random_field({slope, 1}, 1.0 / settings.samples_per_tau, samples,
                                     seed_of(settings.study, part, static_cast<std::uint64_t>(number)))};
}

/// A part of the work on one surface has random numbers of its own.
Random random_numbers(const TracingSettings& settings, double theta_deg, int number) {
    return Random{seed_of(settings.study + 1, static_cast<std::uint64_t>(std::lround(100 * theta_deg)),
                          static_cast<std::uint64_t>(number))};
}

/// Towards the light at an angle, along x.
Vector3 towards(double theta_deg) {
    return {-std::sin(theta_deg * degree), 0, std::cos(theta_deg * degree)};
}

bool sees(const FacetSurface& surface, const FacetSurface::Hit& point, const Vector3& direction) {
    return dot(point.normal, direction) > 0 && !surface.first_hit({point.point, direction});
}

struct Seen {
    double lit = 0, both = 0;
};

Seen seen_share(const FacetSurface& surface, double theta_deg, const TracingSettings& settings, int number) {
    auto random = random_numbers(settings, theta_deg, number);
    const Vector3 light = towards(theta_deg), mirror{-light.x, 0, light.z};
    int lit = 0, both = 0;
    for (int i = 0; i < settings.points; ++i) {
        const double x = surface.period() * random.uniform();
        const auto point = surface.at(x, surface.period() * random.uniform());
        if (!sees(surface, point, light)) continue;
        ++lit;
        if (sees(surface, point, mirror)) ++both;
    }
    return {static_cast<double>(lit) / settings.points, static_cast<double>(both) / settings.points};
}

double square(double x) {
    return x * x;
}

/// Mean, and its standard error from the scatter of its parts.
struct Mean {
    double value = 0, error = 0;

    explicit Mean(const std::vector<double>& parts) {
        const auto count = static_cast<double>(parts.size());
        for (const double part : parts) value += part;
        value /= count;
        for (const double part : parts) error += square(part - value) / (count * (count - 1));
        error = std::sqrt(error);
    }
};

/// c of Smith's functions and Lambda from S_1 = (1 - erfc(c)/2)/(1 + Lambda).
struct Smith {
    double c, s_1, lambda;

    Smith(double slope, const Direction& direction)
        : c{direction.cos_theta() / (2 * slope * direction.sin_theta())},
          s_1{visibility(Surface{slope, 1}, direction).shadowing},
          lambda{(1 - std::erfc(c) / 2) / s_1 - 1} {}
};

/// What one surface does with the light of one direction.
struct Tally {
    int once = 0, more = 0, lost = 0;
    std::array<int, bin_count> bins{};
};

/// Bin of a direction near the plane of incidence, none elsewhere; 0 is grazing on the side of the source.
std::optional<std::size_t> bin_of(const Vector3& out) {
    const double azimuth = std::atan2(out.y, std::fabs(out.x)) / degree;
    if (std::fabs(azimuth) > half_width) return std::nullopt;
    const double theta = std::copysign(std::acos(std::min(1.0, out.z)) / degree, out.x);
    return std::min(bin_count - 1, static_cast<std::size_t>((theta + 90) / bin_width));
}

Vector3 mirrored(const Vector3& direction, const Vector3& normal) {
    return direction - (2 * dot(direction, normal) / dot(normal, normal)) * normal;
}

void trace(const FacetSurface& surface, FacetSurface::Ray ray, Tally& tally) {
    for (int bounces = 0; bounces <= most_bounces; ++bounces) {
        const auto hit = surface.first_hit(ray);
        if (!hit) {
            ++(bounces == 1 ? tally.once : tally.more);
            const auto bin = bounces == 1 ? bin_of(ray.direction) : std::nullopt;
            if (bin) ++tally.bins[*bin];
            return;
        }
        ray = {hit->point, mirrored(ray.direction, hit->normal)};
    }
    ++tally.lost;
}

Tally traced(const FacetSurface& surface, double theta_deg, const TracingSettings& settings, int number) {
    auto random = random_numbers(settings, theta_deg, number);
    Tally tally;
    for (int i = 0; i < settings.rays; ++i) {
        const double x = surface.period() * random.uniform();
        const double y = surface.period() * random.uniform();
        trace(surface, {{x, y, surface.highest() * (1 + 1e-9) + 1e-9}, -towards(theta_deg)}, tally);
    }
    return tally;
}

/// Mean of BRDF x cos theta_r over a bin.
template <class Brdf>
double bin_mean(double middle_deg, const Brdf& brdf) {
    constexpr int steps = 6;
    double sum = 0, weights = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = middle_deg + ((i + 0.5) / steps - 0.5) * bin_width;
        const double weight = std::sin(std::fabs(theta) * degree);
        for (int j = 0; j < steps; ++j) {
            const double azimuth = (j + 0.5) / steps * half_width;
            const auto out = Direction::from_degrees(std::fabs(theta), azimuth + (theta < 0 ? 180 : 0));
            sum += weight * brdf(out) * out.cos_theta();
            weights += weight;
        }
    }
    return sum / weights;
}

double smith_brdf(double slope, const Direction& in, const Direction& out) {
    const Vector3 half = in.vector() + out.vector();
    const double tangent_squared = (half.x * half.x + half.y * half.y) / (half.z * half.z);
    const double cosine_squared = 1 / (1 + tangent_squared), width_squared = 4 * slope * slope;
    const double density =
        std::exp(-tangent_squared / width_squared) / (pi * width_squared * cosine_squared * cosine_squared);
    const double shadowing = 1 / (1 + Smith{slope, in}.lambda + Smith{slope, out}.lambda);
    return density * shadowing / (4 * in.cos_theta() * out.cos_theta());
}

std::vector<LobePoint> lobe_points(double slope, double theta_i_deg, const std::vector<Tally>& tallies,
                                   int rays) {
    const Surface surface{slope, 1};
    const auto in = Direction::from_degrees(theta_i_deg, 180);
    std::vector<LobePoint> points;
    for (std::size_t bin = 0; bin < bin_count; ++bin) {
        const double low = static_cast<double>(bin) * bin_width - 90, middle = low + bin_width / 2;
        const double rings = std::fabs(std::cos(low * degree) - std::cos((low + bin_width) * degree));
        double hits = 0;
        for (const Tally& tally : tallies) hits += tally.bins[bin];
        const double share = hits / (static_cast<double>(rays) * static_cast<double>(tallies.size()));
        const auto he = [&](const Direction& out) {
            return directional_diffuse(PairFactors{surface, in, out}, short_wavelength(slope), {1.5, 0},
                                       DiffuseLobe::rough_limit)
                .lobe;
        };
        points.push_back(
            {slope, theta_i_deg, middle, share / (2 * half_width * degree * rings), bin_mean(middle, he),
             bin_mean(middle, [&](const Direction& out) { return smith_brdf(slope, in, out); })});
    }
    return points;
}

}  // namespace

std::vector<ShadowingPoint> shadowing_points(double slope, const std::vector<double>& theta_deg,
                                             const TracingSettings& settings) {
    const auto surfaces = static_cast<std::size_t>(settings.surfaces);
    std::vector<std::vector<double>> lit(theta_deg.size(), std::vector<double>(surfaces)), both = lit;
    spectral::parallel_for(surfaces, [&](std::size_t s) {
        const FacetSurface surface = surface_number(slope, static_cast<int>(s), settings);
        for (std::size_t i = 0; i < theta_deg.size(); ++i) {
            const Seen seen = seen_share(surface, theta_deg[i], settings, static_cast<int>(s));
            lit[i][s] = seen.lit;
            both[i][s] = seen.both;
        }
    });
    std::vector<ShadowingPoint> points;
    for (std::size_t i = 0; i < theta_deg.size(); ++i) {
        const Smith smith{slope, Direction::from_degrees(theta_deg[i], 0)};
        const Mean mean{lit[i]};
        points.push_back({slope, theta_deg[i], mean.value, mean.error, Mean{both[i]}.value, smith.s_1,
                          square(smith.s_1), std::erf(smith.c) / (1 + 2 * smith.lambda)});
    }
    return points;
}

TracedLight traced_light(double slope, double theta_i_deg, const TracingSettings& settings) {
    std::vector<Tally> tallies(static_cast<std::size_t>(settings.surfaces));
    spectral::parallel_for(tallies.size(), [&](std::size_t s) {
        const auto number = static_cast<int>(s);
        tallies[s] = traced(surface_number(slope, number, settings), theta_i_deg, settings, number);
    });
    std::vector<double> once, more, lost;
    for (const Tally& tally : tallies) {
        once.push_back(static_cast<double>(tally.once) / settings.rays);
        more.push_back(static_cast<double>(tally.more) / settings.rays);
        lost.push_back(static_cast<double>(tally.lost) / settings.rays);
    }
    const Mean mean{once};
    const auto model = spectral::directional_hemispherical_reflectance(
        Surface{slope, 1}, spectral::PerfectMirror{}, short_wavelength(slope),
        Direction::from_degrees(theta_i_deg, 0));
    return {{slope, theta_i_deg, mean.value, mean.error, Mean{more}.value, Mean{lost}.value, model.total()},
            lobe_points(slope, theta_i_deg, tallies, settings.rays)};
}

}  // namespace hts::validation
