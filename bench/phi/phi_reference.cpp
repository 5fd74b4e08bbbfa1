#include "bench/phi/phi_reference.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/bernoulli.hpp>
#include <boost/math/tools/rational.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace hts::bench {
namespace {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// Terms below this share of the sum are dropped.
const Real negligible{"1e-40"};

/// w exp(2w) = u, u >= 0, by Newton's method on w + ln(w)/2, which is concave.
Real half_lambert(const Real& u) {
    if (u == 0) return 0;
    const Real log_u = log(u);
    Real w = u < 1 ? Real{u / (1 + 2 * u)} : Real{(1 + log_u) / 2};
    for (int step = 0; step < 100; ++step) {
        const Real change = w * (log_u - log(w) - 2 * w) / (1 + 2 * w);
        w += change;
        if (abs(change) < w * Real{"1e-45"}) break;
    }
    return w;
}

/// ln(m!) - (m + 1/2) ln m + m - ln(2 pi)/2, for m >= 100: error below 1e-45.
Real stirling_remainder(const Real& m) {
    static const std::vector<Real> coefficients = [] {
        std::vector<Real> c;
        for (int j = 1; j <= 16; ++j)
            c.push_back(boost::math::bernoulli_b2n<Real>(j) / (2 * j * (2 * j - 1)));
        return c;
    }();
    const Real inverse = 1 / m;
    const Real square = inverse * inverse;
    return boost::math::tools::evaluate_polynomial(coefficients.data(), square, coefficients.size()) *
           inverse;
}

/// ln m! for any m, remembered.
Real log_factorial(std::size_t m) {
    thread_local std::vector<Real> known{0, 0};
    while (known.size() <= m) known.push_back(known.back() + log(Real{known.size()}));
    return known[m];
}

/// Every term outwards from m = centre, relative to the largest Poisson weight, by recurrence.
Real every_term(const Real& g, const Real& t, std::size_t centre) {
    Real poisson = exp(Real{centre} * log(g) - g - log_factorial(centre));
    const Real start = poisson;
    Real sum = 0;
    for (std::size_t m = centre;; ++m, poisson *= g / Real{m}) {
        const Real term = poisson * exp(-t / Real{m}) / Real{m};
        sum += term;
        if (term < sum * negligible && m > centre + 8) break;
    }
    poisson = start;
    for (std::size_t m = centre; m > 1; --m) {
        poisson *= Real{m} / g;
        const Real term = poisson * exp(-t / Real{m - 1}) / Real{m - 1};
        sum += term;
        if (term < sum * negligible) break;
    }
    return sum;
}

/// The trapezoidal rule about m* = g exp(w), of standard deviation `width`: its error and that of taking the
/// sum for an integral are both exp(-2 pi^2 (width/step)^2), below 1e-30 from width/step = 2.
Real trapezoid(const Real& g, const Real& w, const Real& m_star, const Real& width) {
    const Real step = width / 2;
    Real sum = 0;
    for (const int side : {1, -1}) {
        for (int j = side > 0 ? 0 : 1;; ++j) {
            const Real y = side * j * step / m_star;
            if (y <= -1) break;
            const Real m = m_star * (1 + y);
            // ln of the summand less its largest value: -m* ((1 + y) ln(1 + y) - y + w y^2/(1 + y))
            const Real fall = m_star * ((1 + y) * log1p(y) - y + w * y * y / (1 + y));
            const Real term = exp(-fall - stirling_remainder(m)) / (m * sqrt(m));
            sum += term;
            if (term < sum * negligible && j > 8) break;
        }
    }
    const Real exponent = g * (exp(w) * (1 - 2 * w) - 1);
    return sum * step * exp(exponent) / sqrt(boost::math::constants::two_pi<Real>());
}

}  // namespace

PhiReference phi_reference(double g_given, double t_given) {
    const Real g = g_given;
    const Real t = t_given;
    const Real w = half_lambert(t / (g * g));
    const Real m_star = g * exp(w);
    const Real width = sqrt(m_star / (1 + 2 * w));
    const bool many = m_star > 400 && width > 12;
    const Real phi = many ? trapezoid(g, w, m_star, width)
                          : every_term(g, t, std::max<std::size_t>(1, m_star.convert_to<std::size_t>()));
    if (phi < least_phi) return {0, 0};
    const auto value = phi.convert_to<double>();
    return {value, Real{phi - value}.convert_to<double>()};
}

}  // namespace hts::bench
