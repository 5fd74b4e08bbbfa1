/// The anisotropic model of Kurt, Szirmay-Kalos and Krivanek (Computer Graphics 44(1), 2010),
/// for fitting and sampling:
///
///   f = kd/pi + sum_l ks_l F_l D_l / (4 cos theta_d (cos theta_i cos theta_r)^alpha_l)    [Kurt10 (11),
///   (14)] f = kd (1 - F)/pi + the same with one
///   lobe [Kurt10 (13), coupled]
///
/// F is Schlick's reflectance from f0 (12) at theta_d, D Gaussian slopes of widths mx, my (5).
/// The printed (10) to (14) have lost the pair of parentheses around the two cosines, which reciprocity and
/// the paper's own weight (21) ask for.
///
/// Energy. With alpha = 0, ks = 1, kd = 0 a lobe reflects at most 1. It stays below (9), F D/(4 cos theta_d
/// max(cos theta_i, cos theta_r)), which the paper calls energy conserving, but which is so only for m up to
/// about 1.5: at grazing it reflects 1.24 for m = 2.5, 2.3 for m = 5. With alpha > 0 it does so only away
/// from the horizon: as theta_i -> 90 deg the albedo grows like cos(theta_i)^-alpha without bound, however
/// small alpha is. `hts figures kurt` maps where it passes 1.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hts/microfacet/lobes.hpp"
#include "hts/microfacet/normals/gaussian_slopes.hpp"

namespace hts {

namespace accuracy {
/// Of `KurtLobe::brdf`, relative, for mx, my >= 0.01, 0 ... 89.9 deg, and values above 1e-30.
inline constexpr double kurt = 7e-12;
}  // namespace accuracy

/// One specular lobe for ks = 1.
class KurtLobe : public SlopeLobe {
  public:
    ///   f0      reflectance at normal incidence, 0 ... 1       mx, my   slope widths, 1e-6 ... 1e3
    ///   alpha   exponent of the cosines, 0 ... below 2: from 2 on the albedo is infinite. Else hts::Error
    KurtLobe(double f0, double mx, double my, double alpha);

    [[nodiscard]] double f0() const noexcept { return f0_; }
    [[nodiscard]] double alpha() const noexcept { return alpha_; }

    /// F D/(4 cos theta_d (cos theta_i cos theta_r)^alpha) [1/sr].
    ///   error   accuracy::kurt
    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return geometry(in, out).brdf(f0_);
    }
    [[nodiscard]] LobeGeometry geometry(const Direction& in, const Direction& out) const noexcept;
    [[nodiscard]] bool same_facets(const KurtLobe& other) const noexcept {
        return alpha_ == other.alpha_ && SlopeLobe::same_facets(other);
    }
    [[nodiscard]] double strength(const Direction& in) const noexcept { return schlick_strength(f0_, in); }

  private:
    double f0_;
    double alpha_;
};

/// The model with its diffuse term.
class Kurt {
  public:
    /// [Kurt10 (11)] with one lobe, (14) with several.
    ///   kd   diffuse albedo, 0 ... 1      ks   of each lobe, 0 ... 1e6; else hts::Error
    Kurt(double kd, std::vector<WeightedLobe<KurtLobe>> lobes);
    /// [Kurt10 (13)]: the diffuse term gets what the facets let through.
    [[nodiscard]] static Kurt coupled(double kd, WeightedLobe<KurtLobe> lobe);

    [[nodiscard]] double brdf(const Direction& in, const Direction& out) const noexcept {
        return spectral_brdf(*this, in, out);
    }
    static void brdf(std::span<const Kurt> alike, const Direction& in, const Direction& out,
                     std::span<double> result) noexcept;
    [[nodiscard]] bool shares_geometry(const Kurt& other) const noexcept {
        return coupled_ == other.coupled_ && parts_.shares_geometry(other.parts_);
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept {
        return parts_.pdf(in, out);
    }
    [[nodiscard]] Draw sample(const Direction& in, const Uniforms& u) const noexcept {
        return weighted(*this, in, parts_.draw(in, u));
    }

  private:
    DiffuseAndLobes<KurtLobe> parts_;
    bool coupled_ = false;
};

static_assert(GeometrySharingModel<Kurt>);

/// A material of the paper's Table 2, fitted to measurements of Matusik et al. with (11).
struct KurtPreset {
    const char* name;
    std::array<double, 3> kd, ks;  ///< red, green, blue
    KurtLobe lobe;
    double l2_error;  ///< of the fit, as the paper reports it

    /// The model of one channel, 0 ... 2.
    [[nodiscard]] Kurt model(std::size_t channel) const { return {kd.at(channel), {{ks.at(channel), lobe}}}; }
};

/// Brushed aluminium, purple satin, red velvet, yellow satin.
[[nodiscard]] std::span<const KurtPreset> kurt_presets();

}  // namespace hts
