// Phi outside the tables: limits, bad arguments and the far tail by summation.
#pragma once

#include "hts/phi.hpp"

namespace hts::phi_detail {

[[nodiscard]] Phi far_phi(double g, double t) noexcept;

/// Its value only; 0 where that is certainly below 1e-300.
[[nodiscard]] double far_phi_value(double g, double t) noexcept;

}  // namespace hts::phi_detail
