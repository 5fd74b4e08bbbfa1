/// The yardstick for speed: a rough conductor as renderers have it, GGX normals [Walter07 (33)] with the
/// height-correlated shadowing of Smith and the reflectance of a complex refractive index for unpolarised
/// light, at several wavelengths.
///
///   f = F(theta_d) D(theta_h) V(in, out) [1/sr],   V = G_2/(4 cos theta_i cos theta_r)
///
/// What the directions need is computed once per pair; F per wavelength, from one array of each optical
/// constant. The formulas are templates over the number, which may be a vector of lanes with + - * / and
/// `sqrt`.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::bench {

/// GGX distribution of normals, alpha^2/(pi ((alpha^2 - 1) cos^2 + 1)^2) [Walter07 (33)], with the
/// denominator's bracket as alpha^2 cos^2 + sin^2, which does not cancel [1/sr].
template <class Number>
[[nodiscard]] Number ggx_distribution(Number cos_squared, Number sin_squared, Number alpha_squared) {
    const Number bracket = alpha_squared * cos_squared + sin_squared;
    return alpha_squared / (Number(std::numbers::pi) * bracket * bracket);
}

/// Height-correlated shadowing over 4 cos theta_i cos theta_r,
/// 1/(2 (cos_r sqrt(alpha^2 sin_i^2 + cos_i^2) + cos_i sqrt(alpha^2 sin_r^2 + cos_r^2))).
template <class Number>
[[nodiscard]] Number ggx_visibility(Number cos_in, Number cos_out, Number alpha_squared) {
    using std::sqrt;
    const auto reach = [alpha_squared](Number c) {
        return sqrt(alpha_squared + (Number(1) - alpha_squared) * c * c);
    };
    return Number(0.5) / (cos_out * reach(cos_in) + cos_in * reach(cos_out));
}

/// (|F_s|^2 + |F_p|^2)/2 of index n + ik in real arithmetic: with A + iB = sqrt(N^2 - sin^2),
/// |F_s|^2 = (M + c^2 - 2Ac)/(M + c^2 + 2Ac), |F_p|^2 = |F_s|^2 (M c^2 + s^4 - 2Ac s^2)/(M c^2 + s^4 + 2Ac
/// s^2), M = A^2 + B^2. Both quotients share one division.
template <class Number>
[[nodiscard]] Number conductor_reflectance(Number cosine, Number n, Number k) {
    using std::sqrt;
    const Number c2 = cosine * cosine;
    const Number s2 = Number(1) - c2;
    const Number real = n * n - k * k - s2;
    const Number twice_nk = Number(2) * n * k;
    const Number modulus = sqrt(real * real + twice_nk * twice_nk);
    const Number twice_ac =
        cosine * sqrt(Number(2) * (modulus + real));  // modulus >= |real| also when rounded
    const Number s_sum = modulus + c2;
    const Number p_sum = modulus * c2 + s2 * s2;
    const Number p_cross = twice_ac * s2;
    const Number s_below = s_sum + twice_ac;
    const Number p_below = p_sum + p_cross;
    // (s- / s+) (1 + p- / p+)/2 with p- + p+ = 2 p_sum
    return (s_sum - twice_ac) * p_sum / (s_below * p_below);
}

/// What a pair of directions contributes, whatever the wavelength.
struct GgxPair {
    double cos_theta_d;
    double lobe;  ///< D V [1/sr]
};

/// A rough conductor at the wavelengths of its optical constants.
class RoughConductor {
  public:
    ///   alpha   width of the slopes, > 0, else hts::Error    n, k   one value per wavelength, equally many,
    ///   else hts::Error
    RoughConductor(double alpha, std::vector<double> n, std::vector<double> k);

    [[nodiscard]] std::size_t size() const noexcept { return n_.size(); }

    /// Geometry of a pair; a lobe of 0 where a direction grazes.
    [[nodiscard]] GgxPair pair(const Direction& in, const Direction& out) const noexcept;

    /// BRDF of a pair [1/sr], one value per wavelength, into `result` of size() values.
    void brdf(const spectral::DirectionPair& directions, std::span<double> result) const noexcept;
    /// The same for many pairs, all wavelengths of a pair together, into pairs.size() * size() values.
    void brdf(std::span<const spectral::DirectionPair> pairs, std::span<double> result) const noexcept;

  private:
    double alpha_squared_;
    std::vector<double> n_, k_;
};

}  // namespace hts::bench
