/// Figures as data: a gnuplot script and the numbers it reads. The command line draws them.
///
/// The canvas is white and colours are those of Okabe and Ito, so that pictures stand on light and dark pages
/// and are read with all kinds of colour vision.
#pragma once

#include <string>
#include <vector>

namespace hts::validation {

/// Numbers of a figure or of one of its panels.
struct FigureTable {
    std::string stem;  ///< of the file: "figure-3"
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
};

/// A picture and the numbers in it; the script reads STEM.csv of each table.
struct Figure {
    std::string stem;
    std::vector<FigureTable> tables;
    std::string script;
    std::string caption{};  ///< what is shown and whose measurement it is; a sentence or two
};

/// What every script begins with: CSV in, quiet axes and grid.
inline constexpr auto figure_style = R"(set datafile separator comma
set border 3 lc rgb '#666666'
set tics nomirror textcolor rgb '#333333'
set grid lc rgb '#e4e4e4' lw 0.6
)";

/// A label on the page, at 0 ... 1 from the lower left corner.
[[nodiscard]] std::string page_label(const std::string& text, double x, double y, int size);

/// Numbers that stand in the script itself, to be plotted as $NAME; NaN leaves a gap.
[[nodiscard]] std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows);

}  // namespace hts::validation
