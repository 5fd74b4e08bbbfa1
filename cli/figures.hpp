/// The figures of the papers, computed anew: pictures with the numbers in them.
#pragma once

#include <string>
#include <vector>

namespace hts::cli {

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
};

/// What every script begins with: CSV in, quiet axes and grid.
inline constexpr auto figure_style = R"(set datafile separator comma
set border 3 lc rgb '#666666'
set tics nomirror textcolor rgb '#333333'
set grid lc rgb '#e4e4e4' lw 0.6
)";

/// A label on the page, at 0 ... 1 from the lower left corner.
[[nodiscard]] std::string page_label(const std::string& text, double x, double y, int size);

/// Figures 2, 8, 10, 11, 13 and 14 of Walter, Marschner, Li and Torrance 2007, theory alone.
[[nodiscard]] std::vector<Figure> walter_figures();

/// Figures 2 and 3 of Kurt, Szirmay-Kalos and Krivanek 2010 and the map of where their model conserves energy.
[[nodiscard]] std::vector<Figure> kurt_figures();

}  // namespace hts::cli
