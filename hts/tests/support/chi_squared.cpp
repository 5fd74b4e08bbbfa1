#include "chi_squared.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace hts::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// Edges that grow away from a centre by factors of 2.5, between two ends.
std::vector<double> edges(double low, double high, double centre, double width) {
    std::vector<double> result{low, high};
    if (centre > low && centre < high) result.push_back(centre);
    for (double step = width; step < 4; step *= 2.5) {
        for (const double edge : {centre - step, centre + step}) {
            if (edge > low && edge < high) result.push_back(edge);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Boundaries that hold an equal number of values each, the ends given.
std::vector<double> quantiles(std::vector<double> values, std::size_t parts, double low, double high) {
    std::sort(values.begin(), values.end());
    std::vector<double> result{low};
    for (std::size_t i = 1; i < parts && !values.empty(); ++i) {
        const double edge = values[i * values.size() / parts];
        if (edge > result.back() && edge < high) result.push_back(edge);
    }
    result.push_back(high);
    return result;
}

std::size_t cell_of(const std::vector<double>& bounds, double value) {
    const auto above = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, value);
    return static_cast<std::size_t>(above - bounds.begin()) - 1;
}

/// Width of the innermost interval.
double middle_width(const std::vector<double>& bounds) {
    return bounds[bounds.size() / 2] - bounds[bounds.size() / 2 - 1];
}

/// Cells of the sphere with about as many of the given draws in each.
class Cells {
  public:
    using Cell = std::pair<std::size_t, std::size_t>;

    explicit Cells(const std::vector<Angles>& draws) {
        std::vector<double> thetas;
        for (const Angles& a : draws) thetas.push_back(a.theta);
        thetas_ = quantiles(thetas, 12, 0, pi);
        std::vector<std::vector<double>> rows(thetas_.size() - 1);
        for (const Angles& a : draws) rows[cell_of(thetas_, a.theta)].push_back(a.phi);
        for (auto& row : rows) azimuths_.push_back(quantiles(std::move(row), 8, -pi, pi));
    }

    [[nodiscard]] Cell of(const Angles& a) const {
        const std::size_t row = cell_of(thetas_, a.theta);
        return {row, cell_of(azimuths_[row], a.phi)};
    }
    [[nodiscard]] std::map<Cell, double> probabilities(const OnSphere& density) const {
        const double theta = thetas_[thetas_.size() / 2];
        std::map<Cell, double> result;
        for (std::size_t i = 0; i + 1 < thetas_.size(); ++i) {
            const auto& row = azimuths_[i];
            for (std::size_t j = 0; j + 1 < row.size(); ++j) {
                const Patch patch{thetas_[i], thetas_[i + 1], row[j], row[j + 1]};
                result[{i, j}] =
                    integral(density, patch, {theta, 0, middle_width(thetas_), middle_width(row)}, 1e-5);
            }
        }
        return result;
    }

  private:
    std::vector<double> thetas_;
    std::vector<std::vector<double>> azimuths_;
};

}  // namespace

double integral(const OnSphere& f, const Patch& patch, double tolerance) {
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 15>;
    const auto ring = [&](double theta) {
        const auto along = [&](double phi) { return f(theta, phi); };
        return std::sin(theta) * Quadrature::integrate(along, patch.phi0, patch.phi1, 8, tolerance / 10);
    };
    return Quadrature::integrate(ring, patch.theta0, patch.theta1, 8, tolerance);
}

double integral(const OnSphere& f, const Patch& patch, const Peak& peak, double tolerance) {
    auto thetas = edges(patch.theta0, patch.theta1, peak.theta, peak.width);
    if (patch.theta0 < pi / 2 && patch.theta1 > pi / 2) thetas.push_back(pi / 2);
    std::sort(thetas.begin(), thetas.end());
    const auto azimuths = edges(patch.phi0, patch.phi1, peak.phi, peak.width_phi);
    double sum = 0;
    for (std::size_t i = 1; i < thetas.size(); ++i) {
        for (std::size_t j = 1; j < azimuths.size(); ++j) {
            sum += integral(f, {thetas[i - 1], thetas[i], azimuths[j - 1], azimuths[j]}, tolerance);
        }
    }
    return sum;
}

void ChiSquared::add(double expected, double found) {
    expected_ += expected;
    found_ += found;
    if (expected_ < 10) return;
    sum_ += (found_ - expected_) * (found_ - expected_) / expected_;
    expected_ = found_ = 0;
    ++cells_;
}

double ChiSquared::p_value() const {
    if (cells_ < 2) return 1;
    const double rest =
        expected_ > 0 ? (found_ - expected_) * (found_ - expected_) / std::max(expected_, 1.0) : 0;
    return cdf(complement(boost::math::chi_squared{static_cast<double>(cells_ - 1)}, sum_ + rest));
}

double Fit::deviation_of_sum(std::size_t count) const {
    const auto n = static_cast<double>(count);
    return std::abs(total + none - 1) / (std::sqrt(std::max(none * n, 1.0)) / n + 2e-6);
}

Fit fit_of(const std::function<Draw()>& draw, const OnSphere& density, std::size_t count, double delta) {
    std::vector<Angles> pilot;
    for (int i = 0; i < 12000; ++i) {
        if (const Draw drawn = draw(); drawn.angles) pilot.push_back(*drawn.angles);
    }
    const Cells cells{pilot};
    std::map<Cells::Cell, double> found;
    double none = 0;
    double deltas = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Draw drawn = draw();
        (drawn.angles ? found[cells.of(*drawn.angles)] : drawn.delta ? deltas : none) += 1;
    }
    const auto n = static_cast<double>(count);
    ChiSquared fit;
    fit.add(n * delta, deltas);
    double total = delta;
    for (const auto& [cell, probability] : cells.probabilities(density)) {
        fit.add(n * probability, found[cell]);
        total += probability;
    }
    fit.add(n * std::max(0.0, 1 - total), none);
    return {fit.p_value(), total, none / n};
}

}  // namespace hts::testing
