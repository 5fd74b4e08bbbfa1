/// The contestants of the charts: every method of phi_methods.hpp one value at a time, this project's also in
/// batches, and the lobe of GGX.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hts::bench {

/// Values at equally many g and t.
using PhiBlock =
    std::function<void(std::span<const double> g, std::span<const double> t, std::span<double> result)>;

/// How a method is drawn: its family's colour and heading, its own marker.
struct ChartStyle {
    std::string family;  ///< heading of the legend
    std::string label;   ///< below it
    std::string colour;
    int marker;  ///< gnuplot's point type
};

struct ChartMethod {
    std::string name, setting;
    PhiBlock values;
    bool ours, batch;
    double error;  ///< promised where it is ours, else 0
    std::size_t bytes;
    ChartStyle style;

    [[nodiscard]] std::string title() const { return setting.empty() ? name : name + ", " + setting; }
};

/// In the legend's order.
[[nodiscard]] const std::vector<ChartMethod>& chart_methods();

/// What the lobe of GGX normals [Walter07 (33)] is in place of Phi: 1/(g (1 + t/g)^2), of the same energy and
/// width parameter as Beckmann's, exp(-t/g)/g.
[[nodiscard]] double phi_ggx(double g, double t) noexcept;

}  // namespace hts::bench
