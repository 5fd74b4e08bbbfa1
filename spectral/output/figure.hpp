/// Figures as data: a gnuplot script and the numbers it reads. The command line draws them.
#pragma once

#include <string>
#include <vector>

namespace hts::output {

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

}  // namespace hts::output
