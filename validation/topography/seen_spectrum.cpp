#include "validation/topography/seen_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "spectral/parallel.hpp"
#include "validation/curves/quadrature.hpp"

namespace hts::validation {
namespace {

constexpr double fewest_cells = 8;    // of a ring that is fitted
constexpr double lowest_cells = 2.5;  // frequencies below so many cells: levelling has a part in them

/// Rings with cells enough, smaller ones joined to the next.
std::vector<RadialBin> joined(const std::vector<RadialBin>& rings) {
    std::vector<RadialBin> result;
    RadialBin open{0, 0, 0, 0};
    for (const RadialBin& ring : rings) {
        open = merged({{{0, open.frequency, open.power, open.cells}},
                       {{0, ring.frequency, ring.power, ring.cells}}})
                   .front();
        if (open.cells < fewest_cells) continue;
        result.push_back(open);
        open = {0, 0, 0, 0};
    }
    return result;
}

/// Distances at which a correlation is asked for: 0, and evenly in the logarithm from the shortest lag on. In
/// between it is a cubic polynomial of the logarithm, in four of them.
class Nodes {
  public:
    explicit Nodes(const std::vector<Lag>& lags) {
        for (const Lag& lag : lags) {
            if (lag.distance > 0) shortest_ = std::min(shortest_, lag.distance);
            longest_ = std::max(longest_, lag.distance);
        }
    }
    [[nodiscard]] std::vector<double> distances() const {
        std::vector<double> result{0};
        const auto count = static_cast<int>(std::log(longest_ / shortest_) / spacing) + 4;
        for (int k = -1; k < count; ++k) result.push_back(shortest_ * std::exp(spacing * k));
        return result;
    }
    /// Adds the spectrum at the mean over a ring of what each node's correlation stands for.
    void add_row(const std::vector<Lag>& lags, double frequency, double* row) const {
        for (const Lag& lag : lags) {
            const double part = lag.weight * ring_mean(frequency, lag.distance);
            if (lag.distance == 0) {
                row[0] += part;
                continue;
            }
            const double u = std::log(lag.distance / shortest_) / spacing, whole = std::floor(u),
                         t = u - whole;
            double* first = row + 1 + static_cast<std::ptrdiff_t>(whole);
            first[0] -= part * t * (t - 1) * (t - 2) / 6;
            first[1] += part * (t + 1) * (t - 1) * (t - 2) / 2;
            first[2] -= part * (t + 1) * t * (t - 2) / 2;
            first[3] += part * (t + 1) * t * (t - 1) / 6;
        }
    }

  private:
    /// Of J0(2 pi f r) over a ring, whose cells are even in area.
    static double ring_mean(double frequency, double r) {
        const double first = frequency * std::pow(10.0, -0.5 / RadialBin::rings);
        const double last = frequency * std::pow(10.0, 0.5 / RadialBin::rings);
        constexpr int parts = 5;
        double sum = 0;
        for (int k = 0; k < parts; ++k) {
            const double f = std::sqrt(first * first + (last * last - first * first) * (k + 0.5) / parts);
            sum += ::j0(2 * std::numbers::pi * f * r) / parts;
        }
        return sum;
    }

    static constexpr double spacing = 0.025;
    double shortest_ = HUGE_VAL, longest_ = 0;
};

}  // namespace

SeenSpectrum::SeenSpectrum(const HeightMap& map, const MapWindow& window, const MapSpectrum& spectrum,
                           int coefficients, const Ellipse& ellipse,
                           const std::optional<FrequencyBand>& wanted)
    : area_{map.width() * map.height()},
      variance_{spectrum.variance()},
      noise_unit_{map.step_x() * map.step_y()},
      inflation_{window.inflation},
      cell_{spectrum.cell()},
      window_share_{spectrum.window_share} {
    known_ = {std::sqrt(coefficients / (std::numbers::pi * area_)),
              0.5 / std::max(map.step_x(), map.step_y())};
    const double lowest =
        lowest_cells * std::max(ellipse.frequency(spectrum.cell_x, 0), ellipse.frequency(0, spectrum.cell_y));
    const FrequencyBand fitted{std::max(lowest, wanted ? wanted->first : 0),
                               wanted ? wanted->last : HUGE_VAL};
    corners_ = variance_;
    for (const RadialBin& ring : joined(radial_spectrum(spectrum, ellipse))) {
        if (ring.frequency < known_.first) continue;
        bins_.push_back({ring.frequency, ring.power, ring.cells,
                         ring.frequency >= fitted.first && ring.frequency <= fitted.last});
        corners_ -= ring.power * ring.cells * cell_;
    }
    const auto lags = window_lags(map, window, ellipse);
    const Nodes nodes{lags};
    distances_ = nodes.distances();
    kernel_.resize(bins_.size() * distances_.size());
    spectral::parallel_for(bins_.size(), [&](std::size_t b) {
        nodes.add_row(lags, bins_[b].frequency, &kernel_[b * distances_.size()]);
    });
    const GaussLegendre rule = gauss_legendre(24);
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const double u = rule.nodes[k],
                     f = known_.first * u * u;  // closer where long scales have their power
        taken_.push_back(f);
        const double weight = rule.weights[k] * 2 * known_.first * u * 2 * std::numbers::pi * f;
        for (const double r : distances_)
            taken_kernel_.push_back(weight * ::j0(2 * std::numbers::pi * f * r));
    }
}

}  // namespace hts::validation
