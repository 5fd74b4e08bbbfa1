// Chart (c): time against g.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "bench/charts/chart_script.hpp"
#include "spectral/text/text.hpp"

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
    const ChartMethod* ours = nullptr;
    for (const ChartMethod& method : chart_methods()) {
        if (method.ours && !method.batch && (ours == nullptr || method.error == 1e-6)) ours = &method;
    }
    const double fast = time_at(data, ours->title(), false, 1e4);
    const double windowed = time_at(data, "series, windowed, logarithms", false, 1e4);
    const double plain = time_at(data, "series, from m = 1, logarithms", false, 1e4);
    if (fast == 0 || windowed == 0 || plain == 0) return "";
    return "At g = 10⁴, " + ours->name + " to " + ours->setting + " is " + times_faster(windowed, fast) +
           " times faster than the windowed series and " + times_faster(plain, fast) +
           " times faster than the sum from m = 1.";
}

/// $m0, $m1, …: g, ns, whether it fails.
void write_line(std::ostream& out, const ChartData& data, const ChartMethod& method, std::size_t index) {
    out << "$m" << index << " << EOD\n";
    for (const CostPoint& point : data.cost) {
        if (point.method == &method) out << point.g << ' ' << point.nanoseconds << ' ' << point.fails << '\n';
    }
    out << "EOD\n";
}

void write_legend(std::ostream& out) {
    script::LegendPlace place{0.775, 0.9};
    for (const std::string& family : script::families()) {
        place = script::write_family(out, family, place, 0.0215);
    }
}

}  // namespace

std::string cost_script(const ChartData& data) {
    std::ostringstream out;
    script::begin_page(out, 1250, 950);
    const auto& methods = chart_methods();
    for (std::size_t i = 0; i < methods.size(); ++i) write_line(out, data, methods[i], i);
    script::write_frame(out, data, "What a value of Φ(g, t) costs as the surface grows rougher",
                        comparison(data) + " Dotted: at some of these t/g the method has no correct digit.",
                        0.97);
    write_legend(out);
    out << "set lmargin at screen 0.075\nset rmargin at screen 0.755\nset bmargin at screen 0.115\n"
           "set tmargin at screen 0.905\nset logscale xy\nset grid xtics ytics lc rgb '#e4e4e4' lw 0.6\n"
           "set xrange [1e-3:1e8]\nset yrange [1:1e9]\nset ytics "
        << script::time_tics()
        << "\nset xtics format '10^{%T}' 10\nset mxtics 1\nset mytics 1\n"
           "set xlabel 'phase variance g (t/g uniform in 0 … 10)'\nset ylabel 'time per value, one "
           "core'\nplot ";
    for (std::size_t i = 0; i < methods.size(); ++i) {
        const ChartStyle& style = methods[i].style;
        const std::string colour = " lc rgb " + spectral::gnuplot_string(style.colour);
        out << (i == 0 ? "" : ", \\\n  ") << "$m" << i << " with lines dt 3 lw 1" << colour << ", $m" << i
            << " using 1:($3 == 1 ? NaN : $2) with linespoints pi 2 pt " << style.marker << " ps "
            << script::marker_size(methods[i]) << " lw " << (methods[i].ours ? 2.4 : 1.3) << colour;
    }
    out << "\nunset multiplot\n";
    return out.str();
}

}  // namespace hts::bench
