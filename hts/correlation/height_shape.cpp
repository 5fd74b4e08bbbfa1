#include "hts/correlation/height_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include "hts/error.hpp"

namespace hts::correlation_detail {
namespace {

double square(double x) {
    return x * x;
}

class Gaussian final : public HeightShape {
  public:
    [[nodiscard]] double log_spectrum(double q) const override { return -q * q / 4 - std::numbers::ln2; }
    [[nodiscard]] Heights heights(const LogGrid& grid) const override {
        Heights result;
        for (std::size_t i = 0; i < grid.count; ++i) {
            const double squared = std::exp(2 * grid[i]);
            result.correlation.push_back(std::exp(-squared));
            result.complement.push_back(-std::expm1(-squared));
        }
        return result;
    }
    [[nodiscard]] std::string name() const override { return "gaussian"; }
    [[nodiscard]] std::vector<double> identity() const override { return {1}; }
};

/// [Matern 1960]: the K-correlation of optical designers.
class Matern final : public HeightShape {
  public:
    explicit Matern(double nu) : nu_{nu}, log_factor_{(1 - nu) * std::numbers::ln2 - std::lgamma(nu)} {}

    [[nodiscard]] double log_spectrum(double q) const override {
        const double log_sum = q > 1e8 ? 2 * std::log(q) : std::log1p(q * q);
        return std::log(2 * nu_) - (nu_ + 1) * log_sum;
    }
    // Where C is near 1, 1 - C is the integral of -C' = factor x^nu K_(nu-1)(x).
    [[nodiscard]] Heights heights(const LogGrid& grid) const override {
        Heights result{std::vector<double>(grid.count), std::vector<double>(grid.count)};
        double sum = 0, before = 0;
        for (std::size_t i = 0; i < grid.count; ++i) {
            const double x = std::exp(grid[i]);
            if (x < 2) {
                const double here = slope(x);
                if (i == 0) {
                    sum = here / std::min(2 * nu_, 2.0);
                } else {
                    const double at = grid.step / 6;
                    const auto between = [&](double share) {
                        return slope(std::exp(grid[i] - share * grid.step));
                    };
                    sum +=
                        at / 2 * (before + 4 * between(0.75) + 2 * between(0.5) + 4 * between(0.25) + here);
                }
                before = here;
            }
            const bool near = x < 2 && sum < 0.5;
            const double whole = near ? 0 : correlation(x);
            result.complement[i] = near ? sum : 1 - whole;
            result.correlation[i] = near ? 1 - sum : whole;
        }
        return result;
    }
    [[nodiscard]] std::string name() const override {
        return nu_ == 0.5 ? "exponential" : "matern, nu " + shortest(nu_);
    }
    [[nodiscard]] std::optional<double> nu() const override { return nu_; }
    [[nodiscard]] std::vector<double> identity() const override { return {2, nu_}; }

  private:
    /// -x C'(x)
    [[nodiscard]] double slope(double x) const {
        const double order = std::abs(nu_ - 1);
        if ((order > 4 && x < 1e-3) || (nu_ > 2 && x < 1e-8)) {
            // K_m = Gamma(m)/2 (x/2)^-m (1 - x^2/(4 (m - 1)) + ...), where the power would overflow
            return square(x) / (2 * (nu_ - 1)) * (1 - square(x) / (4 * (order - 1)));
        }
        return std::exp(log_factor_ + (nu_ + 1) * std::log(x)) * boost::math::cyl_bessel_k(order, x);
    }
    [[nodiscard]] double correlation(double x) const {
        if (x > 700) return 0;
        return std::exp(log_factor_ + nu_ * std::log(x)) * boost::math::cyl_bessel_k(nu_, x);
    }

    double nu_, log_factor_;
};

class Sum final : public HeightShape {
  public:
    explicit Sum(std::vector<WeightedShape> parts) : parts_{std::move(parts)} {}

    [[nodiscard]] double log_spectrum(double q) const override {
        double greatest = -std::numeric_limits<double>::infinity();
        std::vector<double> logs;
        for (const auto& [weight, shape, length] : parts_) {
            logs.push_back(std::log(weight * square(length)) + shape->log_spectrum(q * length));
            greatest = std::max(greatest, logs.back());
        }
        if (!std::isfinite(greatest)) return greatest;
        double sum = 0;
        for (const double log : logs) sum += std::exp(log - greatest);
        return greatest + std::log(sum);
    }
    [[nodiscard]] Heights heights(const LogGrid& grid) const override {
        Heights result{std::vector<double>(grid.count), std::vector<double>(grid.count)};
        for (const auto& [weight, shape, length] : parts_) {
            LogGrid own = grid;
            own.offset -= std::log(length);
            const Heights part = shape->heights(own);
            for (std::size_t i = 0; i < grid.count; ++i) {
                result.correlation[i] += weight * part.correlation[i];
                result.complement[i] += weight * part.complement[i];
            }
        }
        return result;
    }
    [[nodiscard]] std::string name() const override {
        std::string text = "sum of ";
        for (const auto& [weight, shape, length] : parts_)
            text +=
                (&shape == &parts_.front().shape ? "" : " + ") + shortest(weight) + " of " + shape->name();
        return text;
    }
    [[nodiscard]] bool oscillates() const override {
        return std::ranges::any_of(parts_,
                                   [](const WeightedShape& part) { return part.shape->oscillates(); });
    }
    [[nodiscard]] bool ends() const override {
        return std::ranges::all_of(parts_, [](const WeightedShape& part) { return part.shape->ends(); });
    }
    [[nodiscard]] std::vector<double> identity() const override {
        std::vector<double> numbers{3, static_cast<double>(parts_.size())};
        for (const auto& part : parts_) {
            const auto own = part.shape->identity();
            numbers.insert(numbers.end(), {part.weight, part.length, static_cast<double>(own.size())});
            numbers.insert(numbers.end(), own.begin(), own.end());
        }
        return numbers;
    }

  private:
    std::vector<WeightedShape> parts_;
};

}  // namespace

ShapePointer gaussian_shape() {
    return std::make_shared<const Gaussian>();
}

ShapePointer matern_shape(double nu) {
    return std::make_shared<const Matern>(nu);
}

ShapePointer sum_of_shapes(std::vector<WeightedShape> parts) {
    return std::make_shared<const Sum>(std::move(parts));
}

double interpolated(std::span<const double> values, double position) noexcept {
    const double last = static_cast<double>(values.size()) - 3;
    const double cell = std::clamp(std::floor(position), 1.0, last);
    const auto i = static_cast<std::size_t>(cell);
    const double x = position - cell;
    const double a = x + 1, b = x - 1, c = x - 2;
    return values[i] * (a * b * c / 2) - values[i - 1] * (x * b * c / 6) - values[i + 1] * (a * x * c / 2) +
           values[i + 2] * (a * x * b / 6);
}

}  // namespace hts::correlation_detail
