/// Exact scattering in two dimensions: fields on the surface of a perfect conductor or of a ground that light
/// enters, from the integral equations by the method of moments.
///
/// Time factor exp(-i omega t). The scatterer is a cylinder along y whose cross-section is a curve in the (x,
/// z) plane; psi is the field component along y, u = d psi/dn, G = (i/4) H_0(k |r - r'|) [Tsang00, chapter
/// 4], S u = integral G u dl', K psi = PV integral psi dG/dn' dl'.
///   TE, E along y   perfect conductor: psi = 0, electric-field equation S u = psi_in
///   TM, H along y   perfect conductor: u = 0, magnetic-field equation psi/2 - K psi = psi_in
///   ground          psi/2 - K psi + S u = psi_in above, psi/2 + K' psi - rho S' u = 0 below, with K' and S'
///                   of the wave number n k in the ground; rho = 1 in TE and n^2 in TM. The second gives
///                   u = (1/rho) A psi, with the
///                   same A for both
///
/// The trapezoidal rule in the curve's parameter is corrected for the logarithm of the kernels at the
/// singular node and two to each side ([Navot62], with zeta'(0), zeta'(-2) and zeta'(-4)), so that the error
/// falls with the seventh power of the step on smooth curves. An open curve must lie dark at its ends.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace hts::validation {

/// A curve at even steps of its parameter, with its derivatives; the field is to the left of it.
struct Contour {
    double step;  ///< of the parameter
    std::vector<double> x, z, dx, dz, ddx, ddz;
    bool closed = false;

    [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
};

/// A quantity at the nodes.
using SurfaceField = std::vector<std::complex<double>>;

/// psi and u |dr/dt| of one polarisation, a column per incident field.
struct SurfaceFields {
    std::vector<SurfaceField> psi, u;
};
struct PolarisedFields {
    SurfaceFields te, tm;
};

/// Fields on a perfect conductor.
///   incident   psi_in at the nodes, a column per incident field
///   wave_number   k, 2 pi/lambda, per unit of length
///   cost       two complex LU decompositions, 0.2 s for 500 nodes on one core
[[nodiscard]] PolarisedFields surface_fields(const Contour& contour, double wave_number,
                                             std::span<const SurfaceField> incident);
/// Fields on a ground of refractive index n; the step must resolve the wavelength in the ground or, if that
/// is less, the depth to which light enters, with 8 nodes or more to 2 pi/|n k|.
///   cost   four times as much
[[nodiscard]] PolarisedFields surface_fields(const Contour& contour, double wave_number,
                                             std::span<const SurfaceField> incident,
                                             std::complex<double> index);

/// Amplitude N(theta) of the far field that surface fields radiate, integral psi dG/dn' - G u, in each
/// direction (sin theta, cos theta): |psi_s|^2 r = |N|^2/(8 pi k), N = integral (u + i psi n k_s) exp(-i k_s
/// r) dl.
class FarField {
  public:
    FarField(const Contour& contour, double wave_number, std::span<const double> angles);

    /// A column per incident field.
    [[nodiscard]] std::vector<SurfaceField> amplitudes(const SurfaceFields& fields) const;

  private:
    std::size_t nodes_, directions_;
    std::vector<std::complex<double>> of_psi_, of_u_;  // nodes x directions, column by column
};

}  // namespace hts::validation
