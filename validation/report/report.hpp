/// What a validation found, section by section; `hts validate` makes one self-contained page of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "spectral/output/figure.hpp"
#include "spectral/text/verdict.hpp"

namespace hts::validation {

using output::Figure;
using output::FigureTable;

/// A claim and what was measured of it.
struct Check {
    std::string claim;     ///< with its bound: "median |ln(model / measured)| <= 0.25 up to 80 deg"
    std::string measured;  ///< "0.31"
    bool passed;
    std::string remark{};  ///< where it fails, why
    /// Relative change of the numbers in `measured` that is still the same result: what another machine,
    /// compiler or minimum of a fit may make of them.
    double tolerance = 0.01;

    [[nodiscard]] const char* verdict() const noexcept { return spectral::verdict(passed); }
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
    std::string learned{};         ///< a sentence for the head of the page; "" leaves it to the checks
    bool part_of_another = false;  ///< whose `learned` speaks of it too
};

/// How much work a validation does.
enum class Effort { quick, full };

/// What is computed of few points or realisations says so in its claims.
inline constexpr std::string_view quick_mark = "quick: ";
void mark_as_quick(std::vector<Check>& checks);

}  // namespace hts::validation
