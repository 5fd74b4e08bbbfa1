/// A report as one self-contained page and as JSON.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/report/report.hpp"

namespace hts::validation {

/// Checks of a report that passed, and all of them.
struct Tally {
    std::size_t passed, all;
};
[[nodiscard]] Tally tally(const std::vector<Section>& sections);

/// What a page says.
struct Validation {
    std::vector<Section> sections;
    std::vector<std::string> contradictions;  ///< of `Record::contradictions`
};

/// One HTML page with every picture in it, light or dark as the reader's system is: whether the program does
/// what is recorded, what was learned of the model, and the sections, which fold.
///   provenance   who computed it: version, machine, commit
///   svg          the text of a figure's picture
[[nodiscard]] std::string report_page(const Validation& findings, const std::string& provenance,
                                      const std::function<std::string(const Figure& figure)>& svg);

/// Checks and tables without the pictures, two spaces deep: {"provenance", "passed", "checks",
/// "contradictions", "sections": […]}.
[[nodiscard]] std::string report_json(const Validation& findings, const std::string& provenance);

}  // namespace hts::validation
