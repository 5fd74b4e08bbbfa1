#include "validation/hankel.hpp"

#include <cmath>

namespace hts::validation {
namespace {

using Complex = std::complex<double>;

constexpr double least_tabulated = 1.5;
constexpr double intervals = 1500;

Hankel direct(double z) {
    return {{std::cyl_bessel_j(0.0, z), std::cyl_neumann(0.0, z)},
            {std::cyl_bessel_j(1.0, z), std::cyl_neumann(1.0, z)}};
}

/// Cubic through two values and two slopes, at 0 <= x <= 1 between them.
template <class Value>
Value hermite(const Value& value, const Value& slope, const Value& next, const Value& next_slope, double x) {
    const Value rise = next - value;
    const Value bend = 3.0 * rise - 2.0 * slope - next_slope, twist = slope + next_slope - 2.0 * rise;
    return value + x * (slope + x * (bend + x * twist));
}

}  // namespace

HankelTable::HankelTable(double largest)
    : first_{1 / (2 * std::fmax(largest, least_tabulated))},
      per_inverse_{intervals / (1 / least_tabulated - first_)} {
    for (int i = 0; i <= static_cast<int>(intervals) + 1; ++i) {
        const double z = 1 / (first_ + i / per_inverse_);
        const Hankel h = direct(z);
        const Complex carrier = std::polar(std::sqrt(z), -z);
        // h' by Bessel's recurrences: H0' = -H1, H1' = H0 - H1/z, and d/d(1/z) = -z^2 d/dz
        const Complex shift{0.5 / z, -1};
        const double turn = -z * z / per_inverse_;
        nodes_.push_back({{h.order_0 * carrier, h.order_1 * carrier},
                          {turn * carrier * (shift * h.order_0 - h.order_1),
                           turn * carrier * (shift * h.order_1 + h.order_0 - h.order_1 / z)}});
    }
}

Hankel HankelTable::operator()(double z) const noexcept {
    if (z < least_tabulated) return direct(z);
    const double inverse = 1 / z;
    const double place = (inverse - first_) * per_inverse_;
    const auto i = static_cast<std::size_t>(place);
    const double x = place - static_cast<double>(i);
    const Complex carrier = std::polar(std::sqrt(inverse), z);
    const Node &low = nodes_[i], &high = nodes_[i + 1];
    return {carrier * hermite(low.value[0], low.derivative[0], high.value[0], high.derivative[0], x),
            carrier * hermite(low.value[1], low.derivative[1], high.value[1], high.derivative[1], x)};
}

}  // namespace hts::validation
