/// The parameters by which optical designers exchange scatter, of any BRDF: ABg, Harvey-Shack and
/// K-correlation, each with what it leaves.
///
///   x = |beta - beta_0|, beta = sin theta in the plane of incidence, beta_0 of the mirror direction
///   ABg             f = A/(B + x^g)
///   Harvey-Shack    f = b0 (1 + (x/l)^2)^(s/2)
///   K-correlation   f = 16 pi^2 cos theta_i cos theta_r Q S2(x/lambda)/lambda^4, the law of smooth
///                   surfaces, S2 = A/(1 + (B f)^2)^(s/2) over the frequency f: Zemax' and FRED's, whose s is
///                   the slope of the two-dimensional spectrum and whose rms roughness holds for frequencies
///                   0 ... 1/lambda
///
/// Each is fitted to ln f at 120 views in the plane of incidence, on both sides of the mirror direction, x
/// from
/// 0.001 on by equal factors, up to theta_r = 85 deg; K-correlation where cos theta_r is at least half of
/// cos theta_i, since its law has no index and fails at grazing angles. The specular term is left out.
#pragma once

#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::validation {

/// A number of a model; unit "1" where it has none.
struct ScatterParameter {
    std::string name, unit;
    double value;
};

struct ScatterFit {
    std::string model;  ///< "abg", "harvey_shack", "k_correlation"
    std::vector<ScatterParameter> parameters;
    std::size_t points;
    double median_abs_log, rms_log;  ///< of ln(model/f)
    double worst_log;                ///< largest magnitude

    /// hts::Error if there is none of the name.
    [[nodiscard]] double value(const std::string& parameter) const;
};

/// All three.
///   wavelength    place in the reflectance's wavelengths
///   reflectance   Q; 0: what the reflectance reflects in all of the light from theta_i
/// hts::Error where fewer than 8 views see anything.
[[nodiscard]] std::vector<ScatterFit> scatter_fits(const spectral::Reflectance& brdf, std::size_t wavelength,
                                                   const Direction& in, double reflectance = 0);

}  // namespace hts::validation
