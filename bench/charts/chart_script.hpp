/// The charts as gnuplot scripts that hold their own data; `hts chart` runs them.
#pragma once

#include <string>
#include <vector>

#include "bench/charts/chart.hpp"
#include "spectral/output/script.hpp"

namespace hts::bench {

/// (a) Worst error against time, a panel per regime, a point per method.
[[nodiscard]] std::string error_time_script(const ChartData& data);
/// (b) Error over the (g, t/g) plane, a map per method.
[[nodiscard]] std::string error_map_script(const ChartData& data);
/// (c) Time against g, a line per method.
[[nodiscard]] std::string cost_script(const ChartData& data);

// What the three share.

/// Title, what is shown, and the machine, compiler, flags, commit and seed.
[[nodiscard]] output::Script begun(const ChartData& data, const std::string& title,
                                   const std::string& subtitle);

/// Gnuplot's point size: larger with the bytes of the tables.
[[nodiscard]] double marker_size(const ChartMethod& method);

/// In the legend's order.
[[nodiscard]] std::vector<std::string> families();

/// A place of the page, 0 ... 1 from the lower left corner.
struct LegendPlace {
    double x, y;
};

/// The lines of a legend: families and their methods.
class Legend {
  public:
    /// A family's heading and its methods below it, `line` apart; gives the place below.
    LegendPlace add(const std::string& family, LegendPlace at, double line);
    /// The variables legend[], legend_x[], legend_y[], legend_marker[], 0 of a heading, legend_size[] and
    /// legend_colour[].
    void set(output::Script& script) const;

  private:
    std::vector<std::string> texts_, colours_;
    std::vector<double> x_, y_, sizes_;
    std::vector<int> markers_;
};

}  // namespace hts::bench
