// The compiled forms of phi for one instruction set.
#pragma once

#include <array>
#include <cstddef>

#include "hts/phi.hpp"

namespace hts::phi_detail {

using PhiOne = double (*)(double g, double t);
using PhiMany = void (*)(const double* g, const double* t, double* result, std::size_t count);

/// Low, Medium, High, as in phi_table.hpp.
struct PhiForms {
    std::array<PhiOne, 3> one;
    std::array<PhiMany, 3> many;
    Phi (*with_log)(double g, double t);          ///< High
    PhiGradient (*gradient)(double g, double t);  ///< of the polynomials of High; summed where it has no cell
};

/// Those of the best instruction set that this processor has, or of the one a test has set.
[[nodiscard]] PhiForms phi_forms() noexcept;

}  // namespace hts::phi_detail
