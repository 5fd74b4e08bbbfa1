/// The directional-diffuse term before shadowing (sigma = sigma_0, S = 1), against the diffraction integral
/// that it stands for, summed over explicit surfaces and averaged.
///
/// A perfectly reflecting surface is periodic with period L along x and y; light falls in along k_i and is
/// seen along k_r, both with horizontal parts that are multiples of 2 pi/L, so that the integral over a
/// period has no edges and needs no window. Kirchhoff's integral with the surface's own slopes p and q,
///
///   N = 2 integral (-k_ix p - k_iy q + k_iz) exp(-i v r) dx dy
///   BRDF = |N|^2/(16 pi^2 L^2 cos theta_i cos theta_r),
///
/// knows neither Phi nor G [He91 (76)-(78)]. v_xy = 0, where the specular term is, is left out. Lengths are
/// in wavelengths.
#pragma once

#include <cstdint>
#include <vector>

#include "hts/direction.hpp"
#include "validation/scattering/gaussian_surface.hpp"
#include "validation/scattering/ground_truth.hpp"

namespace hts::validation {

/// A surface and light on it, by what the model depends on.
struct FourierCase {
    double phase_variance;      ///< g of sigma_0 in the mirror direction
    double correlation_length;  ///< tau, in wavelengths
    double theta_i_deg;         ///< nearly: the nearest the period allows
};

struct FourierSettings {
    int realisations = 600;
    int directions =
        40;  ///< drawn among those of the period with at least a thousandth of the brightest BRDF
    std::uint64_t study = 1992;
};

/// BRDF in one direction.
struct FourierPoint {
    Direction in, out;
    double computed;        ///< mean over realisations [1/sr]
    double standard_error;  ///< of that mean
    double closed_form;     ///< the directional-diffuse term with sigma = sigma_0, S = 1 and |F| = 1

    /// Difference in standard errors.
    [[nodiscard]] double deviation() const noexcept { return (computed - closed_form) / standard_error; }
};

struct FourierResult {
    FourierCase of;
    RoughnessStatistics surface;  ///< in wavelengths
    std::vector<FourierPoint> points;
};

/// The same bits for any number of threads.
///   cost   1 ms per realisation and direction at most, a surface of 180 x 180 samples
[[nodiscard]] FourierResult fourier_result(const FourierCase& of, const FourierSettings& settings);

[[nodiscard]] GroundTruth fourier_study(Effort effort);
[[nodiscard]] Section fourier_section(Effort effort);

}  // namespace hts::validation
