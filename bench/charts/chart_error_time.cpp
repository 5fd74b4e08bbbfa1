// Chart (a): error against time.

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/charts/chart_script.hpp"
#include "spectral/output/map_cells.hpp"

namespace hts::bench {
namespace {

constexpr double least_error = 1e-17;
constexpr double top_of_failures = 1e6;  // the band above 1 shows what fails

/// Where a method that fails is drawn: a row of the band for each family.
double row_of_failures(const ChartMethod& method) {
    const auto all = families();
    const auto place = std::find(all.begin(), all.end(), method.style.family) - all.begin();
    const double share = (static_cast<double>(place) + 0.5) / static_cast<double>(all.size());
    return std::pow(top_of_failures, 1 - share);
}

double height(const AccuracyPoint& point) {
    return point.errors.fails() ? row_of_failures(*point.method) : std::fmax(point.errors.worst, least_error);
}

/// A row per point: ns, height, 99.9 %, energy-weighted error, marker, its size, colour, whether it fails.
output::Rows points(const ChartData& data, Regime regime) {
    output::Rows rows;
    for (const AccuracyPoint& point : data.accuracy) {
        if (point.regime != regime) continue;
        const ChartMethod& method = *point.method;
        const double quantile =
            point.errors.quantile < 1 ? std::fmax(point.errors.quantile, least_error) : height(point);
        rows.push_back({point.nanoseconds, height(point), quantile,
                        std::fmax(point.errors.energy, least_error), static_cast<double>(method.style.marker),
                        marker_size(method), output::colour_number(method.style.colour.c_str()),
                        point.errors.fails() ? 1.0 : 0.0});
    }
    return rows;
}

/// The settings of one method that do not fail, in order; a gap between methods.
output::Rows lines(const ChartData& data, Regime regime) {
    output::Rows rows;
    const AccuracyPoint* last = nullptr;
    for (const AccuracyPoint& point : data.accuracy) {
        if (point.regime != regime || point.errors.fails()) continue;
        const ChartMethod& method = *point.method;
        if (last != nullptr && (last->method->name != method.name || last->method->batch != method.batch)) {
            rows.emplace_back();
        }
        rows.push_back(
            {point.nanoseconds, height(point), output::colour_number(method.style.colour.c_str())});
        last = &point;
    }
    return rows;
}

Legend method_legend() {
    constexpr std::array columns{0.015, 0.15, 0.29, 0.455, 0.555, 0.69, 0.815, 0.915};
    Legend legend;
    const auto all = families();
    for (std::size_t i = 0; i < all.size() && i < columns.size(); ++i)
        static_cast<void>(legend.add(all[i], {columns[i], 0.19}, 0.0235));
    return legend;
}

}  // namespace

std::string error_time_script(const ChartData& data) {
    std::vector<std::string> titles;
    std::vector<output::Rows> of_points, of_lines;
    for (const Regime regime : regimes) {
        titles.emplace_back(title(regime));
        of_points.push_back(points(data, regime));
        of_lines.push_back(lines(data, regime));
    }
    auto script = begun(data, "What a value of Φ(g, t) costs, and how wrong it is",
                        "Every point is a method with a setting: to the left is faster, further down is more "
                        "accurate. Errors against 50 digits at " +
                            std::to_string(data.settings.points) +
                            " random points per panel; times at as many more as fit, drawn beforehand.");
    method_legend().set(script);
    script.set("regime", titles).data("points", of_points).data("lines", of_lines);
    return script.with("error-against-time");
}

}  // namespace hts::bench
