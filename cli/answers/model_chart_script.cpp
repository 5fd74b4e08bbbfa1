#include <algorithm>
#include <array>

#include "cli/answers/model_chart.hpp"
#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

/// How a model is drawn; those of one kind share a colour.
struct Mark {
    const char* model;
    const char* colour;
    int shape;  // gnuplot's point type
};
constexpr std::array marks{Mark{"He-Torrance, 1e-6", "#0072b2", 7},
                           Mark{"He-Torrance, 1e-3", "#0072b2", 6},
                           Mark{"first order", "#0072b2", 9},
                           Mark{"rough limit", "#0072b2", 5},
                           Mark{"table, 1e-2", "#e69f00", 12},
                           Mark{"table, 1e-4", "#e69f00", 13},
                           Mark{"Walter, Beckmann", "#d55e00", 5},
                           Mark{"Walter, GGX", "#d55e00", 7},
                           Mark{"Ashikhmin, Gaussian", "#d55e00", 11},
                           Mark{"Cook-Torrance", "#d55e00", 9},
                           Mark{"Kurt", "#009e73", 7},
                           Mark{"Ward", "#009e73", 5},
                           Mark{"Ward-Duer", "#009e73", 4},
                           Mark{"Blinn-Phong", "#cc79a7", 9},
                           Mark{"Ashikhmin-Shirley", "#cc79a7", 11},
                           Mark{"Lafortune", "#cc79a7", 13},
                           Mark{"Oren-Nayar", "#666666", 5},
                           Mark{"Lambert", "#666666", 7}};

std::string style(const Mark& mark) {
    return std::string{" lc rgb '"} + mark.colour + "' pt " + std::to_string(mark.shape);
}

validation::FigureTable table_of(const ModelChart& chart, const std::string& surface, std::size_t number) {
    validation::FigureTable table{
        "models-" + std::to_string(number), {"mark", "nanoseconds", "median_error", "error_99", "bytes"}, {}};
    for (const ModelPoint& point : chart.points) {
        if (point.surface != surface) continue;
        const auto mark = std::find_if(marks.begin(), marks.end(),
                                       [&](const Mark& each) { return point.model == each.model; });
        table.rows.push_back({static_cast<double>(mark - marks.begin()), point.nanoseconds, point.median,
                              point.high, static_cast<double>(point.bytes)});
    }
    return table;
}

/// A panel: a bar from the median to the 99 % error of each model, with the mark at its upper end.
std::string panel(const validation::FigureTable& table, const std::string& title, std::size_t place) {
    const double left = place % 2 == 0 ? 0.07 : 0.45, bottom = place < 2 ? 0.53 : 0.1;
    std::string script =
        "set lmargin at screen " + shortest(left) + "\nset rmargin at screen " + shortest(left + 0.33) +
        "\nset bmargin at screen " + shortest(bottom) + "\nset tmargin at screen " + shortest(bottom + 0.32) +
        "\nset title " + spectral::gnuplot_string(title) + " noenhanced\n" +
        (place < 2 ? "unset xlabel\n" : "set xlabel 'time of four wavelengths, one pair [ns]'\n") +
        (place % 2 == 0 ? "set ylabel 'error, median to 99 %'\n" : "unset ylabel\n") + "plot ";
    const std::string data = spectral::gnuplot_string(table.stem + ".csv");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const Mark& mark = marks.at(static_cast<std::size_t>(table.rows[i][0]));
        const std::string row = std::to_string(i + 1);
        const std::string own = data + " every ::" + row + "::" + row + " using 2:";
        script += own + "($3>2e-8?$3:2e-8):(0):($4-($3>2e-8?$3:2e-8)) with vectors nohead lw 1.5 lc rgb '" +
                  mark.colour + "' notitle, ";
        script += own + "($4>2e-8?$4:2e-8):(size($5)) with points ps variable" + style(mark) + " notitle";
        script += i + 1 < table.rows.size() ? ", \\\n     " : "\n";
    }
    return script;
}

/// How large a mark is for the bytes that the method reads.
constexpr auto size_of_bytes = "size(bytes) = 0.9 + (bytes > 1000 ? 0.35 * log10(bytes / 1000.) : 0)\n";

/// The marks and their names, in a column of its own, and below them what their sizes mean.
std::string legend() {
    std::string script =
        "unset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\nunset title\nunset logscale\n"
        "set lmargin at screen 0.81\nset rmargin at screen 0.99\nset bmargin at screen 0.2\nset tmargin at "
        "screen 0.86\n"
        "set xrange [0:1]\nset yrange [0:1]\nset key at graph 0,1 left top reverse Left spacing 1.25 samplen "
        "1\nplot ";
    for (std::size_t i = 0; i < marks.size(); ++i) {
        script += "NaN with points ps 1.1" + style(marks.at(i)) + " title " +
                  spectral::gnuplot_string(marks.at(i).model);
        script += ", \\\n     ";
    }
    for (const auto& [bytes, title] :
         {std::pair{"1e3", "no table, or 1 kB"}, {"1e5", "tables of 100 kB"}, {"1e7", "of 10 MB"}}) {
        script +=
            std::string{"NaN with points pt 7 lc rgb '#999999' ps size("} + bytes + ") title '" + title + "'";
        script += std::string_view{bytes} == "1e7" ? "\n" : ", \\\n     ";
    }
    return script;
}

}  // namespace

validation::Figure model_figure(const ModelChart& chart) {
    std::vector<std::string> titles;
    for (const ModelPoint& point : chart.points) {
        if (titles.empty() || titles.back() != point.surface) titles.push_back(point.surface);
    }
    validation::Figure figure{"models", {}, validation::figure_style, "Every model, fitted to He-Torrance"};
    figure.script += size_of_bytes;
    figure.script +=
        "set terminal svg size 1200,960 font 'Helvetica,14' background '#ffffff'\nset output picture\n"
        "set multiplot\nset logscale xy\nset format y '10^{%L}'\nset yrange [2e-8:60]\nset xrange "
        "[5:400]\nunset key\n";
    figure.script += validation::page_label(
        "What a cheaper model costs in accuracy, with He-Torrance as the truth", 0.03, 0.965, 18);
    figure.script += validation::page_label(
        "Every other model is fitted to it on each surface, optical constants given; the tables are of it.",
        0.03, 0.935, 13);
    figure.script += validation::page_label(
        "Error: |f - f_he| / (f_he + peak/100) over random pairs up to 80 deg, at 0.46, 0.54, 0.62 and 0.70 "
        "um.",
        0.03, 0.91, 13);
    figure.script +=
        validation::page_label(chart.machine + ", seed " + std::to_string(chart.seed), 0.03, 0.02, 11);
    for (std::size_t i = 0; i < titles.size(); ++i) {
        figure.tables.push_back(table_of(chart, titles[i], i + 1));
        figure.script += panel(figure.tables.back(), titles[i], i);
        if (i == 0) figure.script += "unset label\n";
    }
    figure.script += legend() + "unset multiplot\n";
    return figure;
}

}  // namespace hts::cli
