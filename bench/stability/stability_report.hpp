/// The results of the stability suite for a terminal, a spreadsheet and a browser.
#pragma once

#include <ostream>
#include <vector>

#include "bench/stability/stability.hpp"

namespace hts::bench {

/// A table of the columns row, method, verdict, where; `*` marks the engine; a summary line at the end.
void write_stability_text(std::ostream& out, const std::vector<StabilityResult>& results);

/// row,problem,method,engine,verdict,error,bound,cases,failures,detail,where,why, quoted where needed.
void write_stability_csv(std::ostream& out, const std::vector<StabilityResult>& results);

/// One self-contained page, light or dark as the reader's system is; each failure with its reason.
void write_stability_html(std::ostream& out, const std::vector<StabilityResult>& results);

}  // namespace hts::bench
