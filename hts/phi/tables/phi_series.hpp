// Phi and its companions by their series in any real type: what the tables are fitted to and tested against.
#pragma once

#include <cmath>
#include <limits>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace hts::phi_detail {

/// e^(-g) sum_{m >= 1} g^m / m! m^(-k) e^(-t/m) = e^log_scale times psi, phi, chi for k = 0, 1, 2.
template <class Real>
struct SeriesSums {
    Real log_scale, psi, phi, chi;

    void add(Real term, Real m) {  // of psi
        psi += term;
        phi += term / m;
        chi += term / (m * m);
    }
    [[nodiscard]] Real log_phi() const {
        using std::log;
        return log_scale + log(phi);
    }
};

/// w with w e^(2w) = u >= 0, by Halley's steps.
template <class Real>
Real half_lambert(Real u) {
    using std::abs, std::exp, std::log;
    if (u == 0) return Real(0);
    Real w = u < Real(0.3) ? Real(u / (1 + 2 * u)) : Real(log(1 + 2 * u) * Real(0.45));
    if (u >= 3) w = (log(2 * u) - log(log(2 * u))) / 2;
    for (int i = 0; i < 60; ++i) {
        const Real e = exp(-2 * w);
        const Real f = w - u * e;
        const Real slope = 1 + 2 * u * e;
        const Real step = f / (slope + 2 * u * e * f / slope);
        w -= step;
        if (abs(step) <= abs(w) * std::numeric_limits<Real>::epsilon() * 4) break;
    }
    return w;
}

/// e^w (1 - 2w) - 1: the exponent at the saddle point, over g.
template <class Real>
Real saddle_exponent(Real w) {
    using std::exp;
    if (w >= Real(0.05)) return exp(w) * (1 - 2 * w) - 1;
    Real sum = 0;
    for (int k = 40; k >= 1; --k) sum = (1 - 2 * k + sum) * w / k;
    return sum;
}

/// ln m! - (m ln m - m + ln(2 pi m)/2), for m > 150.
template <class Real>
Real stirling_tail(Real m) {
    constexpr int terms = 13;
    constexpr double numerators[terms] = {1,     -1,    1,       -1,    1,          -691,  1,
                                          -3617, 43867, -174611, 77683, -236364091, 657931};
    constexpr double denominators[terms] = {12,     360,    1260,   1680, 1188,    360360, 156,
                                            122400, 244188, 125400, 5796, 1506960, 300};
    const Real inverse = 1 / m;
    Real sum = 0;
    for (int k = terms - 1; k >= 0; --k)
        sum = sum * inverse * inverse + Real(numerators[k]) / Real(denominators[k]);
    return sum * inverse;
}

/// Term by term from the peak outwards.
template <class Real>
SeriesSums<Real> direct_sums(Real g, Real t, Real peak) {
    using std::exp, std::floor, std::log;
    const Real epsilon = std::numeric_limits<Real>::epsilon() / 64;
    const Real centre = peak < 1 ? Real(1) : Real(floor(peak));
    SeriesSums<Real> sums{centre * log(g) - boost::math::lgamma(Real(centre + 1)) - t / centre - g, 0, 0, 0};
    sums.add(1, centre);
    Real weight = 1;
    for (Real m = centre + 1;; m += 1) {
        weight *= g / m;
        const Real term = weight * exp(t / centre - t / m);
        sums.add(term, m);
        if (term <= sums.psi * epsilon) break;
    }
    weight = 1;
    for (Real m = centre - 1; m >= 1; m -= 1) {
        weight *= (m + 1) / g;
        const Real term = weight * exp(t / centre - t / m);
        sums.add(term, m);
        if (term <= m * m * sums.chi * epsilon) break;
    }
    return sums;
}

/// (1 + y) ln(1 + y) - y
template <class Real>
Real entropy(Real y) {
    using std::abs, std::log1p;
    if (abs(y) > Real(0.02)) return (1 + y) * log1p(y) - y;
    Real sum = 0;
    for (int k = 40; k >= 2; --k) sum = 1 / (Real(k) * (k - 1)) - y * sum;
    return y * y * sum;
}

/// The trapezoidal rule in m about the peak, of width s: by Poisson's sum formula the sum itself, to e^(-2
/// (pi s)^2) and e^(-2 (pi s/stride)^2).
template <class Real>
SeriesSums<Real> trapezoidal_sums(Real g, Real peak, Real w) {
    using std::exp, std::sqrt;
    constexpr int digits = std::numeric_limits<Real>::digits;
    const Real stride = sqrt(peak / (1 + 2 * w)) / (digits > 80 ? Real(3.2) : Real(1.9));
    const Real negligible = Real(digits) * Real(0.6931) + 12;
    SeriesSums<Real> sums{g * saddle_exponent(w), 0, 0, 0};
    const auto add = [&](int j) {
        const Real y = j * stride / peak;
        const Real below_peak = y > -1 ? Real(peak * (entropy(y) + w * y * y / (1 + y))) : negligible;
        if (below_peak >= negligible) return false;
        const Real m = peak * (1 + y);
        sums.add(
            stride * exp(-below_peak - stirling_tail(m)) / sqrt(boost::math::constants::two_pi<Real>() * m),
            m);
        return true;
    };
    for (int j = 0; add(j); ++j) continue;
    for (int j = -1; add(j); --j) continue;
    return sums;
}

/// domain   0 < g, 0 <= t, both finite, t/g^2 finite      error   a few epsilons, times |ln Phi|
template <class Real>
SeriesSums<Real> series_sums(Real g, Real t) {
    using std::exp, std::sqrt;
    const Real w = half_lambert(Real(t / (g * g)));
    const Real peak = g * exp(w);
    if (peak < 200 || peak < 64 * (1 + 2 * w)) return direct_sums(g, t, peak);
    return trapezoidal_sums(g, peak, w);
}

}  // namespace hts::phi_detail
