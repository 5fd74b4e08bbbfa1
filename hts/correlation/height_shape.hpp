// Shapes of correlation: C(x) of the heights over x = r/length, and their spectrum. Not installed.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hts::correlation_detail {

/// ln x = (first + i) step.
struct LogGrid {
    int first;
    std::size_t count;
    double step;
    double offset = 0;  ///< added to ln x

    [[nodiscard]] double operator[](std::size_t i) const noexcept {
        return (first + static_cast<double>(i)) * step + offset;
    }
};

/// C and 1 - C, each to its own last digits.
struct Heights {
    std::vector<double> correlation, complement;
};

/// C(0) = 1, C -> 0; W(q) = integral of C(x) J0(q x) x dx >= 0, integral of W q dq = 1. Immutable.
class HeightShape {
  public:
    virtual ~HeightShape() = default;
    /// ln W(q).
    [[nodiscard]] virtual double log_spectrum(double q) const = 0;
    [[nodiscard]] virtual Heights heights(const LogGrid& grid) const = 0;
    /// Whether C oscillates far out, as of a spectrum with corners: its moments are noise.
    [[nodiscard]] virtual bool oscillates() const { return false; }
    /// Whether there is no power at all beyond some q.
    [[nodiscard]] virtual bool ends() const { return false; }
    /// For people: "exponential", "matern, nu 1.5".
    [[nodiscard]] virtual std::string name() const = 0;
    /// Of a Matern shape.
    [[nodiscard]] virtual std::optional<double> nu() const { return std::nullopt; }
    /// Numbers that determine the shape, no other shape having the same.
    [[nodiscard]] virtual std::vector<double> identity() const = 0;
};

using ShapePointer = std::shared_ptr<const HeightShape>;

struct WeightedShape {
    double weight;  // of the variance, all adding up to 1
    ShapePointer shape;
    double length;  // in units of the sum's
};

[[nodiscard]] ShapePointer gaussian_shape();
/// C = 2^(1 - nu)/Gamma(nu) x^nu K_nu(x), W = 2 nu/(1 + q^2)^(nu + 1).
[[nodiscard]] ShapePointer matern_shape(double nu);
[[nodiscard]] ShapePointer sum_of_shapes(std::vector<WeightedShape> parts);

/// A function of ln x by cubic polynomials between the points of a grid, in four of them each.
[[nodiscard]] double interpolated(std::span<const double> values, double position) noexcept;

}  // namespace hts::correlation_detail
