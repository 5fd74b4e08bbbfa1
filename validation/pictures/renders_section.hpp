/// The pictures of the papers' scenes, for the report.
#pragma once

#include "validation/report/report.hpp"

namespace hts::validation {

/// Every gallery, small with Effort::quick, and what the text of He et al. 1991 says of Figs 12 and 14,
/// measured in the scenes.
[[nodiscard]] Section renders_section(Effort effort);

}  // namespace hts::validation
