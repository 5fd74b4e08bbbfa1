#include "validation/topography/spectrum_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "spectral/parallel.hpp"
#include "validation/curves/quadrature.hpp"
#include "validation/topography/deviance.hpp"

namespace hts::validation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double fewest_cells = 8;    // of a ring that is fitted
constexpr double lowest_cells = 2.5;  // frequencies below so many cells: levelling has a part in them
constexpr double most_noise = 0.95;   // of the variance
// of a ring's power, relative: no surface follows a formula more closely, and high
// rings have many frequencies
constexpr double least_spread = 0.05;
constexpr double least_power =
    1e-7;  // of the greatest: added to all, since below it are the sums' own errors

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
      inflation_{window.inflation()},
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

/// One description and all maps: what is expected, how far off it is, what that leaves open.
class SpectrumFitter {
  public:
    SpectrumFitter(const std::vector<SeenSpectrum>& maps, const RoughnessModel& model)
        : maps_{maps}, model_{model} {
        double raw = 0;
        for (const SeenSpectrum& map : maps) {
            area_ += map.area_;
            variance_ += map.area_ * map.variance_;
            raw += map.area_ * map.variance_ * map.window_share_;
        }
        const double restored = variance_ / raw;  // one factor for all maps in place of one each
        variance_ /= area_;
        for (const SeenSpectrum& map : maps) {
            for (const auto& bin : map.bins_) {
                if (bin.fitted) power_.push_back(bin.power * map.window_share_ * restored);
                const double spread = 2 * map.inflation_ / bin.cells + least_spread * least_spread;
                if (bin.fitted) modes_.push_back(1 / spread);
            }
        }
        if (!power_.empty()) floor_ = least_power * *std::ranges::max_element(power_);
        for (double& power : power_) power += floor_;
        if (power_.size() < 8)
            throw Error{std::to_string(power_.size()) + " rings of frequencies to fit: must be 8 at least"};
    }

    [[nodiscard]] SpectrumFit fit(double length) const {
        const double shortest = std::sqrt(maps_.front().noise_unit_) / 10, longest = 3 * std::sqrt(area_);
        std::vector<Bounds> bounds = model_.bounds(shortest, longest);
        bounds.push_back({0, most_noise});
        std::optional<Minimum> found;
        for (std::vector<double> start : model_.starts(length)) {
            start.push_back(1e-3);
            for (std::size_t i = 0; i < start.size(); ++i)
                start[i] = std::clamp(start[i], bounds[i].lowest + 1e-9, bounds[i].highest - 1e-9);
            const Minimum minimum =
                local_minimum([this](std::span<const double> x, bool with) { return linearised(x, with); },
                              start, bounds, {100, 1e-10});
            if (!found || minimum.cost < found->cost) found = minimum;
        }
        return described(*found, bounds);
    }

  private:
    /// Of the fitted bins, all maps' behind one another.
    [[nodiscard]] std::vector<double> expected(std::span<const double> x, bool fitted_only = true) const {
        const RoughnessScales scales = model_.scales(x);
        const double noise = x.back(), variance = (1 - noise) * variance_ / known_share(scales);
        std::vector<double> result;
        for (const SeenSpectrum& map : maps_) {
            std::vector<double> c;
            c.reserve(map.distances_.size());
            for (const double r : map.distances_) c.push_back(correlation(scales, r));
            for (std::size_t k = 0; k < map.taken_.size(); ++k) {
                const double power = hts::validation::spectrum(scales, map.taken_[k]);
                for (std::size_t i = 0; i < c.size(); ++i)
                    c[i] -= power * map.taken_kernel_[k * c.size() + i];
            }
            for (std::size_t b = 0; b < map.bins_.size(); ++b) {
                if (fitted_only && !map.bins_[b].fitted) continue;
                double sum = 0;
                for (std::size_t i = 0; i < c.size(); ++i) sum += map.kernel_[b * c.size() + i] * c[i];
                result.push_back(variance * std::max(sum, 0.0) + noise * variance_ * map.noise_unit_ +
                                 floor_);
            }
        }
        return result;
    }
    /// Share of the variance that the heights of the maps hold.
    [[nodiscard]] double known_share(const RoughnessScales& scales) const {
        double sum = 0;
        for (const SeenSpectrum& map : maps_) sum += map.area_ * (1 - share_below(scales, map.known_.first));
        return sum / area_;
    }
    /// Derivatives of logarithms by the coordinates, a row per value.
    template <class Values>
    [[nodiscard]] MatrixXd log_slopes(std::span<const double> x, const Values& values) const {
        MatrixXd result;
        for (std::size_t j = 0; j < x.size(); ++j) {
            std::vector<double> up{x.begin(), x.end()}, down = up;
            const bool noise = j + 1 == x.size();
            const double step = noise ? 1e-3 * std::max(x[j], 1e-4) : 1e-4;
            up[j] += step;
            if (!noise || x[j] > step) down[j] -= step;  // a noise below 0 is none
            const std::vector<double> above = values(up), below = values(down);
            result.conservativeResize(static_cast<Index>(above.size()), static_cast<Index>(x.size()));
            for (std::size_t i = 0; i < above.size(); ++i)
                result(static_cast<Index>(i), static_cast<Index>(j)) =
                    std::log(above[i] / below[i]) / (up[j] - down[j]);
        }
        return result;
    }
    [[nodiscard]] MatrixXd expected_slopes(std::span<const double> x) const {
        return log_slopes(x, [this](const std::vector<double>& at) { return expected(at); });
    }
    [[nodiscard]] Linearised linearised(std::span<const double> x, bool with_jacobian) const {
        const auto e = expected(x);
        Linearised result;
        for (std::size_t i = 0; i < e.size(); ++i)
            result.residuals.push_back(std::sqrt(modes_[i]) * deviance_root(power_[i] / e[i]));
        if (!with_jacobian) return result;
        const MatrixXd slopes = expected_slopes(x);
        for (Index j = 0; j < slopes.cols(); ++j) {
            auto& column = result.jacobian.emplace_back();
            for (std::size_t i = 0; i < e.size(); ++i) {
                column.push_back(std::sqrt(modes_[i]) * deviance_slope(power_[i] / e[i]) *
                                 slopes(static_cast<Index>(i), j));
            }
        }
        return result;
    }

    /// Covariances of the coordinates and of the logarithm of the heights' variance (last), to first order in
    /// the relative deviations d of the rings' powers, of variance 1/modes: with the variance of the heights
    /// given, the coordinates answer to d less the deviation of the sum over all rings.
    [[nodiscard]] MatrixXd covariance(std::span<const double> x, const std::vector<bool>& held) const {
        const auto count = static_cast<Index>(modes_.size()), unknowns = static_cast<Index>(x.size());
        MatrixXd slopes = expected_slopes(x);
        for (Index j = 0; j < unknowns; ++j) {
            if (held[static_cast<std::size_t>(j)]) slopes.col(j).setZero();
        }
        const VectorXd modes = Eigen::Map<const VectorXd>(modes_.data(), count);
        const MatrixXd normal = slopes.transpose() * modes.asDiagonal() * slopes;
        const MatrixXd answer = normal.completeOrthogonalDecomposition().pseudoInverse() *
                                slopes.transpose() * modes.asDiagonal();
        VectorXd spread = modes.cwiseInverse(), share = VectorXd::Zero(count), alone = share;
        double windowed = 0, direct = 0;  // variances of the sum, through the window and without
        const auto all = expected(x, false);
        Index fitted = 0;
        std::size_t at = 0;
        for (const SeenSpectrum& map : maps_) {
            for (const auto& bin : map.bins_) {
                const double w = map.area_ / area_ * bin.cells * map.cell_ * all[at++] / variance_;
                const double n = bin.cells / 2;
                windowed += w * w / n * map.inflation_;
                direct += w * w / n;
                if (!bin.fitted) continue;
                share[fitted] = w;
                alone[fitted++] = w / n;
            }
        }
        const VectorXd ones = VectorXd::Ones(count), crossed = spread.cwiseProduct(share);
        const MatrixXd of_rings = MatrixXd{spread.asDiagonal()} + windowed * ones * ones.transpose() -
                                  ones * crossed.transpose() - crossed * ones.transpose();
        MatrixXd result(unknowns + 1, unknowns + 1);
        result.topLeftCorner(unknowns, unknowns) = answer * of_rings * answer.transpose();
        result.topRightCorner(unknowns, 1) = answer * (alone - direct * ones);
        result.bottomLeftCorner(1, unknowns) = result.topRightCorner(unknowns, 1).transpose();
        result(unknowns, unknowns) = direct;
        return result;
    }

    [[nodiscard]] SpectrumFit described(const Minimum& minimum, const std::vector<Bounds>& bounds) const {
        const std::vector<double>& x = minimum.x;
        const auto freedom = static_cast<double>(power_.size()) - static_cast<double>(x.size());
        SpectrumFit fit{model_.name, model_.title, model_.scales(x), 0, {}, 0, 0, {}, 0, 0, {}};
        fit.variance = (1 - x.back()) * variance_ / known_share(fit.scales);
        fit.deviance = 2 * minimum.cost / freedom;
        fit.aic = 2 * minimum.cost + 2 * static_cast<double>(x.size());
        std::vector<bool> held;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double near = 1e-4 * (bounds[i].highest - bounds[i].lowest);
            held.push_back(i + 1 < x.size() &&
                           (x[i] < bounds[i].lowest + near || x[i] > bounds[i].highest - near));
        }
        const MatrixXd spread = std::max(1.0, fit.deviance) * covariance(x, held);
        // the logarithms of all values, by the coordinates and by the variance of the heights
        const auto values = [this](const std::vector<double>& at) {
            const RoughnessScales scales = model_.scales(at);
            std::vector<double> result{std::sqrt((1 - at.back()) / known_share(scales))};
            for (const RoughnessValue& value : model_.values(scales)) result.push_back(value.value);
            result.push_back(std::sqrt((1 - at.back()) * band_share(scales) / known_share(scales)));
            return result;
        };
        const MatrixXd by_coordinates = log_slopes(x, values);
        const std::vector<double> found = values(x);
        std::vector<RoughnessValue> own = model_.values(fit.scales);
        MatrixXd directions = MatrixXd::Zero(static_cast<Index>(found.size()), spread.rows());
        directions.leftCols(by_coordinates.cols()) = by_coordinates;
        directions(0, spread.rows() - 1) = directions(directions.rows() - 1, spread.rows() - 1) = 0.5;
        fit.covariances = covariances(directions, spread);
        for (std::size_t i = 0; i + 1 < found.size(); ++i) {
            const VectorXd along = directions.row(static_cast<Index>(i)).transpose();
            const double value = i == 0 ? std::sqrt(fit.variance) : own[i - 1].value;
            fit.values.push_back(
                {i == 0 ? "rms_um" : own[i - 1].name, value, value * std::sqrt(along.dot(spread * along))});
            for (Index j = 0; i > 0 && j + 1 < along.size(); ++j) {
                if (held[static_cast<std::size_t>(j)] && std::fabs(along[j]) > 1e-9)
                    fit.at_bounds.push_back(own[i - 1].name);
            }
        }
        const Index last = spread.rows() - 2;
        const double noise = x.back(), noise_error = std::sqrt(spread(last, last));
        fit.values.push_back({"noise_rms_um", std::sqrt(noise * variance_),
                              std::sqrt((noise + noise_error) * variance_) - std::sqrt(noise * variance_)});
        fit.rms_of_rings = std::sqrt(ring_variance(x));
        fit.rms_of_band = std::sqrt(fit.variance * band_share(fit.scales));
        return fit;
    }
    /// Of the last value, the rms of the band, and of those between the first and it.
    [[nodiscard]] static std::vector<double> covariances(const MatrixXd& directions, const MatrixXd& spread) {
        const Index count = directions.rows() - 1;
        MatrixXd rows(count, directions.cols());
        rows << directions.row(count), directions.middleRows(1, count - 1);
        const MatrixXd result = rows * spread * rows.transpose();
        return {result.data(), result.data() + result.size()};
    }
    /// What is expected of all rings, and what was measured of the corners.
    [[nodiscard]] double ring_variance(const std::vector<double>& x) const {
        const auto all = expected(x, false);
        std::size_t at = 0;
        double sum = 0;
        for (const SeenSpectrum& map : maps_) {
            sum += map.area_ * map.corners_;
            for (const auto& bin : map.bins_) sum += map.area_ * bin.cells * map.cell_ * all[at++];
        }
        return sum / area_;
    }
    [[nodiscard]] double band_share(const RoughnessScales& scales) const {
        double sum = 0;
        for (const SeenSpectrum& map : maps_)
            sum += map.area_ * (share_below(scales, map.known_.last) - share_below(scales, map.known_.first));
        return sum / area_;
    }

    const std::vector<SeenSpectrum>& maps_;
    const RoughnessModel& model_;
    double area_ = 0, variance_ = 0, floor_ = 0;
    std::vector<double> power_, modes_;
};

const FittedValue& SpectrumFit::value(std::string_view name) const {
    for (const FittedValue& each : values) {
        if (each.name == name) return each;
    }
    throw Error{std::string{model} + " has no value " + std::string{name}};
}

std::vector<SpectrumFit> fits_of_spectra(const std::vector<SeenSpectrum>& maps, double length) {
    const auto models = roughness_models();
    std::vector<std::optional<SpectrumFit>> fits(models.size());
    spectral::parallel_for(models.size(), [&](std::size_t i) {
        fits[i] = SpectrumFitter{maps, models[i]}.fit(length);
    });
    std::vector<SpectrumFit> result;
    for (auto& fit : fits) result.push_back(std::move(*fit));
    return result;
}

const SpectrumFit& best(const std::vector<SpectrumFit>& fits) {
    return *std::ranges::min_element(fits, {}, &SpectrumFit::aic);
}

}  // namespace hts::validation
