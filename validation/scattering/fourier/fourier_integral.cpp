#include "validation/scattering/fourier/fourier_integral.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hts/phi.hpp"
#include "hts/roughness.hpp"
#include "hts/sampling/random.hpp"
#include "hts/terms.hpp"
#include "spectral/parallel.hpp"

namespace hts::validation {
namespace {

using Complex = std::complex<double>;

constexpr double k = 2 * std::numbers::pi;
constexpr double period_over_tau = 12;

Wavelength unit_wavelength() {
    return Wavelength::from_micrometres(1);
}

/// How a surface is sampled: a step of at most tau/8 and a fifth of a wavelength.
struct Sampling {
    std::size_t samples;
    double period, step;

    explicit Sampling(double correlation_length)
        : samples{static_cast<std::size_t>(std::lround(
              std::max(8 * period_over_tau, std::ceil(5 * period_over_tau * correlation_length))))},
          period{period_over_tau * correlation_length},
          step{period / static_cast<double>(samples)} {}
};

/// A direction away from the surface, as multiples of the lowest wave number of the period.
struct LatticeDirection {
    int a, b;

    [[nodiscard]] Direction direction(double period) const {
        const double x = a / period, y = b / period;
        return Direction::from_vector({x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))});
    }
};

/// The library's lobe of |F| = 1 without what shadowing does.
double closed_form(const RoughnessStatistics& statistics, const Direction& in, const Direction& out) {
    const Surface surface{statistics.rms_roughness, statistics.correlation_length};
    const PairFactors pair{surface, in, out};
    const double g = phase_variance(statistics.rms_roughness, pair.change().vertical, unit_wavelength());
    return pair.lobe(phi(g, pair.lobe_argument(unit_wavelength())).value, unit_wavelength()) /
           pair.shadowing();
}

double roughness_of(const FourierCase& of) {
    return std::sqrt(of.phase_variance) / (2 * k * std::cos(of.theta_i_deg * std::numbers::pi / 180));
}

/// All directions of the lattice above 85 degrees of elevation from grazing, but the mirror's.
std::vector<LatticeDirection> all_directions(double period, const LatticeDirection& in) {
    std::vector<LatticeDirection> all;
    const int most = static_cast<int>(period);
    const double rim = period * std::sin(85 * std::numbers::pi / 180);
    for (int a = -most; a <= most; ++a) {
        for (int b = -most; b <= most; ++b) {
            if (std::hypot(a, b) <= rim && (a != -in.a || b != -in.b)) all.push_back({a, b});
        }
    }
    return all;
}

/// Bright ones at random, without repetition.
std::vector<FourierPoint> drawn_points(const FourierResult& result, const Sampling& sampling,
                                       const LatticeDirection& in, const FourierSettings& settings) {
    std::vector<FourierPoint> points;
    double brightest = 0;
    const Direction light = in.direction(sampling.period);
    for (const LatticeDirection& one : all_directions(sampling.period, in)) {
        const Direction out = one.direction(sampling.period);
        points.push_back({light, out, 0, 0, closed_form(result.surface, light, out)});
        brightest = std::max(brightest, points.back().closed_form);
    }
    std::erase_if(points, [&](const FourierPoint& point) { return point.closed_form < brightest / 1000; });
    Random random{seed_of(settings.study, 0, points.size())};
    for (std::size_t i = points.size() - 1; i > 0; --i) {
        const auto j = static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1));
        std::swap(points[i], points[j]);
    }
    points.resize(std::min(points.size(), static_cast<std::size_t>(settings.directions)), points.front());
    return points;
}

/// exp(-i v x) at the samples along one axis.
std::vector<Complex> waves(double v, const RandomField& field) {
    std::vector<Complex> result;
    for (std::size_t i = 0; i < field.samples; ++i)
        result.push_back(std::polar(1.0, -v * field.step * static_cast<double>(i)));
    return result;
}

/// |N|^2/(16 pi^2 L^2 cos theta_i cos theta_r).
double brdf(const RandomField& field, const Direction& in, const Direction& out) {
    const Vector3 to_light = in.vector(), v = k * (out.vector() + to_light);
    const auto along = waves(v.x, field), across = waves(v.y, field);
    Complex sum = 0;
    for (std::size_t j = 0; j < field.samples; ++j) {
        Complex row = 0;
        for (std::size_t i = 0; i < field.samples; ++i) {
            const std::size_t at = j * field.samples + i;
            const double current =
                to_light.x * field.slope_x[at] + to_light.y * field.slope_y[at] - to_light.z;
            row += along[i] * std::polar(1.0, -v.z * field.height[at]) * current;
        }
        sum += across[j] * row;
    }
    const double area = field.step * field.step;  // of a sample; 4 k^2/(16 pi^2) = 1
    return std::norm(sum) * area / static_cast<double>(field.samples * field.samples) /
           (in.cos_theta() * out.cos_theta());
}

}  // namespace

FourierResult fourier_result(const FourierCase& of, const FourierSettings& settings) {
    const Sampling sampling{of.correlation_length};
    FourierResult result{of, {roughness_of(of), of.correlation_length}, {}};
    const double sine = std::sin(of.theta_i_deg * std::numbers::pi / 180);
    const LatticeDirection in{-static_cast<int>(std::lround(sine * sampling.period)), 0};
    result.points = drawn_points(result, sampling, in, settings);
    std::vector<std::vector<double>> values(static_cast<std::size_t>(settings.realisations));
    spectral::parallel_for(values.size(), [&](std::size_t r) {
        const auto part = static_cast<std::uint64_t>(std::lround(1e3 * of.phase_variance)) * 1000 +
                          static_cast<std::uint64_t>(std::lround(10 * of.correlation_length));
        const auto field =
            random_field(result.surface, sampling.step, sampling.samples, seed_of(settings.study, part, r));
        for (const FourierPoint& point : result.points) values[r].push_back(brdf(field, point.in, point.out));
    });
    const auto count = static_cast<double>(settings.realisations);
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        double sum = 0, squares = 0;
        for (const auto& row : values) sum += row[i];
        const double mean = sum / count;
        for (const auto& row : values) squares += (row[i] - mean) * (row[i] - mean);
        result.points[i].computed = mean;
        result.points[i].standard_error = std::sqrt(squares / (count * (count - 1)));
    }
    return result;
}

}  // namespace hts::validation
