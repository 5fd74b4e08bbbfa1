#include "spectral/compensation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "spectral/lobe_integral.hpp"

namespace hts::spectral {
namespace {

/// Nodes equally spaced in log((1 + sin theta)/cos theta), which runs like theta at the normal and like
/// -log(cos theta) at the horizon: from the normal to 89.9 degrees.
constexpr std::size_t node_count = 128;
constexpr double farthest = 7.0437600274740995;  // of 89.9 degrees

/// Cubic interpolation: the value in a direction is the weighted sum of those at four nodes.
struct Interpolation {
    std::array<std::size_t, 4> nodes;
    std::array<double, 4> weights;
};

Direction direction_of_node(std::size_t node) {
    const double x = farthest * static_cast<double>(node) / (node_count - 1);
    return Direction::from_vector({std::sinh(x), 0, 1});  // tan theta = sinh x
}

Interpolation interpolation(const Direction& direction) {
    const double x = std::min(std::log((1 + direction.sin_theta()) / direction.cos_theta()), farthest);
    const double steps = x / farthest * (node_count - 1);
    const auto second = static_cast<std::size_t>(std::min(steps, node_count - 3.0));
    const std::size_t first = second == 0 ? 1 : second - 1;  // even about the normal
    const double b = steps - static_cast<double>(second), a = b + 1, c = b - 1, d = b - 2;
    return {{first, second, second + 1, second + 2},  // Lagrange's polynomials on -1, 0, 1, 2
            {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6}};
}

double interpolated(const std::vector<double>& values, const Direction& direction) {
    const Interpolation at = interpolation(direction);
    double sum = 0;
    for (std::size_t i = 0; i < at.weights.size(); ++i) sum += at.weights[i] * values[at.nodes[i]];
    return sum;
}

/// The equation for s at the nodes: s_i (mirror_i s_i + sum_j lobe_ij s_j) = 1.
class ScalingEquation {
  public:
    ScalingEquation(const Surface& surface, const Wavelength& wavelength) {
        for (std::size_t i = 0; i < node_count; ++i) {
            const View in = view(surface, direction_of_node(i));
            mirror_[i] = coherent_fraction(surface, in, wavelength);
            visit_lobe(surface, in, wavelength, [&](const Direction& out, double share) {
                const Interpolation at = interpolation(out);
                for (std::size_t j = 0; j < at.weights.size(); ++j)
                    lobe_[i][at.nodes[j]] += share * at.weights[j];
            });
        }
    }

    /// Geometric mean of s and of what the equation gives for it: the plain iteration swings to and fro.
    [[nodiscard]] std::vector<double> solution() const {
        constexpr int most_steps = 200;
        constexpr double enough = 1e-13;
        std::vector<double> s(node_count, 1);
        double change = 1;
        for (int step = 0; step < most_steps && change > enough; ++step) {
            change = 0;
            std::vector<double> next = s;
            for (std::size_t i = 0; i < node_count; ++i) {
                const double reflected = s[i] * reflected_for(i, s);
                if (reflected > 0) next[i] = s[i] / std::sqrt(reflected);
                change = std::max(change, std::abs(reflected - 1));
            }
            s = next;
        }
        return s;
    }

  private:
    [[nodiscard]] double reflected_for(std::size_t i, const std::vector<double>& s) const {
        double sum = mirror_[i] * s[i];
        for (std::size_t j = 0; j < node_count; ++j) sum += lobe_[i][j] * s[j];
        return sum;
    }

    std::array<double, node_count> mirror_{};
    std::array<std::array<double, node_count>, node_count> lobe_{};
};

std::vector<EnergyCompensation> compensations(const Surface& surface, const WavelengthGrid& wavelengths) {
    std::vector<EnergyCompensation> result;
    result.reserve(wavelengths.size());
    for (std::size_t i = 0; i < wavelengths.size(); ++i) result.emplace_back(surface, wavelengths[i]);
    return result;
}

}  // namespace

EnergyCompensation::EnergyCompensation(const Surface& surface, const Wavelength& wavelength)
    : factors_{ScalingEquation{surface, wavelength}.solution()} {}

double EnergyCompensation::factor(const Direction& direction) const noexcept {
    return interpolated(factors_, direction);
}

CompensatedReflectance::CompensatedReflectance(const Reflector& reflector, const WavelengthGrid& wavelengths,
                                               OutsideRange policy, Tolerance tolerance)
    : model_{reflector, wavelengths, policy, tolerance},
      compensation_{compensations(reflector.surface, wavelengths)},
      uniform_diffuse_{model_.uniform_diffuse()} {}

std::vector<double> CompensatedReflectance::brdf(const DirectionPair& pair) const {
    std::vector<double> result(size());
    brdf(pair, result);
    return result;
}

void CompensatedReflectance::brdf(const DirectionPair& pair, std::span<double> result) const {
    model_.brdf(pair, result);
    for (std::size_t i = 0; i < size(); ++i) {
        result[i] = factor(i, pair) * (result[i] - uniform_diffuse_[i]) + uniform_diffuse_[i];
    }
}

void CompensatedReflectance::mueller(const DirectionPair& pair, std::span<Mueller> result) const {
    model_.mueller(pair, result);
    for (std::size_t i = 0; i < size(); ++i) {
        const double scale = factor(i, pair);
        result[i] = scale * result[i] + Mueller::depolariser((1 - scale) * uniform_diffuse_[i]);
    }
}

std::vector<SpecularReflectance> CompensatedReflectance::specular_reflectance(const Direction& in) const {
    std::vector<SpecularReflectance> result = model_.specular_reflectance(in);
    for (std::size_t i = 0; i < size(); ++i) {
        result[i] = SpecularReflectance{factor(i, {in, in.mirror()}) * result[i].value()};
    }
    return result;
}

double CompensatedReflectance::factor(std::size_t wavelength, const DirectionPair& pair) const noexcept {
    const EnergyCompensation& s = compensation_[wavelength];
    return s.factor(pair.in) * s.factor(pair.out);
}

HemisphericalReflectance directional_hemispherical_reflectance(const EnergyCompensation& compensation,
                                                               const Surface& surface, const Facets& facets,
                                                               const Wavelength& wavelength,
                                                               const Direction& in) noexcept {
    constexpr double tolerance =
        accuracy::compensated_energy / 1000;  // a finer one would follow the spline's joints
    const View seen = view(surface, in);
    const double s = compensation.factor(in);
    const double lobe = lobe_integral(
        surface, seen, wavelength,
        [&](const PairFactors& pair, const Direction& out) {
            return facet_reflectance(facets, pair.cos_theta_d()) * compensation.factor(out);
        },
        Tolerance{tolerance});
    const double mirror =
        facet_reflectance(facets, in.cos_theta()) * coherent_fraction(surface, seen, wavelength);
    return {s * s * mirror, s * lobe, 0};
}

}  // namespace hts::spectral
