#include "hts/he_torrance_gradient.hpp"

#include <cmath>
#include <numbers>

#include "hts/roughness.hpp"

namespace hts {
namespace {

double square(double x) {
    return x * x;
}

/// Derivatives by theta grow as 1/cos theta; here they would leave a double's range.
bool is_at_horizon(const Direction& direction) {
    constexpr double least_cosine = 1e-100;
    return direction.cos_theta() < least_cosine;
}

// ------------------------------------------------------------------------------------ parts of a pair

/// Share of one direction in K = K_i + K_r.
double share(double obstruction, double other) {
    if (obstruction == 0) return 0;
    return std::isinf(obstruction) ? 1 : obstruction / (obstruction + other);
}

/// d ln sigma / d ln K; 0 for a mirror.
double log_slope(const Surface& surface, double effective_roughness) {
    if (surface.rms_roughness() == 0) return 0;
    return effective_roughness_log_slope(effective_roughness / surface.rms_roughness());
}

/// 0 where both directions graze and mirror each other.
ByAngles<double> cos_theta_d_gradient(double cos_theta_d, const ByAngles<double>& squared) {
    if (cos_theta_d == 0) return {0, 0, 0};
    const double scale = 1 / (8 * cos_theta_d);
    return {scale * squared.theta_i, scale * squared.theta_r, scale * squared.phi};
}

/// Of ln G = 2 ln(v.v/v_z).
ByAngles<double> log_geometrical_factor(const WaveVectorChange& change, const WaveVectorChangeGradient& by) {
    if (change.vertical == 0) return {0, 0, 0};
    const double over_squared = 2 / change.squared();
    const double over_vertical = 2 / change.vertical;
    return {by.squared.theta_i * over_squared - by.vertical.theta_i * over_vertical,
            by.squared.theta_r * over_squared - by.vertical.theta_r * over_vertical,
            by.squared.phi * over_squared};
}

// ------------------------------------------------------------------------------------ Phi and the lobe

/// Phi with g dPhi/dg and dPhi/dt.
struct PhiSlopes {
    double value, by_log_g, by_t;
};

PhiSlopes phi_slopes(DiffuseLobe lobe, double g, double t) {
    if (lobe == DiffuseLobe::none || g == 0) return {0, 0, 0};
    if (lobe == DiffuseLobe::first_order) {
        const double value = std::exp(std::log(g) - g - t);
        return {value, (1 - g) * value, -value};
    }
    if (lobe == DiffuseLobe::rough_limit) {
        const double value = std::exp(-t / g - std::log(g));
        return {value, (t / g - 1) * value, -value / g};
    }
    const PhiGradient phi = phi_gradient(g, t, Tolerance{accuracy::tabled_phi_gradient});
    return {phi.value, g * phi.d_g, phi.d_t};
}

/// The lobe for |F|^2 = 1 and its derivatives [1/sr]; those by n, k and a are 0.
BrdfGradient lobe_gradient(const PairGradient& pair, const Wavelength& wavelength, DiffuseLobe lobe_of) {
    const PairFactors& factors = pair.factors();
    const double t = factors.lobe_argument(wavelength);
    const PhiSlopes phi = phi_slopes(lobe_of, factors.phase_variance(wavelength), t);
    const double lobe = factors.lobe(phi.value, wavelength);
    if (lobe == 0 || is_at_horizon(pair.in()) || is_at_horizon(pair.out())) return {lobe, {}};
    const double t_over_horizontal =
        square(wavelength.wave_number() * pair.surface().correlation_length() / 2);
    const double over_vertical = 1 / factors.change().vertical;
    const auto by_angle = [&](double log_roughness, double vertical, double horizontal, double log_geometry) {
        const double log_g = 2 * (log_roughness + vertical * over_vertical);
        const double by_phi = phi.by_log_g * log_g + phi.by_t * (t_over_horizontal * horizontal);
        return factors.lobe(by_phi, wavelength) + lobe * log_geometry;
    };
    const ByAngles<double>&roughness = pair.log_roughness(), &geometry = pair.log_geometry();
    const WaveVectorChangeGradient& change = pair.change();
    Gradient<> by;
    by.theta_i = by_angle(roughness.theta_i, change.vertical.theta_i, change.horizontal_squared.theta_i,
                          geometry.theta_i);
    by.theta_r = by_angle(roughness.theta_r, change.vertical.theta_r, change.horizontal_squared.theta_r,
                          geometry.theta_r);
    by.phi = by_angle(0, 0, change.horizontal_squared.phi, geometry.phi);
    // sigma_0 and tau act by their ratio, sigma_0 in g besides, and tau in t and in tau^2
    const double by_log_g = factors.lobe(2 * phi.by_log_g, wavelength);
    const double by_log_slope =
        by_log_g * pair.log_roughness_by_log_slope() + lobe * pair.log_geometry_by_log_slope();
    by.rms_roughness = (by_log_slope + by_log_g) / pair.surface().rms_roughness();
    by.correlation_length = (2 * lobe + factors.lobe(2 * t * phi.by_t, wavelength) - by_log_slope) /
                            pair.surface().correlation_length();
    return {lobe, by};
}

// ------------------------------------------------------------------------------------ the specular term

/// exp(-g) S and its derivatives.
BrdfGradient coherent_gradient(const Surface& surface, const ViewGradient& in, const Wavelength& wavelength) {
    const double value = coherent_fraction(surface, in.view(), wavelength);
    const VisibilityGradient& seen = in.visibility;
    if (value == 0 || surface.rms_roughness() == 0 || is_at_horizon(in.direction)) return {value, {}};
    const double ratio = effective_roughness_ratio(2 * seen.value.obstruction);
    const double g =
        phase_variance(ratio * surface.rms_roughness(), 2 * in.direction.cos_theta(), wavelength);
    const double log_slope = effective_roughness_log_slope(ratio);
    const double tangent = in.direction.sin_theta() / in.direction.cos_theta();
    // of ln value = -g + 2 ln S_1
    const double by_log_slope =
        2 * (seen.log_shadowing_by_log_slope - g * log_slope * seen.log_obstruction_by_log_slope);
    Gradient<> by;
    by.rms_roughness = value * (by_log_slope - 2 * g) / surface.rms_roughness();
    by.correlation_length = -value * by_log_slope / surface.correlation_length();
    by.theta_i =
        value * 2 * (seen.log_shadowing_by_theta - g * (log_slope * seen.log_obstruction_by_theta - tangent));
    return {value, by};
}

// ------------------------------------------------------------------------------------ polarisation

JonesMatrix operator*(double scale, const JonesMatrix& a) {
    return {scale * a.ss, scale * a.sp, scale * a.ps, scale * a.pp};
}

JonesMatrix operator+(const JonesMatrix& a, const JonesMatrix& b) {
    return {a.ss + b.ss, a.sp + b.sp, a.ps + b.ps, a.pp + b.pp};
}

/// Derivative of a scale times the Mueller matrix of a Jones matrix.
class ScaledMueller {
  public:
    ScaledMueller(double scale, const JonesMatrix& jones)
        : scale_{scale}, jones_{jones}, mueller_{Mueller::from_jones(jones)} {}

    [[nodiscard]] Mueller value() const { return scale_ * mueller_; }
    [[nodiscard]] Mueller by_scale(double scale) const { return scale * mueller_; }
    [[nodiscard]] Mueller by_jones(const JonesMatrix& by) const {
        return scale_ * Mueller::from_jones_gradient(jones_, by);
    }

  private:
    double scale_;
    JonesMatrix jones_;
    Mueller mueller_;
};

}  // namespace

ViewGradient view_gradient(const Surface& surface, const Direction& direction) noexcept {
    return {direction, visibility_gradient(surface, direction)};
}

PairGradient::PairGradient(const Surface& surface, const ViewGradient& in, const ViewGradient& out) noexcept
    : surface_{surface},
      in_{in.direction},
      out_{out.direction},
      factors_{surface, in.view(), out.view()},
      change_{wave_vector_change_gradient(in.direction, out.direction)},
      cos_theta_d_{cos_theta_d_gradient(factors_.cos_theta_d(), change_.squared)},
      log_geometry_{log_geometrical_factor(factors_.change(), change_)} {
    const VisibilityGradient &i = in.visibility, &r = out.visibility;
    const double slope = log_slope(surface, factors_.effective_roughness());
    const double of_in = slope * share(i.value.obstruction, r.value.obstruction);
    const double of_out = slope * share(r.value.obstruction, i.value.obstruction);
    log_roughness_ = {of_in * i.log_obstruction_by_theta, of_out * r.log_obstruction_by_theta, 0};
    log_roughness_by_log_slope_ =
        of_in * i.log_obstruction_by_log_slope + of_out * r.log_obstruction_by_log_slope;
    log_geometry_.theta_i += i.log_quotient_by_theta;
    log_geometry_.theta_r += r.log_quotient_by_theta;
    log_geometry_by_log_slope_ = i.log_shadowing_by_log_slope + r.log_shadowing_by_log_slope;
}

BrdfGradient directional_diffuse_gradient(const PairGradient& pair, const Wavelength& wavelength,
                                          const RefractiveIndex& index, DiffuseLobe lobe_of) noexcept {
    const BrdfGradient lobe = lobe_gradient(pair, wavelength, lobe_of);
    if (lobe.value == 0) return {0, {}};
    const FresnelGradient amplitudes = fresnel_gradient(pair.factors().cos_theta_d(), index);
    const double reflectance = amplitudes.value.unpolarised_reflectance();
    const double by_cosine = lobe.value * amplitudes.unpolarised_reflectance(amplitudes.by_cos_theta);
    const ByAngles<double>& cosine = pair.cos_theta_d();
    Gradient<> by;
    by.rms_roughness = reflectance * lobe.by.rms_roughness;
    by.correlation_length = reflectance * lobe.by.correlation_length;
    by.n = lobe.value * amplitudes.unpolarised_reflectance(amplitudes.by_n);
    by.k = lobe.value * amplitudes.unpolarised_reflectance(amplitudes.by_k());
    by.theta_i = reflectance * lobe.by.theta_i + by_cosine * cosine.theta_i;
    by.theta_r = reflectance * lobe.by.theta_r + by_cosine * cosine.theta_r;
    by.phi = reflectance * lobe.by.phi + by_cosine * cosine.phi;
    return {reflectance * lobe.value, by};
}

BrdfGradient brdf_gradient(const PairGradient& pair, const Wavelength& wavelength,
                           const RefractiveIndex& index, double uniform_diffuse, DiffuseLobe lobe) noexcept {
    BrdfGradient result = directional_diffuse_gradient(pair, wavelength, index, lobe);
    result.value += uniform_diffuse;
    result.by.diffuse_albedo = std::numbers::inv_pi;
    return result;
}

MuellerGradient directional_diffuse_mueller_gradient(const PairGradient& pair, const Wavelength& wavelength,
                                                     const RefractiveIndex& index,
                                                     DiffuseLobe lobe_of) noexcept {
    const BrdfGradient lobe = lobe_gradient(pair, wavelength, lobe_of);
    if (lobe.value == 0) return {};
    const FresnelGradient amplitudes = fresnel_gradient(pair.factors().cos_theta_d(), index);
    const auto facet = [&](const FresnelAmplitudes& f) { return facet_jones(pair.in(), pair.out(), f); };
    const JonesMatrix jones = facet(amplitudes.value);
    const JonesMatrix by_cosine = facet(amplitudes.by_cos_theta);
    const auto turned = facet_jones_gradient(pair.in(), pair.out(), jones, amplitudes);
    const ByAngles<double>& cosine = pair.cos_theta_d();
    const ScaledMueller term{lobe.value, jones};
    const auto by_angle = [&](double of_lobe, double of_cosine, const JonesMatrix& turn) {
        return term.by_scale(of_lobe) + term.by_jones(of_cosine * by_cosine + turn);
    };
    MuellerGradient result{term.value(), {}};
    result.by.rms_roughness = term.by_scale(lobe.by.rms_roughness);
    result.by.correlation_length = term.by_scale(lobe.by.correlation_length);
    result.by.n = term.by_jones(facet(amplitudes.by_n));
    result.by.k = term.by_jones(facet(amplitudes.by_k()));
    result.by.theta_i = by_angle(lobe.by.theta_i, cosine.theta_i, turned.theta_i);
    result.by.theta_r = by_angle(lobe.by.theta_r, cosine.theta_r, turned.theta_r);
    result.by.phi = by_angle(lobe.by.phi, cosine.phi, turned.phi);
    return result;
}

SpecularGradient specular_reflectance_gradient(const Surface& surface, const ViewGradient& in,
                                               const Wavelength& wavelength,
                                               const RefractiveIndex& index) noexcept {
    const BrdfGradient coherent = coherent_gradient(surface, in, wavelength);
    const FresnelGradient amplitudes = fresnel_gradient(in.direction.cos_theta(), index);
    const double reflectance = amplitudes.value.unpolarised_reflectance();
    const auto by_fresnel = [&](const FresnelAmplitudes& by) {
        return coherent.value * amplitudes.unpolarised_reflectance(by);
    };
    Gradient<> by;
    by.rms_roughness = reflectance * coherent.by.rms_roughness;
    by.correlation_length = reflectance * coherent.by.correlation_length;
    by.n = by_fresnel(amplitudes.by_n);
    by.k = by_fresnel(amplitudes.by_k());
    by.theta_i =
        reflectance * coherent.by.theta_i - in.direction.sin_theta() * by_fresnel(amplitudes.by_cos_theta);
    return {SpecularReflectance{reflectance * coherent.value}, by};
}

MuellerGradient specular_mueller_gradient(const Surface& surface, const ViewGradient& in,
                                          const Wavelength& wavelength,
                                          const RefractiveIndex& index) noexcept {
    const BrdfGradient coherent = coherent_gradient(surface, in, wavelength);
    const FresnelGradient amplitudes = fresnel_gradient(in.direction.cos_theta(), index);
    const auto diagonal = [](const FresnelAmplitudes& f) { return JonesMatrix{f.s, 0.0, 0.0, f.p}; };
    const ScaledMueller term{coherent.value, diagonal(amplitudes.value)};
    MuellerGradient result{term.value(), {}};
    result.by.rms_roughness = term.by_scale(coherent.by.rms_roughness);
    result.by.correlation_length = term.by_scale(coherent.by.correlation_length);
    result.by.n = term.by_jones(diagonal(amplitudes.by_n));
    result.by.k = term.by_jones(diagonal(amplitudes.by_k()));
    result.by.theta_i = term.by_scale(coherent.by.theta_i) +
                        term.by_jones(-in.direction.sin_theta() * diagonal(amplitudes.by_cos_theta));
    return result;
}

}  // namespace hts
