/// Hankel functions of the first kind, orders 0 and 1, quickly: the kernels of scattering in two dimensions.
#pragma once

#include <complex>
#include <vector>

namespace hts::validation {

namespace accuracy {
inline constexpr double hankel = 1e-11;  ///< of each of the two, relative to its modulus
}

struct Hankel {
    std::complex<double> order_0, order_1;
};

/// H(z) = exp(iz)/sqrt(z) h(1/z) with h smooth, which is tabulated with its derivative; near 0 directly.
class HankelTable {
  public:
    ///   largest   z up to which it is asked [1]
    explicit HankelTable(double largest);

    ///   z   above 0, at most `largest`      error   accuracy::hankel
    [[nodiscard]] Hankel operator()(double z) const noexcept;

  private:
    struct Node {
        std::complex<double> value[2], derivative[2];  // h of orders 0 and 1, by the place in the table
    };
    std::vector<Node> nodes_;
    double first_, per_inverse_;  // 1/z of the first node; nodes per unit of 1/z
};

}  // namespace hts::validation
