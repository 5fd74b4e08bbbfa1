/// The charts as gnuplot scripts that hold their own data; `hts chart` runs them.
///
/// Colours are those of Okabe and Ito and of viridis, for all kinds of colour vision; the canvas is white, so
/// the pictures stand on light and dark pages.
#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include "bench/charts/chart.hpp"

namespace hts::bench {

/// (a) Worst error against time, a panel per regime, a point per method.
[[nodiscard]] std::string error_time_script(const ChartData& data);
/// (b) Error over the (g, t/g) plane, a map per method.
[[nodiscard]] std::string error_map_script(const ChartData& data);
/// (c) Time against g, a line per method.
[[nodiscard]] std::string cost_script(const ChartData& data);

/// What the three share.
namespace script {

/// "0xd55e00" from "#d55e00".
[[nodiscard]] std::string colour_number(const std::string& colour);

/// Gnuplot's point size: larger with the bytes of the tables.
[[nodiscard]] double marker_size(const ChartMethod& method);

/// Tic list of a logarithmic axis of times, "'1 ns' 1, '10 ns' 10, …".
[[nodiscard]] std::string time_tics();

/// Terminal, output and multiplot of a page in pixels.
void begin_page(std::ostream& out, int width, int height);
/// A text at a place of the page, 0 ... 1 from the lower left corner.
void write(std::ostream& out, double x, double y, int size, std::string_view text, std::string_view colour);
/// Title, what is shown, and the machine, compiler, flags, commit and seed at the foot.
void write_frame(std::ostream& out, const ChartData& data, std::string_view title, std::string_view subtitle,
                 double top);

/// Where the next line of the legend goes.
struct LegendPlace {
    double x, y;
};
/// A family's heading and its methods below it, `line` apart; gives the place below.
LegendPlace write_family(std::ostream& out, const std::string& family, LegendPlace at, double line);
/// In the legend's order.
[[nodiscard]] std::vector<std::string> families();

}  // namespace script
}  // namespace hts::bench
