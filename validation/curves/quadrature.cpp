#include "validation/curves/quadrature.hpp"

#include <algorithm>
#include <boost/math/special_functions/legendre.hpp>

namespace hts::validation {

GaussLegendre gauss_legendre(int n) {
    GaussLegendre rule;
    const auto add = [&](long double x) {
        const long double slope = boost::math::legendre_p_prime(n, x);
        rule.nodes.push_back(static_cast<double>((1 + x) / 2));
        rule.weights.push_back(static_cast<double>(1 / ((1 - x * x) * slope * slope)));
    };
    const auto roots = boost::math::legendre_p_zeros<long double>(n);  // those from 0 on, rising
    std::for_each(roots.rbegin(), roots.rend(), [&](long double root) {
        if (root > 0) add(-root);
    });
    for (const long double root : roots) add(root);
    return rule;
}

}  // namespace hts::validation
