#include "cli/answers/furnace_script.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "bench/charts/chart_script.hpp"
#include "hts/error.hpp"

namespace hts::cli {
namespace {

namespace script = bench::script;

/// Totals up to a bound, in one colour: blue where light is lost, orange where it is gained.
struct TotalClass {
    double most;
    const char* colour;
    const char* name;
};

constexpr std::array classes{
    TotalClass{0.5, "#08306b", "below 0.5"},    TotalClass{0.7, "#08519c", "0.5 – 0.7"},
    TotalClass{0.9, "#3182bd", "0.7 – 0.9"},    TotalClass{0.97, "#6baed6", "0.9 – 0.97"},
    TotalClass{0.99, "#bdd7e7", "0.97 – 0.99"}, TotalClass{0.999, "#deebf7", "0.99 – 0.999"},
    TotalClass{1.001, "#f4f4f4", "1 ± 0.001"},  TotalClass{1.01, "#fdd0a2", "to 1.01"},
    TotalClass{1.02, "#fd8d3c", "to 1.02"},     TotalClass{HUGE_VAL, "#a63603", "above 1.02"}};

const TotalClass& class_of(double total) {
    std::size_t i = 0;
    while (total >= classes[i].most) ++i;
    return classes[i];
}

/// $cells: edges in angle and in powers of ten of the roughness, colour; neighbours in angle of one colour
/// are one.
void write_cells(std::ostream& out, const FurnaceGrid& grid, const double* totals) {
    const double half_width = (grid.degrees[1] - grid.degrees[0]) / 2;
    const double half_height = std::log10(grid.roughnesses[1] / grid.roughnesses[0]) / 2;
    const std::size_t across = grid.degrees.size();
    out << "$cells << EOD\n";
    for (const double roughness : grid.roughnesses) {
        const double height = std::log10(roughness);
        for (std::size_t first = 0, next = 0; first < across; first = next) {
            const TotalClass& each = class_of(totals[first]);
            while (next < across && &class_of(totals[next]) == &each) ++next;
            out << grid.degrees[first] - half_width << ' ' << grid.degrees[next - 1] + half_width << ' '
                << height - half_height << ' ' << height + half_height << ' '
                << script::colour_number(each.colour) << '\n';
        }
        totals += across;
    }
    out << "EOD\n";
}

struct Place {
    std::size_t index, columns, rows;

    [[nodiscard]] std::size_t column() const { return index % columns; }
    [[nodiscard]] std::size_t row() const { return index / columns; }
};

void write_axes(std::ostream& out, const Place& place) {
    const double pitch_x = 0.94 / static_cast<double>(place.columns);
    const double pitch_y = 0.78 / static_cast<double>(place.rows);
    const double left = 0.065 + pitch_x * static_cast<double>(place.column());
    const double top = 0.865 - pitch_y * static_cast<double>(place.row());
    const bool lowest = place.row() + 1 == place.rows;
    out << "set lmargin at screen " << left << "\nset rmargin at screen " << left + 0.88 * pitch_x
        << "\nset tmargin at screen " << top << "\nset bmargin at screen " << top - 0.78 * pitch_y << '\n'
        << "set xtics format " << (lowest ? "'%.0f°'" : "''") << " 0,15,90 scale 0.6\n"
        << "set ytics format " << (place.column() == 0 ? "'10^{%.0f}'" : "''") << " -3,1,2 scale 0.6\n"
        << "set ylabel " << (place.column() == 0 ? "'σ_0/λ'" : "''") << " offset 0.5,0\n"
        << "set xlabel " << (lowest ? "'angle of incidence'" : "''") << " offset 0,0.3\n";
}

void write_legend(std::ostream& out) {
    double x = 0.04;
    for (const TotalClass& each : classes) {
        out << "set object rect from screen " << x << ",0.028 to screen " << x + 0.02 << ",0.048 fc rgb '"
            << each.colour << "' fs solid border lc rgb '#999999'\n";
        script::write(out, x + 0.024, 0.038, 12, each.name, "#222222");
        x += 0.096;
    }
}

}  // namespace

std::string furnace_script(const FurnaceGrid& grid, const std::vector<double>& totals,
                           const std::string& title, const std::string& subtitle) {
    std::ostringstream out;
    const std::size_t columns = 3, rows = (grid.slopes.size() + columns - 1) / columns;
    script::begin_page(out, 1200, 200 + 300 * static_cast<int>(rows));
    const double half_width = (grid.degrees[1] - grid.degrees[0]) / 2;
    const double half_height = std::log10(grid.roughnesses[1] / grid.roughnesses[0]) / 2;
    out << "set border 15\nset style fill solid 1\nset xrange [" << grid.degrees.front() - half_width << ":"
        << grid.degrees.back() + half_width << "]\nset yrange ["
        << std::log10(grid.roughnesses.front()) - half_height << ":"
        << std::log10(grid.roughnesses.back()) + half_height << "]\n";
    script::write(out, 0.012, 0.965, 20, title, "#000000");
    script::write(out, 0.012, 0.93, 13, subtitle, "#333333");
    write_legend(out);
    for (std::size_t i = 0; i < grid.slopes.size(); ++i) {
        write_cells(out, grid, totals.data() + i * grid.roughnesses.size() * grid.degrees.size());
        write_axes(out, {i, columns, rows});
        out << "set title 'σ_0/τ = " << shortest(grid.slopes[i]) << "' offset 0,-0.6 font ',14'\n"
            << "plot $cells using (($1+$2)/2):(($3+$4)/2):1:2:3:4:5 with boxxyerror fs solid 1 border lw 0.3 "
               "lc rgb variable\n"
               "unset label\nunset object\n";
    }
    out << "unset multiplot\n";
    return out.str();
}

}  // namespace hts::cli
