#include "spectral/energy/compensation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hts/error.hpp"
#include "spectral/colour/spectrum_interpolation.hpp"
#include "spectral/energy/lobe_integral.hpp"
#include "spectral/parallel.hpp"

namespace hts::spectral {
namespace {

/// Nodes equally spaced in log((1 + sin theta)/cos theta), which runs like theta at the normal and like
/// -log(cos theta) at the horizon: from the normal to 89.9 degrees.
constexpr std::size_t node_count = 128;
constexpr double farthest = 7.0437600274740995;  // of 89.9 degrees

Direction direction_of_node(std::size_t node) {
    const double x = farthest * static_cast<double>(node) / (node_count - 1);
    return Direction::from_vector({std::sinh(x), 0, 1});  // tan theta = sinh x
}

/// The equation for s at the nodes: s_i (mirror_i s_i + sum_j lobe_ij s_j) = 1.
class ScalingEquation {
  public:
    ScalingEquation(const RoughSurface& surface, const Wavelength& wavelength) {
        if (!surface.isotropic()) {
            throw Error{
                "energy compensation of a surface of two correlation lengths: must be one length (its "
                "factors are those of isotropic surfaces)"};
        }
        const ReflectedLight reflected = reflected_light(surface, PerfectMirror{}, wavelength);
        for (std::size_t i = 0; i < node_count; ++i) {
            const Direction in = direction_of_node(i);
            mirror_[i] = reflected.mirror(in);
            visit_lobe(surface, in, wavelength, reflected.lobe(in), [&](const Direction& out, double share) {
                const CompensationPlace at{out};
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

}  // namespace

CompensationPlace::CompensationPlace(const Direction& direction) noexcept {
    const double cosine = direction.cos_theta();
    const double x =
        cosine > 0 ? std::min(std::log((1 + direction.sin_theta()) / cosine), farthest) : farthest;
    const double steps = x / farthest * (node_count - 1);
    const auto second = static_cast<std::size_t>(std::min(steps, node_count - 3.0));
    const std::size_t first = second == 0 ? 1 : second - 1;  // even about the normal
    const double b = steps - static_cast<double>(second), a = b + 1, c = b - 1, d = b - 2;
    nodes = {first, second, second + 1, second + 2};
    weights = {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};  // Lagrange's, on -1, 0, 1, 2
}

EnergyCompensation::EnergyCompensation(const RoughSurface& surface, const Wavelength& wavelength)
    : factors_{ScalingEquation{surface, wavelength}.solution()} {}

std::vector<EnergyCompensation> EnergyCompensation::of(const RoughSurface& surface,
                                                       const WavelengthGrid& wavelengths) {
    std::vector<EnergyCompensation> result(wavelengths.size(), EnergyCompensation{std::vector<double>{}});
    parallel_for(result.size(), [&](std::size_t i) {
        result[i] = EnergyCompensation{surface, wavelengths[i]};
    });
    return result;
}

std::vector<EnergyCompensation> EnergyCompensation::interpolated(const std::vector<EnergyCompensation>& all,
                                                                 const WavelengthGrid& from,
                                                                 const WavelengthGrid& to) {
    const SpectrumInterpolation interpolation{from, to};
    if (interpolation.is_identity()) return all;
    std::vector<EnergyCompensation> result(to.size(), EnergyCompensation{std::vector<double>(node_count)});
    std::vector<double> given(from.size()), wanted(to.size());
    for (std::size_t node = 0; node < node_count; ++node) {
        for (std::size_t i = 0; i < all.size(); ++i) given[i] = all[i].factors_[node];
        interpolation(given, wanted);
        for (std::size_t i = 0; i < result.size(); ++i) result[i].factors_[node] = wanted[i];
    }
    return result;
}

HemisphericalReflectance directional_hemispherical_reflectance(const EnergyCompensation& compensation,
                                                               const RoughSurface& surface,
                                                               const Facets& facets,
                                                               const Wavelength& wavelength,
                                                               const Direction& in) noexcept {
    constexpr double tolerance =
        accuracy::compensated_energy / 1000;  // a finer one would follow the spline's joints
    const ReflectedLight reflected = reflected_light(surface, facets, wavelength);
    const double s = compensation.factor(in);
    const double lobe = lobe_integral(
        surface, in, wavelength, reflected.lobe(in),
        [&](const Direction& out) { return compensation.factor(out); }, Tolerance{tolerance});
    return {s * s * reflected.mirror(in), s * lobe, 0};
}

}  // namespace hts::spectral
