/// Exact scattering in two dimensions: fields on the surface of a perfect conductor, from the integral equations
/// by the method of moments.
///
/// Time factor exp(-i omega t). The conductor is a cylinder along y whose cross-section is a curve in the (x, z)
/// plane; psi is the field component along y, G = (i/4) H_0(k |r - r'|) [Tsang00, chapter 4].
///   TE, E along y   psi = 0 on the curve. Electric-field equation for u = d psi/dn:
///                   integral G(r, r') u(r') dl' = psi_in(r)
///   TM, H along y   d psi/dn = 0. Magnetic-field equation for psi:
///                   psi(r)/2 - PV integral psi(r') dG/dn'(r, r') dl' = psi_in(r)
///
/// The trapezoidal rule in the curve's parameter is corrected for the logarithm of the kernels at the singular node
/// and two to each side ([Navot62], with zeta'(0), zeta'(-2) and zeta'(-4)), so that the error falls with the
/// seventh power of the step on smooth curves. An open curve must lie dark at its ends.
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

using SurfaceField = std::vector<std::complex<double>>;

/// Surface fields of one polarisation, a column per incident field: u |dr/dt| for TE and psi for TM, at the nodes.
struct SurfaceFields {
    std::vector<SurfaceField> te, tm;
};

/// Solves both equations.
///   incident   psi_in at the nodes, a column per incident field      wave_number   2 pi/lambda, per unit of length
///   cost       two complex LU decompositions, 0.2 s for 500 nodes on one core
[[nodiscard]] SurfaceFields surface_fields(const Contour& contour, double wave_number,
                                           std::span<const SurfaceField> incident);

/// Amplitude N(theta) of the scattered far field, |psi_s|^2 r = |N|^2/(8 pi k), in each direction
/// (sin theta, cos theta): TE integral u exp(-i k_s r) dl, TM -i integral psi (n k_s) exp(-i k_s r) dl.
/// Rows are directions, then fields.
class FarField {
  public:
    FarField(const Contour& contour, double wave_number, std::span<const double> angles);

    [[nodiscard]] std::vector<SurfaceField> te(const std::vector<SurfaceField>& u) const;
    [[nodiscard]] std::vector<SurfaceField> tm(const std::vector<SurfaceField>& psi) const;

  private:
    std::size_t nodes_, directions_;
    std::vector<std::complex<double>> te_, tm_;  // nodes x directions, column by column
};

}  // namespace hts::validation
