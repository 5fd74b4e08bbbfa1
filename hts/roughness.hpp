/// Effective roughness of the lit and seen part of a surface, and the phase variance it causes.
#pragma once

#include "hts/wavelength.hpp"

namespace hts {

namespace accuracy {
inline constexpr double effective_roughness = 6e-16;  ///< of `effective_roughness_ratio`, relative
}

/// Fraction of the rms roughness that stays visible, sigma / sigma_0.
///   formula       1 / sqrt(1 + W_0(K^2 / 8 pi)): closed form of [He91 (80), (81)], no iteration.
///                 Derivation: (81) reads z_0 sqrt(pi/2) = (sigma_0/4) K exp(-z_0^2 / 2 sigma_0^2) and (80)
///                 sigma^2 = sigma_0^2/(1 + y), y = z_0^2/sigma_0^2; so y exp(y) = K^2 / 8 pi
///   obstruction   K of the incident plus K of the outgoing direction   [1]   0 ... infinity; NaN below 0
///   range         [0, 1], falling; 1 at K = 0, 0 at infinity
///   error         accuracy::effective_roughness
[[nodiscard]] double effective_roughness_ratio(double obstruction) noexcept;

/// Its derivative d ln(sigma/sigma_0) / d ln K.
///   formula   -y^2 (1 - y^2) with y = sigma/sigma_0: from W_0'(x) = W_0/(x (1 + W_0)) and 1 + W_0 = 1/y^2
///   ratio     y, of `effective_roughness_ratio` [1]   0 ... 1
///   range     [-1/4, 0]; 0 at both ends      error   absolute, at most accuracy::effective_roughness
[[nodiscard]] double effective_roughness_log_slope(double ratio) noexcept;

/// Variance of the phase that heights add, g.
///   formula               (2 pi sigma / lambda (cos theta_i + cos theta_r))^2 [He91 (79)]
///   effective_roughness   sigma [um]
///   vertical              cos theta_i + cos theta_r [1], `WaveVectorChange::vertical`
[[nodiscard]] double phase_variance(double effective_roughness, double vertical,
                                    const Wavelength& wavelength) noexcept;

}  // namespace hts
