#include "validation/scattering/vector/lattice_sums.hpp"

#include <cmath>
#include <numbers>

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;
const double root_pi = std::sqrt(pi);
constexpr int reach = 6;  // of both sums: what is beyond is below 1e-12

/// Incomplete gamma functions.
double gamma_1_2(double x) {
    return root_pi * std::erfc(std::sqrt(x));
}
double gamma_3_2(double x) {
    return gamma_1_2(x) / 2 + std::sqrt(x) * std::exp(-x);
}

}  // namespace

LatticeSums lattice_sums(double slope_x, double slope_y) noexcept {
    const double xx = 1 + slope_x * slope_x, xy = slope_x * slope_y, yy = 1 + slope_y * slope_y;
    const double det = xx * yy - xy * xy, root = std::sqrt(det);
    const double ixx = yy / det, ixy = -xy / det, iyy = xx / det;  // the inverse of Q
    const double T = pi / root;
    // of the reciprocal lattice's origin, continued
    const double origin = -pi / (root * std::sqrt(T));
    LatticeSums sums{origin * ixx, origin * ixy, origin * iyy};
    for (int m = 0; m <= reach; ++m) {
        for (int n = m == 0 ? 1 : -reach; n <= reach; ++n) {  // half of them; -(m, n) adds the same
            const double q = xx * m * m + 2 * xy * m * n + yy * n * n;
            const double near = 2 * gamma_3_2(T * q) / (q * std::sqrt(q));
            const double px = ixx * m + ixy * n, py = ixy * m + iyy * n;
            const double c = pi * pi * (m * px + n * py), root_c = std::sqrt(c);
            const double even = 2 * pi / (2 * root) * gamma_1_2(c / T) / root_c,
                         odd = 2 * pi * pi * pi / root * gamma_3_2(c / T) / (c * root_c);
            sums.xx += near * m * m + even * ixx - odd * px * px;
            sums.xy += near * m * n + even * ixy - odd * px * py;
            sums.yy += near * n * n + even * iyy - odd * py * py;
        }
    }
    const double gamma = root_pi / 2;  // Gamma(3/2)
    return {sums.xx / gamma, sums.xy / gamma, sums.yy / gamma};
}

}  // namespace hts::validation
