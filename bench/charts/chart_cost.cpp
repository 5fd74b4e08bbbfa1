// Chart (c): time against g.

#include <algorithm>
#include <cmath>

#include "bench/charts/chart_script.hpp"

namespace hts::bench {
namespace {

/// Time of a method at a g, by name and setting; 0 if it was not measured.
double time_at(const ChartData& data, const std::string& title, bool batch, double g) {
    for (const CostPoint& point : data.cost) {
        if (point.method->title() != title || point.method->batch != batch) continue;
        if (std::fabs(std::log10(point.g / g)) < 0.01) return point.nanoseconds;
    }
    return 0;
}

/// A ratio to two digits.
std::string times_faster(double slow, double fast) {
    const double ratio = slow / fast;
    const double unit = std::pow(10, std::floor(std::log10(ratio)) - 1);
    return std::to_string(std::lround(std::round(ratio / unit) * unit));
}

/// "At g = 10^4, hts::phi to 1e-6 is 1900 times faster than …", as far as both were measured.
std::string comparison(const ChartData& data) {
    const auto ours = std::ranges::find_if(chart_methods(), [](const ChartMethod& method) {
        return method.ours && !method.batch && method.error == 1e-6;
    });
    if (ours == chart_methods().end()) return "";
    const double fast = time_at(data, ours->title(), false, 1e4);
    const double windowed = time_at(data, "series, windowed, logarithms", false, 1e4);
    const double plain = time_at(data, "series, from m = 1, logarithms", false, 1e4);
    if (fast == 0 || windowed == 0 || plain == 0) return "";
    return "At g = 10⁴, " + ours->name + " to " + ours->setting + " is " + times_faster(windowed, fast) +
           " times faster than the windowed series and " + times_faster(plain, fast) +
           " times faster than the sum from m = 1.";
}

/// A row per g: g, ns, whether it fails.
output::Rows times(const ChartData& data, const ChartMethod& method) {
    output::Rows rows;
    for (const CostPoint& point : data.cost) {
        if (point.method == &method) rows.push_back({point.g, point.nanoseconds, point.fails ? 1.0 : 0.0});
    }
    return rows;
}

Legend legend() {
    Legend legend;
    LegendPlace place{0.775, 0.9};
    for (const std::string& family : families()) place = legend.add(family, place, 0.0215);
    return legend;
}

}  // namespace

std::string cost_script(const ChartData& data) {
    std::vector<int> markers;
    std::vector<double> sizes, widths;
    std::vector<std::string> colours;
    std::vector<output::Rows> of_methods;
    for (const ChartMethod& method : chart_methods()) {
        markers.push_back(method.style.marker);
        sizes.push_back(marker_size(method));
        widths.push_back(method.ours ? 2.4 : 1.3);
        colours.push_back(method.style.colour);
        of_methods.push_back(times(data, method));
    }
    auto script = begun(data, "What a value of Φ(g, t) costs as the surface grows rougher",
                        comparison(data) + " Dotted: at some of these t/g the method has no correct digit.");
    legend().set(script);
    script.set("marker", markers).set("marker_size", sizes).set("width", widths).set("ink", colours);
    return script.data("times", of_methods).with("cost-against-g");
}

}  // namespace hts::bench
