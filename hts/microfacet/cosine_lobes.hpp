/// Lobes that are powers of a cosine: Blinn's (SIGGRAPH 1977), Ashikhmin and Shirley's (JGT 5(2), 2000) and
/// that of Lafortune, Foo, Torrance and Greenberg (SIGGRAPH 1997).
#pragma once

#include "hts/microfacet/lobes.hpp"

namespace hts {

namespace accuracy {
/// Of the three lobes, relative, for exponents 0 ... 1e4, 0 ... 89.9 deg and values above 1e-30.
inline constexpr double cosine_lobes = 3.5e-12;
}  // namespace accuracy

/// Blinn-Phong, c_n cos^n theta_h.
///   normalisation   c_n = (n + 2)(n + 4)/(8 pi (2^(-n/2) + n)): reflects exactly 1 at normal
///                   incidence; Blinn has none
///   flaws           reflects about cos^2 theta_i elsewhere, so it darkens towards grazing
class BlinnPhongLobe {
  public:
    ///   exponent   n, 0 ... 1e8, else hts::Error
    explicit BlinnPhongLobe(double exponent);

    [[nodiscard]] double exponent() const noexcept { return exponent_; }

    ///   error   accuracy::cosine_lobes
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).mirrors;
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] bool same_facets(const BlinnPhongLobe& other) const noexcept {
        return exponent_ == other.exponent_;
    }
    [[nodiscard]] double f0() const noexcept { return 1; }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] Vector3 draw(const Direction& in, double u1, double u2) const noexcept;
    [[nodiscard]] double strength(const Direction& in) const noexcept;

  private:
    double exponent_;
    double peak_;  // c_n
};

/// Ashikhmin and Shirley's specular lobe, F p / (4 cos theta_d max(cos theta_i, cos theta_r)) with Schlick's
/// F at theta_d and p = sqrt((nx + 1)(ny + 1))/(2 pi) cos^e theta_h, e = nx cos^2 phi_h + ny sin^2 phi_h.
///   normalisation   the integral of p is 1, that of p cos theta_h is not but (n + 1)/(n + 2) for nx = ny = n
///   flaws           so its facets cover less than the surface they stand for; the maximum has a kink
class AshikhminShirleyLobe {
  public:
    ///   f0   reflectance at normal incidence, 0 ... 1      nx, ny   exponents, 0 ... 1e8; else hts::Error
    AshikhminShirleyLobe(double f0, double nx, double ny);

    [[nodiscard]] double f0() const noexcept { return f0_; }
    [[nodiscard]] double nx() const noexcept { return nx_; }
    [[nodiscard]] double ny() const noexcept { return ny_; }

    ///   error   accuracy::cosine_lobes
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).brdf(f0_);
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] bool same_facets(const AshikhminShirleyLobe& other) const noexcept {
        return nx_ == other.nx_ && ny_ == other.ny_;
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] Vector3 draw(const Direction& in, double u1, double u2) const noexcept;
    [[nodiscard]] double strength(const Direction& in) const noexcept;
    /// p [1/sr].
    [[nodiscard]] double density(const HalfDirection& half) const noexcept;

  private:
    double f0_, nx_, ny_;
};

/// Lafortune's lobe, (n + 2)/(2 pi) (cx x_i x_r + cy y_i y_r + z_i z_r)^n, 0 where the sum is negative.
/// cx = cy = -1 is Phong's lobe about the mirror direction, 1 one back to the light. A published lobe (Cx x_i
/// x_r + ...)^n is this one with cx = Cx/Cz, cy = Cy/Cz and ks = 2 pi Cz^n/(n + 2).
///   normalisation   reflects exactly 1 at normal incidence, whatever the coefficients
///   flaws           |cx| or |cy| above 1 turns the peak off the mirror direction, towards the horizon, and
///                   makes it grow like (cx^2 sin^2 + cos^2)^(n/2): the albedo exceeds 1; at -1 the lobe
///                   sinks below the horizon and darkens towards grazing
class LafortuneLobe {
  public:
    ///   cx, cy   -10 ... 10      exponent   n, 0 ... 1e8; else hts::Error
    LafortuneLobe(double cx, double cy, double exponent);

    [[nodiscard]] double cx() const noexcept { return cx_; }
    [[nodiscard]] double cy() const noexcept { return cy_; }
    [[nodiscard]] double exponent() const noexcept { return exponent_; }

    ///   range   finite, at most 1e300      error   accuracy::cosine_lobes
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).mirrors;
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] bool same_facets(const LafortuneLobe& other) const noexcept {
        return cx_ == other.cx_ && cy_ == other.cy_ && exponent_ == other.exponent_;
    }
    [[nodiscard]] double f0() const noexcept { return 1; }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] Vector3 draw(const Direction& in, double u1, double u2) const noexcept;
    [[nodiscard]] double strength(const Direction& in) const noexcept;

  private:
    /// (cx x, cy y, z) of the incident direction: the lobe's axis, not of unit length.
    [[nodiscard]] Vector3 axis(const Direction& in) const noexcept;

    double cx_, cy_, exponent_;
};

using BlinnPhong = DiffuseAndLobes<BlinnPhongLobe>;
using Lafortune = DiffuseAndLobes<LafortuneLobe>;

/// Ashikhmin and Shirley's model: ks times their lobe and their own diffuse term,
///   28 rd/(23 pi) (1 - f0) (1 - (1 - cos theta_i/2)^5) (1 - (1 - cos theta_r/2)^5),
/// which leaves room for the lobe's Fresnel reflectance. The paper has no ks, which is 1; fits to
/// measurements take it for every lobe alike [Ngan, Durand, Matusik 2005; Kurt10 section 5.1].
class AshikhminShirley {
  public:
    ///   rd   diffuse reflectance, 0 ... 1      ks   specular reflectivity, 0 ... 1e6; else hts::Error
    AshikhminShirley(double rd, const AshikhminShirleyLobe& lobe, double ks = 1);

    ///   error   accuracy::cosine_lobes
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }
    static void brdf(std::span<const AshikhminShirley> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept;
    [[nodiscard]] bool shares_geometry(const AshikhminShirley& other) const noexcept {
        return parts_.shares_geometry(other.parts_);
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        return parts_.pdf(in, out);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept {
        return weighted(*this, in, parts_.draw(in, u));
    }

  private:
    DiffuseAndLobes<AshikhminShirleyLobe> parts_;  // with (1 - f0) rd for the diffuse albedo
};

static_assert(GeometrySharingModel<AshikhminShirley> && GeometrySharingModel<BlinnPhong>);

}  // namespace hts
