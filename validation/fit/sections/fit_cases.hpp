/// Which curves are fitted with what, and why so: the list behind fits_section. Private to the fits.
#pragma once

#include <string>
#include <vector>

#include "validation/fit/fit.hpp"
#include "validation/fit/fit_curves.hpp"

namespace hts::validation {

struct FitCase {
    std::string set;    ///< of built_in_curve_names
    std::string label;  ///< "aluminium, sandblasted; n and scale free"
    FitRequest request;
    FitSelection selection{};
    std::size_t quick_points = 120;  ///< at most so many for Effort::quick; 0: all
    bool judged = true;  ///< has a section of its own, with the criteria that are asked of the set
};

[[nodiscard]] std::vector<FitCase> fit_cases();

/// Optical constants of what a set shows, JSON; "" where they are not known.
[[nodiscard]] std::string known_index(const std::string& set);

}  // namespace hts::validation
