#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/topography/deviance.hpp"
#include "validation/topography/spectrum_fit.hpp"

namespace hts::validation {
namespace {

constexpr double lowest_cells = 2.5;  // as in fits
constexpr double most_log_ratio = 4.6;

/// ln ratio times cosine and sine of twice the azimuth: without a seam where the surface is isotropic.
Ellipse ellipse_of(std::span<const double> x) {
    return {std::exp(std::hypot(x[0], x[1])), std::atan2(x[1], x[0]) / 2};
}

/// ln S2 over ln f, straight between rings, from all of them in one.
class Reference {
  public:
    Reference(const std::vector<MapSpectrum>& spectra, const Ellipse& ellipse) {
        std::vector<std::vector<RadialBin>> rings;
        for (const MapSpectrum& spectrum : spectra) rings.push_back(radial_spectrum(spectrum, ellipse));
        for (const RadialBin& ring : merged(rings)) {
            if (ring.cells < 6 || !(ring.power > 0)) continue;
            x_.push_back(std::log(ring.frequency));
            y_.push_back(std::log(ring.power));
        }
        if (x_.size() < 4) throw Error{"too few frequencies to tell directions apart"};
    }
    [[nodiscard]] double operator()(double f) const {
        const double x = std::log(f);
        const auto above = std::clamp<std::ptrdiff_t>(std::ranges::lower_bound(x_, x) - x_.begin(), 1,
                                                      static_cast<std::ptrdiff_t>(x_.size()) - 1);
        const auto i = static_cast<std::size_t>(above);
        return y_[i - 1] + (x - x_[i - 1]) / (x_[i] - x_[i - 1]) * (y_[i] - y_[i - 1]);
    }

  private:
    std::vector<double> x_, y_;
};

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
    const auto linearised = [&](const Reference& reference, std::span<const double> x, bool with_jacobian) {
        const auto residuals = [&](const std::vector<double>& at) {
            const Ellipse ellipse = ellipse_of(at);
            std::vector<double> result;
            result.reserve(bins.size());
            for (const PolarBin& bin : bins) {
                const double f = ellipse.frequency(bin.frequency * std::cos(bin.azimuth),
                                                   bin.frequency * std::sin(bin.azimuth));
                const double u = bin.power / std::exp(reference(f));
                result.push_back(std::sqrt(bin.cells / 2 / inflation) * deviance_root(std::max(u, 1e-12)));
            }
            return result;
        };
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
    std::vector<double> x = start(bins);
    const std::vector<Bounds> bounds(2, {-most_log_ratio, most_log_ratio});
    Linearised last;
    for (int round = 0; round < 12;
         ++round) {  // the mean over directions sharpens as they are brought to agree
        const Reference reference{spectra, ellipse_of(x)};
        const auto found = local_minimum(
            [&](std::span<const double> at, bool with) { return linearised(reference, at, with); }, x, bounds,
            {50, 1e-10});
        const double moved = std::hypot(found.x[0] - x[0], found.x[1] - x[1]);
        x = found.x;
        last = linearised(reference, x, true);
        if (moved < 1e-4) break;
    }
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
    result.ratio_error = result.ellipse.ratio * std::sqrt(along.dot(spread * along));
    result.azimuth_error =
        length > 0 ? std::min(std::numbers::pi / 2, std::sqrt(beside.dot(spread * beside)) / length / 2)
                   : std::numbers::pi / 2;
    return result;
}

}  // namespace hts::validation
