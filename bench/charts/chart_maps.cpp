// Chart (b): maps of the error over the (g, t/g) plane.

#include <array>
#include <cmath>
#include <sstream>

#include "bench/charts/chart_script.hpp"
#include "spectral/text/text.hpp"

namespace hts::bench {
namespace {

/// Errors up to a bound, in one colour of viridis.
struct ErrorClass {
    double most;
    const char* colour;
    const char* name;
};

constexpr std::array classes{ErrorClass{1e-14, "#440154", "≤ 1e-14"}, ErrorClass{1e-12, "#46327e", "1e-12"},
                             ErrorClass{1e-9, "#365c8d", "1e-9"},     ErrorClass{1e-6, "#277f8e", "1e-6"},
                             ErrorClass{1e-4, "#1fa187", "1e-4"},     ErrorClass{1e-3, "#4ac16d", "1e-3"},
                             ErrorClass{1e-2, "#a0da39", "1e-2"},     ErrorClass{1, "#fde725", "< 1"}};
constexpr ErrorClass failure{HUGE_VAL, "#d55e00", "no digit, 0, inf, NaN"};
constexpr ErrorClass nothing{HUGE_VAL, "#dddddd", "Φ < 1e-300"};

const ErrorClass& class_of(double error) {
    if (std::isnan(error)) return nothing;
    for (const ErrorClass& each : classes) {
        if (error < each.most || (each.most < 1 && error == each.most)) return each;
    }
    return failure;
}

/// Edge of a cell along an axis, as a power of ten.
double edge(double low, double high, std::size_t index, std::size_t count) {
    return std::log10(low) + std::log10(high / low) * static_cast<double>(index) / static_cast<double>(count);
}

/// $cells: left, right, bottom and top in powers of ten, colour; neighbours along g of the same colour are
/// one.
void write_cells(std::ostream& out, const ErrorMap& map, const PlaneGrid& grid) {
    out << "$cells << EOD\n";
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t first = 0, next = 0; first < grid.columns; first = next) {
            const ErrorClass& each = class_of(map.errors[row * grid.columns + first]);
            while (next < grid.columns && &class_of(map.errors[row * grid.columns + next]) == &each) ++next;
            const auto along_g = [&](std::size_t i) {
                return edge(PlaneGrid::least_g, PlaneGrid::most_g, i, grid.columns);
            };
            const auto along_ratio = [&](std::size_t i) {
                return edge(PlaneGrid::least_ratio, PlaneGrid::greatest_ratio, i, grid.rows);
            };
            out << along_g(first) << ' ' << along_g(next) << ' ' << along_ratio(row) << ' '
                << along_ratio(row + 1) << ' ' << script::colour_number(each.colour) << '\n';
        }
    }
    out << "EOD\n";
}

struct Layout {
    std::size_t columns, rows;
};

void write_axes(std::ostream& out, std::size_t index, std::size_t count, Layout layout) {
    const std::size_t column = index % layout.columns;
    const std::size_t row = index / layout.columns;
    const double pitch_x = 0.945 / static_cast<double>(layout.columns);
    const double pitch_y = 0.82 / static_cast<double>(layout.rows);
    const double left = 0.05 + pitch_x * static_cast<double>(column);
    const double top = 0.9 - pitch_y * static_cast<double>(row);
    const bool lowest = index + layout.columns >= count;
    out << "set lmargin at screen " << left << "\nset rmargin at screen " << left + 0.86 * pitch_x
        << "\nset tmargin at screen " << top << "\nset bmargin at screen " << top - 0.7 * pitch_y << '\n'
        << "set xtics format " << (lowest ? "'10^{%.0f}'" : "''") << " -2,2,4 scale 0.6 offset 0,0.3\n"
        << "set ytics format " << (column == 0 ? "'10^{%.0f}'" : "''") << " -2,1,2 scale 0.6\n"
        << "set ylabel " << (column == 0 ? "'t/g'" : "''") << " offset 1,0\n"
        << "set xlabel " << (lowest ? "'g'" : "''") << " offset 0,0.7\n";
}

void write_swatch(std::ostream& out, double x, const ErrorClass& each) {
    out << "set object rect from screen " << x << ",0.041 to screen " << x + 0.022 << ",0.059 fc rgb '"
        << each.colour << "' fs solid noborder\n";
    script::write(out, x + 0.026, 0.05, 12, each.name, "#222222");
}

void write_legend(std::ostream& out) {
    script::write(out, 0.012, 0.05, 13, "relative error", "#000000");
    double x = 0.1;
    for (const ErrorClass& each : classes) {
        write_swatch(out, x, each);
        x += 0.081;
    }
    write_swatch(out, x, failure);
    write_swatch(out, x + 0.145, nothing);
}

}  // namespace

std::string error_map_script(const ChartData& data) {
    const std::size_t count = data.maps.size();
    const Layout layout{5, (count + 4) / 5};
    std::ostringstream out;
    script::begin_page(out, 1400, 260 + 210 * static_cast<int>(layout.rows));
    out << "set border 15\nset xrange [-2:6]\nset yrange [-2:" << std::log10(PlaneGrid::greatest_ratio)
        << "]\nset style fill solid 1\n";
    script::write_frame(out, data, "Where each way to compute Φ(g, t) breaks",
                        "Relative error against 50 digits over phase variance g and lobe argument t/g, "
                        ""
                        "the squared slope of the facet seen, in units of the surface's.",
                        0.975);
    write_legend(out);
    for (std::size_t i = 0; i < count; ++i) {
        write_cells(out, data.maps[i], data.settings.grid);
        write_axes(out, i, count, layout);
        out << "set title " << spectral::gnuplot_string(data.maps[i].method->title())
            << " offset 0,-0.8 font ',13' noenhanced\n"
            << "plot $cells using (($1+$2)/2):(($3+$4)/2):1:2:3:4:5 with boxxyerror fs solid 1 border lw 0.3 "
               "lc rgb variable\n"
               "unset label\nunset object\n";
    }
    out << "unset multiplot\n";
    return out.str();
}

}  // namespace hts::bench
