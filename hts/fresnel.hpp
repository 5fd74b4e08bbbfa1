/// Fresnel amplitudes of a plane interface between vacuum and a medium of complex refractive index.
///
/// Conventions: index n + ik with k >= 0 for the time factor exp(-i omega t); s is perpendicular and p
/// parallel to the plane of incidence. F_p has the sign for which F_s = -F_p at normal incidence.
#pragma once

#include <complex>

namespace hts {

namespace accuracy {
inline constexpr double fresnel = 2e-15;  ///< of either amplitude, absolute, away from the critical angle
inline constexpr double fresnel_gradient = 2e-15;  ///< of `fresnel_gradient`, see there
}  // namespace accuracy

/// Complex refractive index relative to the medium of incidence.
class RefractiveIndex {
  public:
    ///   n   > 0, at most 1e24     k   0 ... 1e24, else hts::Error
    RefractiveIndex(double n, double k);

    [[nodiscard]] double n() const noexcept { return n_; }
    [[nodiscard]] double k() const noexcept { return k_; }

  private:
    double n_, k_;
};

/// Reflected over incident field for the two polarisations.
struct FresnelAmplitudes {
    std::complex<double> s, p;

    /// (|F_s|^2 + |F_p|^2) / 2, what unpolarised light keeps [He91 (75)].
    [[nodiscard]] double unpolarised_reflectance() const noexcept {
        return (std::norm(s) + std::norm(p)) / 2;
    }
};

/// Fresnel amplitudes at a local angle of incidence [He91 (44)].
///   formula     F_s = (c - r)/(c + r), F_p = (N^2 c - r)/(N^2 c + r), r = sqrt(N^2 - 1 + c^2), N = n + ik,
///               written as -d/(c + r)^2 and d (c^2 N^2 - sin^2)/(N^2 c + r)^2 with d = N^2 - 1, which does
///               not cancel as N -> 1
///   cos_theta   c, cosine of the angle of incidence   [1]   0 ... 1
///   limits      N = 1: both 0; c = 0: both -1
///   error       accuracy::fresnel / min(1, |r|): at the critical angle of total reflection, r = 0, the last
///               bit of n or c moves the amplitudes by its square root
[[nodiscard]] FresnelAmplitudes fresnel(double cos_theta, const RefractiveIndex& index) noexcept;

/// Amplitudes with their derivatives.
struct FresnelGradient {
    FresnelAmplitudes value;
    FresnelAmplitudes by_cos_theta;
    FresnelAmplitudes by_n;
    /// (F_s + F_p)/sin^2 theta, without its 0/0 at normal incidence.
    std::complex<double> sum_over_sine_squared;

    [[nodiscard]] FresnelAmplitudes by_k() const noexcept {
        const std::complex<double> i{0, 1};
        return {i * by_n.s, i * by_n.p};
    }
    /// Derivative of |F|^2, from that of the amplitudes.
    [[nodiscard]] double unpolarised_reflectance(const FresnelAmplitudes& by) const noexcept {
        return value.s.real() * by.s.real() + value.s.imag() * by.s.imag() + value.p.real() * by.p.real() +
               value.p.imag() * by.p.imag();
    }
};

/// Fresnel amplitudes and how they change.
///   formula     with c, r, N and d as above:
///               dF_s/dc = 2 d/(r (c + r)^2), dF_p/dc = 2 N^2 d/(r (N^2 c + r)^2),
///               dF_s/dn = -2 c N/(r (c + r)^2), dF_p/dn = 2 c N (N^2 - 2 sin^2)/(r (N^2 c + r)^2),
///               d/dk = i d/dn, since both are analytic in N; (F_s + F_p)/sin^2 = 2 F_s/(r c + sin^2)
///   cos_theta   c [1]   0 ... 1
///   limits      r = 0, the critical angle of total reflection (for N = 1 the horizon): by_cos_theta and by_n
///               have no finite value and are 0; k = 0: derivatives by k are one-sided
///   error       accuracy::fresnel_gradient / min(1, |r|^2), of derivatives beside 1 plus themselves
[[nodiscard]] FresnelGradient fresnel_gradient(double cos_theta, const RefractiveIndex& index) noexcept;

}  // namespace hts
