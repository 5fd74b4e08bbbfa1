/// Nodes of Gauss and Legendre, as many as asked for at run time.
#pragma once

#include <vector>

namespace hts::validation {

namespace accuracy {
/// Of nodes and weights, absolute.
inline constexpr double gauss_legendre = 4e-16;
}  // namespace accuracy

/// Rule for 0 … 1: exact for polynomials up to degree 2 n - 1.
struct GaussLegendre {
    std::vector<double> nodes;    ///< rising
    std::vector<double> weights;  ///< add up to 1
};

///   n   1 … 64
[[nodiscard]] GaussLegendre gauss_legendre(int n);

}  // namespace hts::validation
