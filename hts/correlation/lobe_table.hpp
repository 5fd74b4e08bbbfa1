// The scattering integral D of a shape of correlation, over g and q, in a table. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hts/correlation/height_shape.hpp"
#include "hts/correlation/log_transform.hpp"

namespace hts::correlation_detail {

/// D(g, q) and its part D2 = e^-g sum of g^m/(m! m) W_m at one g.
class LobeRow {
  public:
    /// 2 D and the mean of 1/m, D2/D.
    struct Value {
        double log_lobe, log_inverse_mean;
    };

    /// At q = 0, by the trapezoidal rule; above, by the transform while it has digits, then by the
    /// power of q it has there.
    [[nodiscard]] Value operator()(double q) const;
    /// Where the lobe has its shoulder, 1.77 D(0)/integral of f x^2 dx; where C oscillates 1.2 times
    /// where D is D(0)/2, which of a Gaussian is the same.
    [[nodiscard]] double width() const noexcept { return width_; }
    /// q beyond which the value is extrapolated.
    [[nodiscard]] double reach() const noexcept { return reach_; }

  private:
    friend class LobeIntegral;
    [[nodiscard]] Value transformed(double q) const;
    [[nodiscard]] double half_width() const;

    double step_ = 0, first_log_q_ = 0;  // of the transform
    std::vector<double> lobe_, second_;  // q D, q D2
    double at_zero_ = 0, second_at_zero_ = 0, width_ = 0, reach_ = 0, slope_ = 0;
    double least_log_ = -690;  // of 2 D
    Value at_reach_{};
};

/// D by a logarithmic Hankel transform of e^(-g (1 - C)) - e^-g, and D2 by that of e^-g
/// (Ei(g C) - ln(g C) - gamma).
class LobeIntegral {
  public:
    ///   points   a power of 2, over a range of e^60 in x
    explicit LobeIntegral(ShapePointer shape, std::size_t points = 4096);
    [[nodiscard]] LobeRow row(double g) const;

  private:
    ShapePointer shape_;
    LogTransform transform_;
    LogGrid grid_;
    Heights heights_;
};

/// ln 2D and ln D2/D by bicubic splines over ln g and asinh(q/width(g)).
class LobeTable {
  public:
    static constexpr double least_g = 1e-5, greatest_g = 1e8;
    /// Rows stand at equal steps of ln g + crowding g/(g + crowded): closest about g = 15, where the lobe of
    /// single kicks, which dies with e^-g, gives way to that of many. Columns stand at equal steps of
    /// u = asinh(q/width).
    static constexpr double crowded = 15, crowding = 16, row_step = 0.11, column_step = 0.025;
    static constexpr std::size_t columns = 521;  // u from 0 to 13
    /// At least columns + 2; the sum of two powers of 2 is quick to multiply by.
    static constexpr std::size_t row_length = 512 + 16;
    static constexpr double last_column = static_cast<double>(columns - 1);

    explicit LobeTable(const ShapePointer& shape);
    /// Of the numbers of another one, all parts in a row.
    explicit LobeTable(std::span<const double> numbers);
    [[nodiscard]] static std::size_t number_count() noexcept;
    [[nodiscard]] std::array<std::span<const double>, 3> numbers() const noexcept;

    ///   g   > 0: below least_g by the first two orders; above greatest_g that value is held
    [[nodiscard]] LobeRow::Value operator()(double g, double q) const noexcept;
    /// Derivatives of ln 2 D by ln g and by t = q^2/4, those of the splines.
    struct Slopes {
        double by_log_g, by_t;
    };
    ///   t   >= 0
    [[nodiscard]] Slopes slopes(double g, double t) const noexcept;
    [[nodiscard]] std::size_t bytes() const noexcept;

    /// What vector lanes need: coefficients of B-splines, those of cell i in four from i on.
    struct Coefficients {
        double first_row;         ///< the coordinate of row 0
        std::size_t rows;         ///< cells and one
        const double* log_width;  ///< of the width of the lobe, by row
        const double* lobe;       ///< ln 2 D, by row, row_length apart, then by column
        const double* mean;       ///< ln D2/D, the same
    };
    [[nodiscard]] Coefficients coefficients() const noexcept;

  private:
    [[nodiscard]] LobeRow::Value at(std::size_t row, const std::array<double, 4>& by_g,
                                    double column) const noexcept;

    std::vector<double> log_width_, lobe_, mean_;  // see Coefficients
};

}  // namespace hts::correlation_detail
