/// The figures of the papers, computed anew: pictures with the numbers in them.
#pragma once

#include <vector>

#include "validation/report/report.hpp"

namespace hts::validation {

/// Figures 2, 8, 10, 11, 13 and 14 of Walter, Marschner, Li and Torrance 2007, theory alone.
[[nodiscard]] std::vector<Figure> walter_figures();

/// Figures 2 and 3 of Kurt, Szirmay-Kalos and Krivanek 2010 and the map of where their model conserves
/// energy.
[[nodiscard]] std::vector<Figure> kurt_figures();

}  // namespace hts::validation
