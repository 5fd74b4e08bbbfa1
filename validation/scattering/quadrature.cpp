#include "validation/scattering/quadrature.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace hts::validation {
namespace {

/// P_n and its derivative at x.
struct Legendre {
    double value, slope;
};

Legendre legendre(int n, double x) {
    double before = 1, now = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
    }
    return {now, n * (x * now - before) / (x * x - 1)};
}

}  // namespace

GaussLegendre gauss_legendre(int n) {
    GaussLegendre rule;
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        for (int step = 0; step < 6; ++step) {
            const Legendre p = legendre(n, x);
            x -= p.value / p.slope;
        }
        const double slope = legendre(n, x).slope;
        rule.nodes.push_back((1 + x) / 2);
        rule.weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace hts::validation
