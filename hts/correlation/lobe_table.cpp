#include "hts/correlation/lobe_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <boost/math/special_functions/expint.hpp>

namespace hts::correlation_detail {
namespace {

constexpr double log_range = 60;               // of a transform, in ln x
constexpr double lowest = -200, highest = 32;  // ln x where C is known
constexpr double least_share = 1e-11;          // of the greatest q D: below, the transform's digits run out
constexpr double logarithm_of_nothing = -690;  // ln D at least
constexpr double least_mean = 1e-20;           // of the mean of 1/m, which is some 1e-8 at g = 1e8
// of D(0), where a spectrum ends: splines swing about a deeper step
constexpr double least_of_end = 1e-9;

/// e^-g times the sum of y^m/(m! m), m >= 1.
///   y   g C, -g ... g     complement   1 - C
double scaled_sum(double g, double y, double complement) {
    if (std::abs(y) < 1e-17) return std::exp(-g) * y;
    if (std::abs(y) < 2) {
        double term = y, sum = y;
        for (int m = 2; std::abs(term) > 1e-18 * std::abs(sum) && m < 60; ++m) {
            term *= y / m;
            sum += term / m;
        }
        return std::exp(-g) * sum;
    }
    const double rest = std::exp(-g) * (std::log(std::abs(y)) + std::numbers::egamma);
    if (y < 0) return -(std::exp(-g) * boost::math::expint(1, -y) + rest);
    if (y < 40) return std::exp(-g) * boost::math::expint(y) - rest;
    double term = 1, sum = 1;
    for (int m = 1; m < y && term > 1e-17; ++m) sum += term *= m / y;
    return std::exp(-g * complement) * sum / y - rest;
}

/// e^-g (e^(g C) - 1)
double kernel(double g, double correlation, double complement) {
    const double y = g * correlation;
    if (std::abs(y) < 1) return std::exp(-g) * std::expm1(y);
    return std::exp(-g * complement) - std::exp(-g);
}

/// A polynomial through six points of a grid about the position.
double smooth(std::span<const double> values, double position) {
    const double cell = std::clamp(std::floor(position) - 2, 0.0, static_cast<double>(values.size()) - 6);
    const double x = position - cell;
    const auto first = static_cast<std::size_t>(cell);
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        double weight = 1;
        for (std::size_t j = 0; j < 6; ++j) {
            if (j != i)
                weight *= (x - static_cast<double>(j)) / (static_cast<double>(i) - static_cast<double>(j));
        }
        sum += weight * values[first + i];
    }
    return sum;
}

double logarithm(double value) {
    return value > 0 ? std::max(std::log(value), logarithm_of_nothing) : logarithm_of_nothing;
}

// --- splines ---------------------------------------------------------------------------------------------

constexpr double row_step = LobeTable::row_step;

double row_coordinate(double g) noexcept {
    return std::log(g) + LobeTable::crowding * g / (g + LobeTable::crowded);
}
const double first_row = row_coordinate(LobeTable::least_g);
const std::size_t row_count =
    static_cast<std::size_t>(std::ceil((row_coordinate(LobeTable::greatest_g) - first_row) / row_step)) + 1;

/// g of a row, by Newton's rule.
double g_of_row(std::size_t row) {
    const double wanted = first_row + static_cast<double>(row) * row_step;
    double log_g = std::min(wanted, 1.0);
    for (int i = 0; i < 60; ++i) {
        const double g = std::exp(log_g);
        const double beside = g + LobeTable::crowded;
        log_g -= (row_coordinate(g) - wanted) /
                 (1 + LobeTable::crowding * LobeTable::crowded * g / (beside * beside));
    }
    return std::exp(log_g);
}

/// Coefficients of the cubic B-spline through values at 0, 1, ..., one more at each end;
/// its slopes there are given.
///   stride   between values, and between coefficients
void spline(std::span<const double> values, double first_slope, double last_slope,
            std::span<double> coefficients, std::size_t stride) {
    // c_-1 + 4 c_0 + c_1 = 6 f_0, and c_1 - c_-1 = 2 f'_0 at the ends
    const std::size_t n = values.size();
    std::vector<double> diagonal(n), right(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool first = i == 0, last = i + 1 == n;
        right[i] = 6 * values[i] + (first ? 2 * first_slope : 0) - (last ? 2 * last_slope : 0);
        const double below = first ? 0 : (last ? 2 : 1);
        const double above_before = i == 1 ? 2 : 1;
        diagonal[i] = first ? 4 : 4 - below * above_before / diagonal[i - 1];
        if (!first) right[i] -= below * right[i - 1] / diagonal[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        const double above = i == 0 ? 2 : 1;
        right[i] = (right[i] - (i + 1 < n ? above * right[i + 1] : 0)) / diagonal[i];
    }
    for (std::size_t i = 0; i < n; ++i) coefficients[(i + 1) * stride] = right[i];
    coefficients[0] = right[1] - 2 * first_slope;
    coefficients[(n + 1) * stride] = right[n - 2] + 2 * last_slope;
}

/// Slopes at the ends by the polynomial through the five outermost values.
double first_slope_of(std::span<const double> f) {
    return (-25 * f[0] + 48 * f[1] - 36 * f[2] + 16 * f[3] - 3 * f[4]) / 12;
}
double last_slope_of(std::span<const double> f) {
    const std::array<double, 5> turned{f[f.size() - 1], f[f.size() - 2], f[f.size() - 3], f[f.size() - 4],
                                       f[f.size() - 5]};
    return -first_slope_of(turned);
}

using Weights = std::array<double, 4>;

Weights weights(double x) {
    const double y = 1 - x;
    return {y * y * y / 6, (4 - 6 * x * x + 3 * x * x * x) / 6, (4 - 6 * y * y + 3 * y * y * y) / 6,
            x * x * x / 6};
}

struct Cell {
    std::size_t first;
    Weights of;
};

/// Derivatives of `weights`.
Weights weight_slopes(double x) {
    const double y = 1 - x;
    return {-y * y / 2, x * (1.5 * x - 2), y * (2 - 1.5 * y), x * x / 2};
}

Cell cell(double position, std::size_t points) {
    const double floor = std::clamp(std::floor(position), 0.0, static_cast<double>(points) - 2);
    return {static_cast<std::size_t>(floor), weights(position - floor)};
}

}  // namespace

// --- one g -------------------------------------------------------------------------------------------------

LobeRow::Value LobeRow::transformed(double q) const {
    const double position = (std::log(q) - first_log_q_) / step_;
    const double lobe = smooth(lobe_, position), second = smooth(second_, position);
    return {logarithm(2 * lobe / q), std::min(std::log(std::max(second / lobe, least_mean)), 0.0)};
}

double LobeRow::half_width() const {
    const auto density = [&](std::size_t i) {
        return lobe_[i] / std::exp(first_log_q_ + static_cast<double>(i) * step_);
    };
    // from outside, where the transform has its digits: the last place above a half
    std::size_t i = lobe_.size() - 1;
    while (i > 1 && !(density(i - 1) > at_zero_ / 2)) --i;
    const double above = std::log(density(i - 1)), below = std::log(std::max(density(i), 1e-3 * at_zero_));
    const double share = (above - std::log(at_zero_ / 2)) / (above - below);
    return std::exp(first_log_q_ + (static_cast<double>(i) - 1 + share) * step_);
}

LobeRow::Value LobeRow::operator()(double q) const {
    if (q < 1e-5 * width_) return {logarithm(2 * at_zero_), std::log(second_at_zero_ / at_zero_)};
    if (q <= reach_) {
        Value value = transformed(q);
        value.log_lobe = std::max(value.log_lobe, least_log_);
        return value;
    }
    const double log_lobe = at_reach_.log_lobe + slope_ * std::log(q / reach_);
    return {std::max(log_lobe, least_log_), at_reach_.log_inverse_mean};
}

LobeIntegral::LobeIntegral(ShapePointer shape, std::size_t points)
    : shape_{std::move(shape)},
      transform_{points, log_range / static_cast<double>(points)},
      grid_{static_cast<int>(lowest / transform_.step()),
            static_cast<std::size_t>((highest - lowest) / transform_.step()), transform_.step()},
      heights_{shape_->heights(grid_)} {}

LobeRow LobeIntegral::row(double g) const {
    const std::size_t points = transform_.points(), middle = points / 2;
    // about the length over which the phase keeps its correlation
    const auto decorrelated = std::ranges::lower_bound(heights_.complement, 1 / std::max(g, 2.0));
    const auto centre = static_cast<std::size_t>(decorrelated - heights_.complement.begin());
    const std::size_t first = std::clamp(centre, middle, grid_.count - middle - 1) - middle;
    const double log_centre = grid_[first + middle];
    std::vector<std::complex<double>> values(points);
    double lobe = 0, second = 0, reach = 0;
    const double whole = kernel(g, 1, 0), whole_second = scaled_sum(g, g, 0);
    // D2 is some D/g where g is large, and would lose its digits beside D in one complex number
    const double alike = whole / whole_second;
    for (std::size_t i = 0; i < points; ++i) {
        const double x = std::exp(grid_[first + i]);
        const double c = heights_.correlation[first + i], rest = heights_.complement[first + i];
        const bool flat = g * rest < 1e-17;
        const double f = flat ? whole : kernel(g, c, rest),
                     f2 = flat ? whole_second : scaled_sum(g, g * c, rest);
        values[i] = {x * f, x * f2 * alike};
        lobe += x * x * f;
        second += x * x * f2;
        reach += x * x * x * f;
    }
    transform_.hankel(values);
    LobeRow row;
    row.step_ = transform_.step();
    row.first_log_q_ = -log_centre - static_cast<double>(middle) * row.step_;
    row.at_zero_ = lobe * row.step_;
    row.second_at_zero_ = second * row.step_;
    std::size_t greatest = 0;
    for (std::size_t i = 0; i < points; ++i) {
        row.lobe_.push_back(values[i].real());
        row.second_.push_back(values[i].imag() / alike);
        if (row.lobe_[i] > row.lobe_[greatest]) greatest = i;
    }
    // of one scale near 2 (D/-D'')^(1/2); of several that of the narrowest lobe, which it
    // leaves slowly as g grows
    row.width_ = reach > 0 ? 1.77 * lobe / reach : std::sqrt(-2 * std::expm1(-g) / row.at_zero_);
    if (shape_->oscillates()) row.width_ = 1.2 * row.half_width();
    if (shape_->ends()) row.least_log_ = logarithm(2 * row.at_zero_) + std::log(least_of_end);
    std::size_t end = greatest;
    while (end + 8 < points && row.lobe_[end] > least_share * row.lobe_[greatest]) ++end;
    row.reach_ = std::exp(row.first_log_q_ + static_cast<double>(end - 4) * row.step_);
    row.at_reach_ = row.transformed(row.reach_);
    const double inside = std::exp(-8 * row.step_);
    // where the lobe ends at once, its last digits may rise; as the light is finite it falls faster than q^-2
    const double slope =
        (row.at_reach_.log_lobe - row.transformed(row.reach_ * inside).log_lobe) / (8 * row.step_);
    row.slope_ = std::min(slope, -2.1);
    return row;
}

// --- all g
// ---------------------------------------------------------------------------------------------------

LobeTable::LobeTable(const ShapePointer& shape) {
    const LobeIntegral integral{shape};
    const std::size_t rows = row_count;
    std::array<std::vector<double>, 2> by_row{std::vector<double>(rows * row_length),
                                              std::vector<double>(rows * row_length)};
    std::vector<double> log_width(rows), line(columns);
    for (std::size_t i = 0; i < rows; ++i) {
        const LobeRow row = integral.row(g_of_row(i));
        log_width[i] = std::log(row.width());
        std::vector<LobeRow::Value> values;
        for (std::size_t j = 0; j < columns; ++j)
            values.push_back(row(row.width() * std::sinh(static_cast<double>(j) * column_step)));
        for (std::size_t which = 0; which < 2; ++which) {
            for (std::size_t j = 0; j < columns; ++j)
                line[j] = which == 0 ? values[j].log_lobe : values[j].log_inverse_mean;
            spline(line, 0, last_slope_of(line), std::span{by_row[which]}.subspan(i * row_length), 1);
        }
    }
    std::vector<double> widths(rows + 2);
    spline(log_width, first_slope_of(log_width), last_slope_of(log_width), widths, 1);
    log_width_ = std::move(widths);
    std::vector<double> column(rows);
    for (std::size_t which = 0; which < 2; ++which) {
        std::vector<double>& all = which == 0 ? lobe_ : mean_;
        all.resize((rows + 2) * row_length);
        for (std::size_t j = 0; j < columns + 2; ++j) {
            for (std::size_t i = 0; i < rows; ++i) column[i] = by_row[which][i * row_length + j];
            spline(column, first_slope_of(column), last_slope_of(column), std::span{all}.subspan(j),
                   row_length);
        }
    }
}

LobeTable::LobeTable(std::span<const double> numbers) {
    for (const auto& [part, size] : {std::pair{&log_width_, row_count + 2},
                                     {&lobe_, (row_count + 2) * row_length},
                                     {&mean_, (row_count + 2) * row_length}}) {
        const auto of_part = numbers.first(size);
        part->assign(of_part.begin(), of_part.end());
        numbers = numbers.subspan(size);
    }
}

std::size_t LobeTable::number_count() noexcept {
    return (row_count + 2) * (1 + 2 * row_length);
}

std::array<std::span<const double>, 3> LobeTable::numbers() const noexcept {
    return {log_width_, lobe_, mean_};
}

LobeTable::Coefficients LobeTable::coefficients() const noexcept {
    return {first_row, row_count, log_width_.data(), lobe_.data(), mean_.data()};
}

LobeRow::Value LobeTable::at(std::size_t row, const Weights& by_g, double column) const noexcept {
    const Cell by_u = cell(column, columns);
    LobeRow::Value sum{0, 0};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t first = (row + k) * row_length + by_u.first;
        double lobe = 0, mean = 0;
        for (std::size_t j = 0; j < 4; ++j) {
            lobe += by_u.of[j] * lobe_[first + j];
            mean += by_u.of[j] * mean_[first + j];
        }
        sum.log_lobe += by_g[k] * lobe;
        sum.log_inverse_mean += by_g[k] * mean;
    }
    return sum;
}

LobeRow::Value LobeTable::operator()(double g, double q) const noexcept {
    constexpr double last = last_column;
    const Cell by_g =
        cell((row_coordinate(std::clamp(g, least_g, greatest_g)) - first_row) / row_step, row_count);
    double log_width = 0;
    for (std::size_t k = 0; k < 4; ++k) log_width += by_g.of[k] * log_width_[by_g.first + k];
    const double column = std::asinh(q * std::exp(-log_width)) / column_step;
    LobeRow::Value value = at(by_g.first, by_g.of, std::min(column, last));
    if (column > last)  // a power of q
        value.log_lobe += (column - last) * (value.log_lobe - at(by_g.first, by_g.of, last - 1).log_lobe);
    if (g < least_g) {
        // e^-g (g W_1 + g^2/2 W_2), where 1 - D2/D = g/4 W_2/W_1
        const double share = g / least_g;
        value.log_lobe += std::log(share) + (least_g - g) + 2 * (1 - share) * value.log_inverse_mean;
        value.log_inverse_mean *= share;
    }
    return {value.log_lobe, std::min(value.log_inverse_mean, 0.0)};
}

LobeTable::Slopes LobeTable::slopes(double g, double t) const noexcept {
    const double held = std::clamp(g, least_g, greatest_g), beside = held + crowded;
    const double position = (row_coordinate(held) - first_row) / row_step;
    const double rows_by_log_g = (1 + crowding * crowded * held / (beside * beside)) / row_step;
    const Cell by_g = cell(position, row_count);
    const Weights g_slopes = weight_slopes(position - static_cast<double>(by_g.first));
    double log_width = 0, width_by_row = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        log_width += by_g.of[k] * log_width_[by_g.first + k];
        width_by_row += g_slopes[k] * log_width_[by_g.first + k];
    }
    // even in q: below this ratio the slope by its square is that at 0
    constexpr double least_ratio = 1e-3;
    const double ratio = std::max(2 * std::sqrt(t) * std::exp(-log_width), least_ratio);
    const double column = std::asinh(ratio) / column_step;
    const Cell by_u = cell(std::min(column, last_column), columns);
    const double x = std::min(column, last_column) - static_cast<double>(by_u.first);
    const Weights u_slopes = weight_slopes(x);
    double by_row = 0, by_column = 0, by_both = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const double* const row = lobe_.data() + (by_g.first + k) * row_length + by_u.first;
        double value = 0, slope = 0;
        for (std::size_t j = 0; j < 4; ++j) {
            value += by_u.of[j] * row[j];
            slope += u_slopes[j] * row[j];
        }
        by_row += g_slopes[k] * value;
        by_column += by_g.of[k] * slope;
        by_both += g_slopes[k] * slope;
    }
    if (column > last_column) by_row += (column - last_column) * by_both;  // a power of q
    const double root = std::sqrt(1 + ratio * ratio);
    const double by_log_width = -by_column / column_step * ratio / root;
    Slopes result{rows_by_log_g * (by_row + by_log_width * width_by_row),
                  by_column / column_step * 2 * std::exp(-2 * log_width) / (ratio * root)};
    if (g > greatest_g) result.by_log_g = 0;
    if (g < least_g) {
        const double kicks = 2 * (*this)(least_g, 2 * std::sqrt(t)).log_inverse_mean;
        result.by_log_g = 1 - g - g / least_g * kicks;
    }
    return result;
}

std::size_t LobeTable::bytes() const noexcept {
    return sizeof *this + (log_width_.size() + lobe_.size() + mean_.size()) * sizeof(double);
}

}  // namespace hts::correlation_detail
