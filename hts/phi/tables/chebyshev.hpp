// Interpolation in Chebyshev's nodes, its result in powers.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <boost/math/constants/constants.hpp>

namespace hts::phi_detail {

/// cos(pi (2i + 1) / 2n), i = 0 ... n - 1
template <class Real>
std::vector<Real> chebyshev_nodes(int n) {
    using std::cos;
    std::vector<Real> nodes;
    for (int i = 0; i < n; ++i)
        nodes.push_back(cos(boost::math::constants::pi<Real>() * (2 * i + 1) / (2 * n)));
    return nodes;
}

/// Coefficients of T_0, T_1 ... from the values at the nodes.
template <class Real>
std::vector<Real> chebyshev_coefficients(const std::vector<Real>& values) {
    using std::cos;
    const int n = static_cast<int>(values.size());
    std::vector<Real> coefficients;
    for (int k = 0; k < n; ++k) {
        Real sum = 0;
        for (int i = 0; i < n; ++i)
            sum += values[static_cast<std::size_t>(i)] *
                   cos(boost::math::constants::pi<Real>() * k * (2 * i + 1) / (2 * n));
        coefficients.push_back(sum * (k == 0 ? 1 : 2) / n);
    }
    return coefficients;
}

/// The polynomial through the values at the nodes, by powers of x = node / 2 in [-1/2, 1/2].
template <class Real>
std::vector<Real> interpolant(const std::vector<Real>& values) {
    const std::vector<Real> coefficients = chebyshev_coefficients(values);
    const std::size_t n = values.size();
    std::vector<Real> before(n, Real(0)), now(n, Real(0)), sum(n, Real(0));  // T_{k-1}(2x), T_k(2x)
    now[0] = 1;
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) sum[i] += coefficients[k] * now[i];
        std::vector<Real> next(n, Real(0));
        for (std::size_t i = 0; i + 1 < n; ++i) next[i + 1] = now[i] * (k == 0 ? 2 : 4);
        for (std::size_t i = 0; i < n; ++i) next[i] -= before[i];
        before = now;
        now = next;
    }
    return sum;
}

}  // namespace hts::phi_detail
