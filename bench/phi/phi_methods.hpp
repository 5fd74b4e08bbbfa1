/// The rival ways to compute Phi(g, t) [He91 (78)], each as its users write it, beside this project's own:
/// one list for the chart of speed against accuracy and for the stability suite.
///
/// Nothing is repaired here: what overflows, underflows or stops too early is the subject of the comparison.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace hts::bench {

/// Where a method promises its error: every g in the range with t/g up to `most_ratio`.
struct PhiDomain {
    double least_g, most_g, most_ratio;

    [[nodiscard]] bool contains(double g, double t) const noexcept {
        return g >= least_g && g <= most_g && t <= most_ratio * g;
    }
};

/// A way to compute Phi.
struct PhiMethodEntry {
    std::string name;     ///< of the method: "series, fixed"
    std::string setting;  ///< terms, order, tolerance; "" if it has none
    std::function<double(double g, double t)> value;
    bool ours;
    PhiDomain domain;
    double error;       ///< relative, at most, inside the domain
    std::size_t bytes;  ///< of the tables it reads

    /// "series, fixed, 40 terms"
    [[nodiscard]] std::string title() const { return setting.empty() ? name : name + ", " + setting; }
};

/// Every method, rivals first.
[[nodiscard]] const std::vector<PhiMethodEntry>& phi_methods();

/// The first `terms` terms, g^m by pow and m! by tgamma, as the formula reads. tgamma overflows at m = 171,
/// pow where g^m > 1e308, and exp(-g) underflows past g = 745.
template <class Number>
[[nodiscard]] Number phi_series_fixed(Number g, Number t, int terms);

/// Terms from m = 1 by recurrence, g^m/m! exp(-g) from exp(-g), until one falls below 1e-15 of the sum.
template <class Number>
[[nodiscard]] Number phi_series_adaptive(Number g, Number t);

/// Terms from m = 1, each the exponential of its logarithm, until they fall behind the peak below 1e-17 of
/// the sum: about g + 9 sqrt(g) terms.
[[nodiscard]] double phi_series_from_one(double g, double t);

/// Terms about the largest, at m*, each the exponential of its logarithm with lgamma: about 17 sqrt(g) terms.
/// Loses digits with g, since m ln g and ln m! cancel.
template <class Number>
[[nodiscard]] Number phi_series_windowed(Number g, Number t);

/// The same window by ratios of successive terms, from a largest term that does not cancel.
[[nodiscard]] double phi_series_ratios(double g, double t);

/// How many terms the two windowed series add up.
[[nodiscard]] double windowed_terms(double g, double t);

/// The geometric-optics limit exp(-t/g)/g.
[[nodiscard]] double phi_rough_limit(double g, double t);

/// Uniform saddle point (Laplace's method about m*), with the corrections c1/m* and c2/m*^2 up to `order` 0,
/// 1, 2.
///   Phi = exp(-g psi) / (m* sqrt(a)) (1 + c1/m* + c2/m*^2 + ...), a = 1 + 2w, w = W_0(2t/g^2)/2, m* = g
///   exp(w)
template <class Number>
[[nodiscard]] Number phi_saddle(Number g, Number t, int order);

/// c1 and c2 of the saddle point.
///   derivation   Stirling's series turns the sum into the integral over y of N exp(-N h(y)) A(y), N = m*, m
///   = N (1 +
///                y), with h(y) = a y^2/2 + q3 y^3 + q4 y^4 + ..., q_j = (-1)^j (1/(j (j - 1)) + w), and
///                A = (1 + y)^(-3/2) exp(-1/(12 N (1 + y))) up to 1/N^3. Expanding all but the Gaussian, and
///                with the moments E y^2k = (2k - 1)!!/(N a)^k,
///                  c1 = [first](-3/2) - 1/12
///                  c2 = [second](-3/2) - [first](-5/2)/12 + 1/288
///                where for the amplitude (1 + y)^p = sum A_k y^k
///                  first  = A2/a - 3 (q3 A1 + q4)/a^2 + 15 q3^2/(2 a^3)
///                  second = 3 A4/a^2 - 15 (q3 A3 + q4 A2 + q5 A1 + q6)/a^3
///                           + 105/2 (q3^2 A2 + 2 q3 q4 A1 + q4^2 + 2 q3 q5)/a^4
///                           - 945/6 (q3^3 A1 + 3 q3^2 q4)/a^5 + 10395/24 q3^4/a^6
template <class Number>
struct SaddleCorrections {
    Number first, second;
};
template <class Number>
[[nodiscard]] SaddleCorrections<Number> saddle_corrections(Number w);

}  // namespace hts::bench
