#include "bench/phi/phi_spline.hpp"

#include <cmath>
#include <limits>

namespace hts::bench {
namespace {

constexpr double last = PhiSpline::points - 1;

double step_x() {
    return std::log(PhiSpline::most_g / PhiSpline::least_g) / last;
}
constexpr double step_y = PhiSpline::most_y / last;

/// Weights of the two values and the two second derivatives about a place in a grid of unit step.
struct Weights {
    std::size_t cell;
    double left, right, left_bend, right_bend;
};

Weights weights(double place) {
    const double cell = std::fmin(std::floor(place), last - 1);
    const double right = place - cell;
    const double left = 1 - right;
    return {static_cast<std::size_t>(cell), left, right, (left * left * left - left) / 6,
            (right * right * right - right) / 6};
}

}  // namespace

std::vector<double> natural_second_derivatives(const std::vector<double>& values) {
    // (z[i-1] + 4 z[i] + z[i+1])/6 = the second difference, by elimination
    const std::size_t n = values.size();
    std::vector<double> z(n, 0.0);
    std::vector<double> pivot(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        pivot[i] = 1 / (4 - pivot[i - 1]);
        z[i] = (6 * (values[i - 1] - 2 * values[i] + values[i + 1]) - z[i - 1]) * pivot[i];
    }
    for (std::size_t i = n - 1; i-- > 1;) z[i] -= pivot[i] * z[i + 1];
    return z;
}

const PhiSpline& PhiSpline::shared() {
    static const PhiSpline spline;
    return spline;
}

PhiSpline::PhiSpline() : nodes_(points * points) {
    fill_values();
    fill_derivatives(&Node::value, &Node::xx, true);
    fill_derivatives(&Node::value, &Node::yy, false);
    fill_derivatives(&Node::xx, &Node::xxyy, false);
}

void PhiSpline::fill_values() {
    for (std::size_t x = 0; x < points; ++x) {
        const double g = least_g * std::exp(static_cast<double>(x) * step_x());
        for (std::size_t y = 0; y < points; ++y) {
            const double root = static_cast<double>(y) * step_y;
            node(x, y).value = std::log(phi_series_ratios(g, root * root * (1 + g)));
        }
    }
}

void PhiSpline::fill_derivatives(double Node::*from, double Node::*to, bool along_x) {
    const auto at = [&](std::size_t line, std::size_t i) -> Node& {
        return along_x ? node(i, line) : node(line, i);
    };
    std::vector<double> values(points);
    for (std::size_t line = 0; line < points; ++line) {
        for (std::size_t i = 0; i < points; ++i) values[i] = at(line, i).*from;
        const std::vector<double> bends = natural_second_derivatives(values);
        for (std::size_t i = 0; i < points; ++i) at(line, i).*to = bends[i];
    }
}

double PhiSpline::operator()(double g, double t) const noexcept {
    const double x = std::log(g / least_g) / step_x();
    const double y = std::sqrt(t / (1 + g)) / step_y;
    if (!(x >= 0 && x <= last && y <= last)) return std::numeric_limits<double>::quiet_NaN();
    const Weights wx = weights(x);
    const Weights wy = weights(y);
    const auto along_y = [&](std::size_t row, double Node::*value, double Node::*bend) {
        const Node* cell = &nodes_[row * points + wy.cell];
        return wy.left * cell[0].*value + wy.right * cell[1].*value + wy.left_bend * cell[0].*bend +
               wy.right_bend * cell[1].*bend;
    };
    return std::exp(wx.left * along_y(wx.cell, &Node::value, &Node::yy) +
                    wx.right * along_y(wx.cell + 1, &Node::value, &Node::yy) +
                    wx.left_bend * along_y(wx.cell, &Node::xx, &Node::xxyy) +
                    wx.right_bend * along_y(wx.cell + 1, &Node::xx, &Node::xxyy));
}

}  // namespace hts::bench
