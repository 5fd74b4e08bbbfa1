#include "hts/fresnel.hpp"

#include "hts/error.hpp"

namespace hts {
namespace {

using Complex = std::complex<double>;

/// What both amplitudes are made of.
struct Interface {
    double c, sine_squared;
    Complex square;  // N^2
    Complex excess;  // N^2 - 1
    Complex r;       // sqrt(N^2 - sin^2), from whichever form does not cancel
    Complex s, p;    // denominators

    Interface(double cos_theta, double n, double k)
        : c{cos_theta},
          sine_squared{(1 - c) * (1 + c)},
          square{(n - k) * (n + k), 2 * n * k},
          excess{(n - 1) * (n + 1) - k * k, 2 * n * k},
          r{std::sqrt(std::norm(excess) < 0.25 ? excess + c * c : square - sine_squared)},
          s{c + r},
          p{square * c + r} {}

    [[nodiscard]] FresnelAmplitudes amplitudes() const {
        return {-excess / (s * s), excess * (c * c * square - sine_squared) / (p * p)};
    }
};

}  // namespace

RefractiveIndex::RefractiveIndex(double n, double k) : n_{n}, k_{k} {
    if (!(n > 0 && n <= 1e24)) throw out_of_range("refractive index n", n, "", "> 0 and at most 1e+24");
    if (!(k >= 0 && k <= 1e24))
        throw out_of_range("extinction coefficient k", k, "", ">= 0 and at most 1e+24");
}

FresnelAmplitudes fresnel(double cos_theta, const RefractiveIndex& index) noexcept {
    const Interface i{cos_theta, index.n(), index.k()};
    if (i.excess == 0.0) return {0.0, 0.0};
    if (cos_theta == 0) return {-1.0, -1.0};
    return i.amplitudes();
}

FresnelGradient fresnel_gradient(double cos_theta, const RefractiveIndex& index) noexcept {
    const Interface i{cos_theta, index.n(), index.k()};
    const FresnelAmplitudes value = fresnel(cos_theta, index);
    const Complex sum = 2.0 * value.s / (i.r * cos_theta + i.sine_squared);
    constexpr double nothing = 1e-290;  // N = 1 and c = 0, where neither derivative by n is finite
    if (i.r == 0.0 || std::norm(i.s) < nothing) return {value, {0.0, 0.0}, {0.0, 0.0}, sum};
    const Complex n{index.n(), index.k()};
    const Complex r = 1.0 / i.r, s = 1.0 / i.s, p = 1.0 / i.p;
    const Complex by_cosine = 2.0 * i.excess * r;
    const Complex by_n = 2 * cos_theta * r;
    return {value,
            {by_cosine * s * s, (i.square * p) * by_cosine * p},
            {-(n * s) * by_n * s, (n * p) * ((i.square - 2 * i.sine_squared) * p) * by_n},
            sum};
}

}  // namespace hts
