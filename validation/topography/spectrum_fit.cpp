#include "validation/topography/spectrum_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "spectral/parallel.hpp"
#include "validation/topography/deviance.hpp"

namespace hts::validation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double most_noise = 0.95;  // of the variance
// of a ring's power, relative: no surface follows a formula more closely, and high
// rings have many frequencies
constexpr double least_spread = 0.05;
// of all values, relative: what windows, rings and the level do to a spectrum is known to
// some half of that
constexpr double least_error = 0.015;
constexpr double least_power =
    1e-7;  // of the greatest: added to all, since below it are the sums' own errors

}  // namespace

double error_of(double value, double deviation) noexcept {
    constexpr double open = 2;  // from here on nothing is known
    return value * std::max(1.0, deviation / open) * std::expm1(2 * std::min(deviation, open)) / 2;
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
            in_rings_ += map.area_ * map.window_share_ * restored * (map.variance_ - map.corners_);
            for (const auto& bin : map.bins_) {
                if (bin.fitted) power_.push_back(bin.power * map.window_share_ * restored);
                if (bin.fitted) modes_.push_back(1 / spread_of(map, bin));
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
            const Minimum minimum = minimum_from(start, bounds, Amplitude::held);
            if (!found || minimum.cost < found->cost) found = minimum;
        }
        SpectrumFit fit = described(*found, bounds);
        fit.free_rms = free_rms(minimum_from(found->x, bounds, Amplitude::free), bounds);
        return fit;
    }

  private:
    /// Variance of a bin's power, relative.
    [[nodiscard]] static double spread_of(const SeenSpectrum& map, const SeenSpectrum::Bin& bin) {
        return 2 * map.inflation_ / bin.cells + least_spread * least_spread;
    }
    /// Held to the variance of the heights, or as the fitted bins would have it.
    enum class Amplitude { held, free };

    [[nodiscard]] Minimum minimum_from(const std::vector<double>& start, const std::vector<Bounds>& bounds,
                                       Amplitude amplitude) const {
        const auto of = [&](std::span<const double> x, bool with) { return linearised(x, with, amplitude); };
        return local_minimum(of, start, bounds, {100, 1e-10});
    }
    /// The likeliest factor on what is expected of the fitted bins, which the floor is no part of: by
    /// Fisher's scoring.
    [[nodiscard]] double free_factor(const std::vector<double>& expected_of_bins) const {
        double log = 0;
        for (int k = 0; k < 50; ++k) {
            double slope = 0, curvature = 0;
            for (std::size_t i = 0; i < modes_.size(); ++i) {
                const double own = std::exp(log) * (expected_of_bins[i] - floor_), whole = own + floor_;
                slope += modes_[i] * (power_[i] / whole - 1) * own / whole;
                curvature += modes_[i] * own * own / (whole * whole);
            }
            const double step = std::clamp(slope / curvature, -1.0, 1.0);
            log += step;
            if (std::fabs(step) < 1e-12) break;
        }
        return std::exp(log);
    }
    [[nodiscard]] std::vector<double> expected_with(std::span<const double> x, Amplitude amplitude) const {
        std::vector<double> result = expected(x);
        if (amplitude == Amplitude::held) return result;
        const double factor = free_factor(result);
        for (double& each : result) each = factor * (each - floor_) + floor_;
        return result;
    }
    /// Of the bins, all maps' behind one another: the shape is that of the description as the windows show
    /// it, the sum the power that was measured, so that the rms is the same.
    [[nodiscard]] std::vector<double> expected(std::span<const double> x, bool fitted_only = true) const {
        const RoughnessScales scales = model_.scales(x);
        std::vector<double> power;
        double seen = 0, noise = 0;
        for (const SeenSpectrum& map : maps_) {
            std::vector<double> c;
            c.reserve(map.distances_.size());
            for (const double r : map.distances_) c.push_back(correlation(scales, r));
            for (std::size_t k = 0; k < map.taken_.size(); ++k) {
                const double taken = hts::validation::spectrum(scales, map.taken_[k]);
                for (std::size_t i = 0; i < c.size(); ++i)
                    c[i] -= taken * map.taken_kernel_[k * c.size() + i];
            }
            for (std::size_t b = 0; b < map.bins_.size(); ++b) {
                double sum = 0;
                for (std::size_t i = 0; i < c.size(); ++i) sum += map.kernel_[b * c.size() + i] * c[i];
                power.push_back(std::max(sum, 0.0));
                const double weight = map.area_ * map.bins_[b].cells * map.cell_;
                seen += weight * power.back();
                noise += weight * noise_power(map, x);
            }
        }
        const double scale = std::max(in_rings_ - noise, 1e-6 * in_rings_) / seen;
        for_bins([&](const SeenSpectrum& map, const auto&, std::size_t at) {
            power[at] = scale * power[at] + noise_power(map, x);
        });
        // A share of a sum is expected to be more than the share of what is expected of both where it has
        // little part in the sum, whose inverse is that much greater in the mean.
        std::vector<double> part(power.size());
        double spread_of_sum = 0;
        for_bins([&](const SeenSpectrum& map, const auto& bin, std::size_t at) {
            const double share = map.area_ * bin.cells * map.cell_ * power[at] / in_rings_;
            part[at] = share * 2 * map.inflation_ / bin.cells;
            spread_of_sum += share * part[at];
        });
        std::vector<double> result;
        for_bins([&](const SeenSpectrum&, const auto& bin, std::size_t at) {
            if (bin.fitted || !fitted_only)
                result.push_back(power[at] * (1 + spread_of_sum - part[at]) + floor_);
        });
        return result;
    }
    [[nodiscard]] double noise_power(const SeenSpectrum& map, std::span<const double> x) const {
        return x.back() * variance_ * map.noise_unit_;
    }
    /// Calls f(map, bin, number) for all bins of all maps.
    template <class Function>
    void for_bins(const Function& f) const {
        std::size_t at = 0;
        for (const SeenSpectrum& map : maps_)
            for (const auto& bin : map.bins_) f(map, bin, at++);
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
    [[nodiscard]] MatrixXd expected_slopes(std::span<const double> x, Amplitude amplitude) const {
        return log_slopes(x, [&](const std::vector<double>& at) { return expected_with(at, amplitude); });
    }
    [[nodiscard]] Linearised linearised(std::span<const double> x, bool with_jacobian,
                                        Amplitude amplitude) const {
        const auto e = expected_with(x, amplitude);
        Linearised result;
        for (std::size_t i = 0; i < e.size(); ++i)
            result.residuals.push_back(std::sqrt(modes_[i]) * deviance_root(power_[i] / e[i]));
        if (!with_jacobian) return result;
        const MatrixXd slopes = expected_slopes(x, amplitude);
        for (Index j = 0; j < slopes.cols(); ++j) {
            auto& column = result.jacobian.emplace_back();
            for (std::size_t i = 0; i < e.size(); ++i) {
                column.push_back(std::sqrt(modes_[i]) * deviance_slope(power_[i] / e[i]) *
                                 slopes(static_cast<Index>(i), j));
            }
        }
        return result;
    }

    /// Covariances of the coordinates, of the logarithm of a free factor on the expected powers, and of the
    /// logarithm of the heights' variance (last), to first order in the relative deviations d of the rings'
    /// powers, of variance 1/modes: with the variance of the heights given, the coordinates answer to d less
    /// the deviation of the sum over all rings.
    [[nodiscard]] MatrixXd covariance(std::span<const double> x, const std::vector<bool>& held,
                                      Amplitude amplitude = Amplitude::held) const {
        const auto count = static_cast<Index>(modes_.size()), unknowns = static_cast<Index>(x.size()) + 1;
        MatrixXd slopes = MatrixXd::Zero(count, unknowns);
        slopes.leftCols(unknowns - 1) = expected_slopes(x, Amplitude::held);
        for (Index j = 0; j + 1 < unknowns; ++j) {
            if (held[static_cast<std::size_t>(j)]) slopes.col(j).setZero();
        }
        if (amplitude == Amplitude::free) {
            const std::vector<double> e = expected_with(x, amplitude);
            for (Index i = 0; i < count; ++i)
                slopes(i, unknowns - 1) = 1 - floor_ / e[static_cast<std::size_t>(i)];
        }
        const VectorXd modes = Eigen::Map<const VectorXd>(modes_.data(), count);
        const MatrixXd normal = slopes.transpose() * modes.asDiagonal() * slopes;
        const MatrixXd answer = normal.completeOrthogonalDecomposition().pseudoInverse() *
                                slopes.transpose() * modes.asDiagonal();
        VectorXd spread = modes.cwiseInverse(), share = VectorXd::Zero(count), alone = share;
        double windowed = 0, direct = 0;  // variances of the sum, through the window and without
        const auto all = expected(x, false);
        Index fitted = 0;
        for_bins([&](const SeenSpectrum& map, const auto& bin, std::size_t at) {
            const double w = map.area_ / area_ * bin.cells * map.cell_ * all[at] / variance_;
            const double n = bin.cells / 2;
            windowed += w * w * spread_of(map, bin);
            direct += w * w / n;
            if (!bin.fitted) return;
            share[fitted] = w;
            alone[fitted++] = w / n;
        });
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
        SpectrumFit fit{model_.name, model_.title, model_.scales(x), 0, {}, {}, {}, {}, 0, 0, {}};
        fit.variance = (1 - x.back()) * variance_ / known_share(fit.scales);
        fit.deviance = 2 * minimum.cost / freedom;
        fit.aic = 2 * minimum.cost + 2 * static_cast<double>(x.size());
        const std::vector<bool> held = held_by(bounds, x);
        // Errors grow with lengths, and those that were found too short must not have too small ones: they
        // are taken at lengths a standard deviation up.
        const double factor = std::max(1.0, fit.deviance);
        const MatrixXd here = factor * covariance(x, held);
        std::vector<double> longer = x;
        for (std::size_t i = 0; i < model_.lengths; ++i) {
            const auto place = static_cast<Index>(i);
            longer[i] = std::min(x[i] + std::sqrt(here(place, place)), bounds[i].highest);
        }
        const MatrixXd spread = factor * covariance(longer, held);
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
        const MatrixXd relative = widened(directions * spread * directions.transpose());
        const auto stated = [&](const std::string& name, double value, Index i) -> FittedValue {
            return {name, value, value * std::sqrt(relative(i, i))};
        };
        fit.values.push_back(stated("rms_um", std::sqrt(fit.variance), 0));
        for (std::size_t i = 0; i < own.size(); ++i) {
            const auto row = static_cast<Index>(i) + 1;
            fit.values.push_back(stated(own[i].name, own[i].value, row));
            for (std::size_t j = 0; j < held.size(); ++j) {
                if (held[j] && std::fabs(directions(row, static_cast<Index>(j))) > 1e-9)
                    fit.at_bounds.push_back(own[i].name);
            }
        }
        const Index band = relative.rows() - 1, last = static_cast<Index>(x.size()) - 1;
        fit.rms_of_band = stated("rms_of_band_um", std::sqrt(fit.variance * band_share(fit.scales)), band);
        fit.covariances = band_first(relative);
        const double noise = x.back(), noise_error = std::sqrt(spread(last, last));
        fit.values.push_back({"noise_rms_um", std::sqrt(noise * variance_),
                              std::sqrt((noise + noise_error) * variance_) - std::sqrt(noise * variance_)});
        return fit;
    }
    /// Coordinates that ended at a bound, a noise of none aside.
    [[nodiscard]] static std::vector<bool> held_by(const std::vector<Bounds>& bounds,
                                                   const std::vector<double>& x) {
        std::vector<bool> held;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double near = 1e-4 * (bounds[i].highest - bounds[i].lowest);
            held.push_back(i + 1 < x.size() &&
                           (x[i] < bounds[i].lowest + near || x[i] > bounds[i].highest - near));
        }
        return held;
    }
    /// Relative covariances of values, from those that the rings leave their logarithms.
    [[nodiscard]] static MatrixXd widened(MatrixXd of_logarithms) {
        of_logarithms.diagonal().array() += least_error * least_error;
        const VectorXd deviations = of_logarithms.diagonal().cwiseSqrt();
        const VectorXd factors =
            deviations.unaryExpr([](double deviation) { return error_of(1, deviation) / deviation; });
        return factors.asDiagonal() * of_logarithms * factors.asDiagonal();
    }
    /// Without the first value, the rms of all frequencies, and the last, the rms of the band, before the
    /// others.
    [[nodiscard]] static std::vector<double> band_first(const MatrixXd& relative) {
        const Index count = relative.rows() - 1;
        std::vector<double> result;
        for (Index i = 0; i < count; ++i)
            for (Index j = 0; j < count; ++j)
                result.push_back(relative(i == 0 ? count : i, j == 0 ? count : j));
        return result;
    }
    /// By the sum over the rings, which is that of the heights where the amplitude is held.
    [[nodiscard]] FittedValue free_rms(const Minimum& minimum, const std::vector<Bounds>& bounds) const {
        const double in_rings = in_rings_ / area_;
        const double factor = free_factor(expected(minimum.x));
        const double variance = variance_ + (factor - 1) * in_rings;
        const double freedom = static_cast<double>(power_.size()) - static_cast<double>(minimum.x.size()) - 1;
        const MatrixXd spread = covariance(minimum.x, held_by(bounds, minimum.x), Amplitude::free);
        const auto place = static_cast<Index>(minimum.x.size());
        const double deviation =
            std::sqrt(std::max(1.0, 2 * minimum.cost / freedom) * spread(place, place)) / 2;
        const double rms = std::sqrt(variance);
        return {"free_rms_um", rms, error_of(rms, deviation * factor * in_rings / variance)};
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
    double in_rings_ = 0;  // variance of the heights at frequencies of the rings, times the area
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
    result.reserve(fits.size());
    for (auto& fit : fits) result.push_back(std::move(*fit));
    return result;
}

const SpectrumFit& best(const std::vector<SpectrumFit>& fits) {
    return *std::ranges::min_element(fits, {}, &SpectrumFit::aic);
}

}  // namespace hts::validation
