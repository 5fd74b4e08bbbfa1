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

/// One HTML page with every picture in it, light or dark as the reader's system is: what failed first, then
/// section by section.
///   provenance   who computed it: version, machine, commit
///   svg          the text of a figure's picture
[[nodiscard]] std::string report_page(const std::vector<Section>& sections, const std::string& provenance,
                                      const std::function<std::string(const Figure& figure)>& svg);

/// Checks and tables without the pictures, two spaces deep: {"provenance", "passed", "checks", "sections":
/// […]}.
[[nodiscard]] std::string report_json(const std::vector<Section>& sections, const std::string& provenance);

}  // namespace hts::validation
