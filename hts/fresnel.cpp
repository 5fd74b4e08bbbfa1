#include "hts/fresnel.hpp"

#include "hts/error.hpp"

namespace hts {

RefractiveIndex::RefractiveIndex(double n, double k) : n_{n}, k_{k} {
    if (!(n > 0 && n <= 1e24)) throw out_of_range("refractive index n", n, "", "> 0 and at most 1e+24");
    if (!(k >= 0 && k <= 1e24))
        throw out_of_range("extinction coefficient k", k, "", ">= 0 and at most 1e+24");
}

FresnelAmplitudes fresnel(double cos_theta, const RefractiveIndex& index) noexcept {
    using Complex = std::complex<double>;
    const double n = index.n();
    const double k = index.k();
    const double c = cos_theta;
    const Complex square{(n - k) * (n + k), 2 * n * k};          // N^2
    const Complex excess{(n - 1) * (n + 1) - k * k, 2 * n * k};  // N^2 - 1
    if (excess == 0.0) return {0.0, 0.0};
    if (c == 0) return {-1.0, -1.0};
    const double sine_squared = (1 - c) * (1 + c);
    // N^2 - sin^2, from whichever form does not cancel
    const Complex r = std::sqrt(std::norm(excess) < 0.25 ? excess + c * c : square - sine_squared);
    const Complex s = c + r;
    const Complex p = square * c + r;
    return {-excess / (s * s), excess * (c * c * square - sine_squared) / (p * p)};
}

}  // namespace hts
