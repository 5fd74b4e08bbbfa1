// Chart (a): error against time.

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "bench/charts/chart_script.hpp"
#include "spectral/text/text.hpp"

namespace hts::bench {
namespace {

using script::colour_number;

constexpr double least_error = 1e-17;
constexpr double top_of_failures = 1e6;  // the band above 1 shows what fails

/// A rectangle of the page.
struct Box {
    double left, right, bottom, top;
};

Box box(std::size_t panel) {
    constexpr double width = 0.293, height = 0.285;
    const double left = 0.058 + 0.318 * static_cast<double>(panel % 3);
    const double bottom = panel < 3 ? 0.615 : 0.275;
    return {left, left + width, bottom, bottom + height};
}

/// Where a method that fails is drawn: a row of the band for each family.
double row_of_failures(const ChartMethod& method) {
    const auto families = script::families();
    const auto place = std::find(families.begin(), families.end(), method.style.family) - families.begin();
    const double share = (static_cast<double>(place) + 0.5) / static_cast<double>(families.size());
    return std::pow(top_of_failures, 1 - share);
}

double height(const AccuracyPoint& point) {
    return point.errors.fails() ? row_of_failures(*point.method) : std::fmax(point.errors.worst, least_error);
}

/// $points: ns, height, 99.9 %, energy-weighted error, marker, its size, colour, whether it fails.
void write_points(std::ostream& out, const ChartData& data, Regime regime) {
    out << "$points << EOD\n";
    for (const AccuracyPoint& point : data.accuracy) {
        if (point.regime != regime) continue;
        const ChartMethod& method = *point.method;
        const double quantile =
            point.errors.quantile < 1 ? std::fmax(point.errors.quantile, least_error) : height(point);
        out << point.nanoseconds << ' ' << height(point) << ' ' << quantile << ' '
            << std::fmax(point.errors.energy, least_error) << ' ' << method.style.marker << ' '
            << script::marker_size(method) << ' ' << colour_number(method.style.colour) << ' '
            << point.errors.fails() << '\n';
    }
    out << "EOD\n";
}

/// $lines: the settings of one method that do not fail, in order; a blank line between methods.
void write_lines(std::ostream& out, const ChartData& data, Regime regime) {
    out << "$lines << EOD\n";
    const AccuracyPoint* last = nullptr;
    for (const AccuracyPoint& point : data.accuracy) {
        if (point.regime != regime || point.errors.fails()) continue;
        const ChartMethod& method = *point.method;
        if (last != nullptr && (last->method->name != method.name || last->method->batch != method.batch)) {
            out << '\n';
        }
        out << point.nanoseconds << ' ' << height(point) << ' ' << colour_number(method.style.colour) << '\n';
        last = &point;
    }
    out << "EOD\n";
}

void write_axes(std::ostream& out, std::size_t panel) {
    const Box place = box(panel);
    const bool outer_left = panel % 3 == 0;
    const bool outer_bottom = panel >= 3;
    out << "set lmargin at screen " << place.left << "\nset rmargin at screen " << place.right
        << "\nset bmargin at screen " << place.bottom << "\nset tmargin at screen " << place.top << '\n'
        << "set xtics " << (outer_bottom ? script::time_tics() : "format '' 10") << '\n'
        << "set ytics format " << (outer_left ? "'10^{%T}'" : "''") << " 1e-16,100,1\n"
        << "set ylabel " << (outer_left ? "'worst relative error'" : "''") << " offset 0.5,0\n"
        << "set xlabel " << (outer_bottom ? "'time per value of Φ, one core'" : "''") << '\n';
}

/// The band of failures and the name of the regime.
void write_panel_texts(std::ostream& out, Regime regime) {
    out << "set title " << spectral::gnuplot_string(title(regime)) << " offset 0,-0.6 font ',15' noenhanced\n"
        << "set object 1 rect from graph 0, first 1 to graph 1, graph 1 fc rgb '#f0f0f0' fs solid noborder "
           "behind\n"
        << "set arrow 1 from graph 0, first 0.07 to graph 1, first 0.07 nohead lc rgb '#888888' lw 1 dt 2 "
           "back\n"
           "set label 'fails' at graph 0.985, graph 0.95 right textcolor rgb '#666666' font ',12'\n";
}

void write_legend(std::ostream& out) {
    constexpr std::array columns{0.015, 0.15, 0.29, 0.455, 0.555, 0.69, 0.815, 0.915};
    const auto families = script::families();
    for (std::size_t i = 0; i < families.size() && i < columns.size(); ++i) {
        static_cast<void>(script::write_family(out, families[i], {columns[i], 0.19}, 0.0235));
    }
    script::write(
        out, 0.012, 0.058, 12,
        "Marker: worst error; it grows with the bytes of the method's tables. Dot: 99.9 % of the "
        "points are better. Lower end of the line: error weighted by energy. Joined: settings of one "
        "method.",
        "#333333");
    script::write(
        out, 0.012, 0.039, 12,
        "Crossed, in the grey band: at some points no correct digit, 0, infinity or NaN. Dashed: 7 % "
        "(0.3 dB), a typical distance of the model itself from exact scattering.",
        "#333333");
}

void write_panel(std::ostream& out, const ChartData& data, std::size_t panel) {
    const Regime regime = regimes[panel];
    write_points(out, data, regime);
    write_lines(out, data, regime);
    write_axes(out, panel);
    write_panel_texts(out, regime);
    out << "plot $points using 1:(column(4) < 1 ? $4 : 1):(0):($2 - (column(4) < 1 ? $4 : 1)):7 with vectors "
           "nohead lw 0.8 lc rgb variable, \\\n"
           "  $lines using 1:2:3 with lines lw 1.2 lc rgb variable, \\\n"
           "  $points using 1:3:7 with points pt 7 ps 0.3 lc rgb variable, \\\n"
           "  $points using 1:2:6:5:7 with points ps variable pt variable lc rgb variable lw 1.6, \\\n"
           "  $points using 1:($8 == 1 ? $2 : NaN) with points pt 2 ps 1 lw 1.2 lc rgb '#ffffff'\n"
           "unset label\nunset object\n";
}

}  // namespace

std::string error_time_script(const ChartData& data) {
    std::ostringstream out;
    script::begin_page(out, 1500, 1120);
    out << "set logscale xy\nset grid xtics ytics lc rgb '#e4e4e4' lw 0.6\nset mxtics 1\nset mytics 1\n"
        << "set xrange [1:2e7]\nset yrange [" << least_error << ":" << top_of_failures << "]\n";
    script::write_frame(out, data, "What a value of Φ(g, t) costs, and how wrong it is",
                        "Every point is a method with a setting: to the left is faster, further down is more "
                        "accurate. Errors against 50 digits at " +
                            std::to_string(data.settings.points) +
                            " random points per panel; times at as many more as fit, drawn beforehand.",
                        0.975);
    write_legend(out);
    for (std::size_t panel = 0; panel < std::size(regimes); ++panel) write_panel(out, data, panel);
    out << "unset multiplot\n";
    return out.str();
}

}  // namespace hts::bench
