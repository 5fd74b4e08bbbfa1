#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "validation/topography/deviance.hpp"
#include "validation/topography/spectrum_fit.hpp"

namespace hts::validation {
namespace {

constexpr double lowest_cells = 2.5;  // as in fits
constexpr double most_log_ratio = 4.6;
// of ln ratio: means over rings and sectors are of less unlike directions; computed maps come out lower by as
// much
constexpr double smeared = 0.06;

/// ln ratio times cosine and sine of twice the azimuth: without a seam where the surface is isotropic.
Ellipse ellipse_of(std::span<const double> x) {
    return {std::exp(std::hypot(x[0], x[1])), std::atan2(x[1], x[0]) / 2};
}

/// The power of each bin over the mean of all that have about its frequency, as the ellipse counts it: the
/// shape of the spectrum, whatever it is, drops out.
std::vector<double> relative_powers(const std::vector<PolarBin>& bins, const Ellipse& ellipse) {
    constexpr double width = 0.07;  // of ln f, half a ring
    std::vector<double> at;
    at.reserve(bins.size());
    for (const PolarBin& bin : bins) {
        at.push_back(std::log(
            ellipse.frequency(bin.frequency * std::cos(bin.azimuth), bin.frequency * std::sin(bin.azimuth))));
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        double power = 0, cells = 0;
        for (std::size_t k = 0; k < bins.size(); ++k) {
            const double apart = (at[k] - at[i]) / width;
            if (std::fabs(apart) > 4) continue;
            const double weight = bins[k].cells * std::exp(-apart * apart / 2);
            power += weight * bins[k].power;
            cells += weight;
        }
        result.push_back(bins[i].power * cells / power);
    }
    return result;
}

/// From the slopes of the part of the spectrum that holds the most of the heights.
std::vector<double> start(const std::vector<PolarBin>& bins) {
    double c = 0, s = 0, all = 0;
    for (const PolarBin& bin : bins) {
        // first moments: neither noise nor the lowest frequencies rule
        const double weight = bin.cells * bin.power * bin.frequency;
        all += weight;
        c += weight * std::cos(2 * bin.azimuth);
        s += weight * std::sin(2 * bin.azimuth);
    }
    const double strength = std::min(2 * std::hypot(c, s) / all, 2.0), direction = std::atan2(s, c);
    return {-strength * std::cos(direction), -strength * std::sin(direction)};  // long where slopes are not
}

}  // namespace

Anisotropy anisotropy_of(const std::vector<MapSpectrum>& spectra, double inflation) {
    std::vector<PolarBin> bins;
    for (const MapSpectrum& spectrum : spectra) {
        const double lowest = lowest_cells * std::max(spectrum.cell_x, spectrum.cell_y);
        for (const PolarBin& bin : polar_spectrum(spectrum)) {
            if (bin.frequency >= lowest && bin.cells >= 2) bins.push_back(bin);
        }
    }
    if (bins.size() < std::size_t{4} * sector_count)
        throw Error{std::to_string(bins.size()) + " rings in sectors of the spectrum: must be " +
                    std::to_string(4 * sector_count) + " at least; the map is too small"};
    const auto residuals = [&](const std::vector<double>& at) {
        std::vector<double> result = relative_powers(bins, ellipse_of(at));
        for (std::size_t i = 0; i < bins.size(); ++i)
            result[i] = std::sqrt(bins[i].cells / 2 / inflation) * deviance_root(std::max(result[i], 1e-12));
        return result;
    };
    const auto linearised = [&](std::span<const double> x, bool with_jacobian) {
        std::vector<double> at{x.begin(), x.end()};
        Linearised result{residuals(at), {}};
        for (std::size_t j = 0; with_jacobian && j < 2; ++j) {
            auto up = at, down = at;
            up[j] += 1e-3;
            down[j] -= 1e-3;
            auto column = residuals(up);
            const auto below = residuals(down);
            for (std::size_t i = 0; i < column.size(); ++i) column[i] = (column[i] - below[i]) / 2e-3;
            result.jacobian.push_back(std::move(column));
        }
        return result;
    };
    const std::vector<Bounds> bounds(2, {-most_log_ratio, most_log_ratio});
    const std::vector<double> x = local_minimum(linearised, start(bins), bounds, {50, 1e-8}).x;
    const Linearised last = linearised(x, true);
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    double squares = 0;
    for (std::size_t i = 0; i < last.residuals.size(); ++i) {
        const Eigen::Vector2d row{last.jacobian[0][i], last.jacobian[1][i]};
        normal += row * row.transpose();
        squares += last.residuals[i] * last.residuals[i];
    }
    const double deviance = squares / static_cast<double>(last.residuals.size());
    const Eigen::Matrix2d spread = std::max(1.0, deviance) * normal.inverse();
    const Eigen::Vector2d at{x[0], x[1]};
    const double length = at.norm();
    const Eigen::Vector2d along = length > 0 ? Eigen::Vector2d{at / length} : Eigen::Vector2d{1, 0};
    const Eigen::Vector2d beside{-along[1], along[0]};
    Anisotropy result{ellipse_of(x), 0, 0, at.dot(spread.inverse() * at) > 13.8};
    result.ratio_error =
        error_of(result.ellipse.ratio, std::hypot(std::sqrt(along.dot(spread * along)), smeared * length));
    result.azimuth_error =
        length > 0 ? std::min(std::numbers::pi / 2, std::sqrt(beside.dot(spread * beside)) / length / 2)
                   : std::numbers::pi / 2;
    return result;
}

}  // namespace hts::validation
