/// What a validation found, section by section; `hts validate` makes one self-contained page of it.
#pragma once

#include <string>
#include <vector>

#include "spectral/output/figure.hpp"

namespace hts::validation {

using output::Figure;
using output::FigureTable;

/// A claim and what was measured of it.
struct Check {
    std::string claim;     ///< with its bound: "median |ln(model / measured)| <= 0.25 up to 80 deg"
    std::string measured;  ///< "0.31"
    bool passed;
    std::string remark{};  ///< where it fails, why
};

/// A table to be read.
struct ReportTable {
    std::string stem;  ///< of the file beside the report
    std::string caption;
    std::vector<std::string> columns;  ///< with units
    std::vector<std::vector<std::string>> rows;
};

/// A rendered picture.
struct Image {
    std::string stem;
    std::string caption;
    std::string png;  ///< the bytes of the file
};

struct Section {
    std::string stem;  ///< names its files and its place on the page: "sandblasted-aluminium"
    std::string title;
    std::string text;  ///< paragraphs, apart by empty lines; plain text
    std::vector<Check> checks;
    std::vector<Figure> figures;
    std::vector<Image> images;
    std::vector<ReportTable> tables;
    std::vector<std::string> not_available;  ///< what one would want to see and nobody has
};

/// How much work a validation does.
enum class Effort { quick, full };

}  // namespace hts::validation
