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

/// J_0 and J_1 by their power series.
///   z   modulus at most 4
struct Bessel {
    std::complex<double> order_0, order_1;
};
[[nodiscard]] Bessel bessel(std::complex<double> z) noexcept;

/// H(kr) at distances r = 0 … largest. H(z) = exp(iz)/sqrt(z) h(1/z) with h smooth, which is tabulated with
/// its derivative from |z| = 1.5 on; nearer, the power series.
class HankelTable {
  public:
    ///   largest   distance up to which it is asked      wave_number   k, not 0, in the quadrant Re, Im >= 0
    explicit HankelTable(double largest, std::complex<double> wave_number = 1);

    ///   distance   above 0, at most `largest`      error   accuracy::hankel
    [[nodiscard]] Hankel operator()(double distance) const noexcept;

  private:
    struct Node {
        std::complex<double> value[2], derivative[2];  // h of orders 0 and 1, by the place in the table
    };
    std::vector<Node> nodes_;
    std::complex<double> wave_number_, inverse_root_;  // k^(-1/2)
    double first_, per_inverse_;                       // 1/distance of the first node; nodes per unit of it
};

}  // namespace hts::validation
