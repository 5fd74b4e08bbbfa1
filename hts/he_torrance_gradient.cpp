#include "hts/he_torrance_gradient.hpp"

#include <algorithm>
#include <array>
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

/// v_xy along the axes, each component times tau_x/tau or tau_y/tau.
struct StretchedChange {
    HorizontalChange value;
    double along, across;
    const Direction& axis;

    StretchedChange(const Surface& surface, const Direction& in, const Direction& out)
        : value{},
          along{surface.correlation_lengths().along / surface.correlation_length()},
          across{surface.correlation_lengths().across / surface.correlation_length()},
          axis{surface.axis()} {
        value = of(horizontal_change(in, out));
    }
    [[nodiscard]] HorizontalChange of(const HorizontalChange& v) const {
        return {along * (v.x * axis.cos_phi() + v.y * axis.sin_phi()),
                across * (v.y * axis.cos_phi() - v.x * axis.sin_phi())};
    }
    /// Derivative of the squared length where v_xy moves so.
    [[nodiscard]] double squared_by(const HorizontalChange& moved) const {
        const HorizontalChange by = of(moved);
        return 2 * (value.x * by.x + value.y * by.y);
    }
    [[nodiscard]] ByAngles<double> squared_by_angles(const Direction& in, const Direction& out) const {
        return {squared_by({in.cos_theta() * in.cos_phi(), in.cos_theta() * in.sin_phi()}),
                squared_by({out.cos_theta() * out.cos_phi(), out.cos_theta() * out.sin_phi()}),
                squared_by({-out.sin_theta() * out.sin_phi(), out.sin_theta() * out.cos_phi()})};
    }
    [[nodiscard]] ByAxes squared_by_axes() const {
        return {2 * square(value.x), 2 * square(value.y),
                2 * value.x * value.y * (along / across - across / along)};
    }
};

// ------------------------------------------------------------------------------------ Phi and the lobe

/// Phi with g dPhi/dg and dPhi/dt.
struct PhiSlopes {
    double value, by_log_g, by_t;
};

/// Those of 2 D, see PairFactors::phi.
PhiSlopes correlated_slopes(const Correlation& shape, DiffuseLobe lobe, double g, double t) {
    const double q = 2 * std::sqrt(t);
    if (lobe == DiffuseLobe::first_order) {
        constexpr double single_kicks = 1e-5;  // where D is g W
        const double value = std::exp(std::numbers::ln2 + std::log(g) - g + shape.log_spectrum(q));
        return {value, (1 - g) * value, value * shape.lobe_slopes(single_kicks, t).by_t};
    }
    const double value = shape.lobe(g, q).value;
    const ScatteringSlopes slopes = shape.lobe_slopes(g, t);
    return {value, value * slopes.by_log_g, value * slopes.by_t};
}

PhiSlopes phi_slopes(const Surface& surface, DiffuseLobe lobe, double g, double t) {
    if (lobe == DiffuseLobe::none || g == 0) return {0, 0, 0};
    if (surface.correlation()) return correlated_slopes(*surface.correlation(), lobe, g, t);
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
    const PhiSlopes phi = phi_slopes(pair.surface(), lobe_of, factors.phase_variance(wavelength), t);
    const double lobe = factors.lobe(phi.value, wavelength);
    if (lobe == 0 || is_at_horizon(pair.in()) || is_at_horizon(pair.out())) return {lobe, {}};
    const double t_over_squared = square(wavelength.wave_number() * pair.surface().correlation_length() / 2);
    const double over_vertical = 1 / factors.change().vertical;
    const auto by_angle = [&](double log_roughness, double vertical, double horizontal, double log_geometry) {
        const double log_g = 2 * (log_roughness + vertical * over_vertical);
        const double by_phi = phi.by_log_g * log_g + phi.by_t * (t_over_squared * horizontal);
        return factors.lobe(by_phi, wavelength) + lobe * log_geometry;
    };
    const ByAngles<double>&roughness = pair.log_roughness(), &geometry = pair.log_geometry();
    const ByAngles<double>&vertical = pair.change().vertical, &horizontal = pair.stretched_squared();
    Gradient<> by;
    by.theta_i = by_angle(roughness.theta_i, vertical.theta_i, horizontal.theta_i, geometry.theta_i);
    by.theta_r = by_angle(roughness.theta_r, vertical.theta_r, horizontal.theta_r, geometry.theta_r);
    by.phi = by_angle(roughness.phi, 0, horizontal.phi, geometry.phi);
    const ByAxes &rough = pair.log_roughness_by_axes(), &stretched = pair.stretched_squared_by_axes(),
                 &shape = pair.log_geometry_by_axes();
    const CorrelationLengths& lengths = pair.surface().correlation_lengths();
    // besides, tau_x tau_y is a factor of the lobe
    by.correlation_length_x = (lobe + by_angle(rough.x, 0, stretched.x, shape.x)) / lengths.along;
    by.correlation_length_y = (lobe + by_angle(rough.y, 0, stretched.y, shape.y)) / lengths.across;
    by.azimuth = by_angle(rough.azimuth, 0, stretched.azimuth, shape.azimuth);
    // sigma_0 and tau act by their ratio, sigma_0 in g besides, and tau in t and in tau^2
    const double by_log_g = factors.lobe(2 * phi.by_log_g, wavelength);
    const double by_log_slope =
        by_log_g * pair.log_roughness_by_log_slope() + lobe * pair.log_geometry_by_log_slope();
    const double by_log_length =
        by_log_g * pair.log_roughness_by_log_length() + lobe * pair.log_geometry_by_log_length();
    by.rms_roughness = (by_log_slope + by_log_g) / pair.surface().rms_roughness();
    by.correlation_length = (2 * lobe + factors.lobe(2 * t * phi.by_t, wavelength) - by_log_length) /
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
    by.correlation_length = -value * by_log_slope * in.slope_by_length / surface.correlation_length();
    const ByAxes& slope = in.slope_by_axes;
    by.correlation_length_x = value * by_log_slope * slope.x / surface.correlation_lengths().along;
    by.correlation_length_y = value * by_log_slope * slope.y / surface.correlation_lengths().across;
    by.azimuth = value * by_log_slope * slope.azimuth;
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

/// Derivatives by n, k and thickness of each film that is asked for.
///   of   turns derivatives of the amplitudes into those of the wanted value
template <class Value, class Use>
void each_film(const CoatedIndex& index, double cos_theta, const Wavelength& wavelength,
               std::span<ByFilm<Value>> films, Use&& of) {
    if (films.empty()) return;
    std::array<FilmGradient, CoatedIndex::most_films> each;
    const auto by = std::span{each}.first(index.film_count());
    static_cast<void>(index.gradient(cos_theta, by));
    for (std::size_t j = 0; j < std::min(by.size(), films.size()); ++j)
        films[j] = {of(by[j].by_n), of(by[j].by_k()), wavelength.wave_number() * of(by[j].by_phase)};
}

/// The derivatives of a value by the parameters of the surface and by its index. The value is a scale times
/// a function of Fresnel's amplitudes.
///   of_scale     turns a derivative of the scale into that of the value
///   of_fresnel   the same for derivatives of the amplitudes
template <class OfScale, class OfFresnel>
auto by_material(const Gradient<>& scale, const FresnelGradient& amplitudes, OfScale&& of_scale,
                 OfFresnel&& of_fresnel) {
    Gradient<decltype(of_scale(0.0))> by;
    by.rms_roughness = of_scale(scale.rms_roughness);
    by.correlation_length = of_scale(scale.correlation_length);
    by.correlation_length_x = of_scale(scale.correlation_length_x);
    by.correlation_length_y = of_scale(scale.correlation_length_y);
    by.azimuth = of_scale(scale.azimuth);
    by.n = of_fresnel(amplitudes.by_n);
    by.k = of_fresnel(amplitudes.by_k());
    return by;
}

}  // namespace

ViewGradient view_gradient(const Surface& surface, const Direction& direction) noexcept {
    return {direction, visibility_gradient(surface, direction), log_slope_by_axes(surface, direction), 1};
}

ViewGradient view_gradient(const Surface& surface, const Direction& direction,
                           const Wavelength& wavelength) noexcept {
    if (!surface.correlation()) return view_gradient(surface, direction);
    ViewGradient view = view_gradient(surface.seen_by(wavelength), direction);
    const CorrelationLengths by = seen_by_lengths(surface, wavelength);
    view.slope_by_axes.x *= by.along;
    view.slope_by_axes.y *= by.across;
    view.slope_by_length = -(view.slope_by_axes.x + view.slope_by_axes.y);
    return view;
}

PairGradient::PairGradient(const Surface& surface, const ViewGradient& in, const ViewGradient& out) noexcept
    : surface_{surface},
      in_{in.direction},
      out_{out.direction},
      factors_{surface, in.view(), out.view()},
      change_{wave_vector_change_gradient(in.direction, out.direction)},
      cos_theta_d_{cos_theta_d_gradient(factors_.cos_theta_d(), change_.squared)},
      log_geometry_{log_geometrical_factor(factors_.change(), change_)},
      stretched_squared_{change_.horizontal_squared} {
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
    log_roughness_by_log_length_ = of_in * i.log_obstruction_by_log_slope * in.slope_by_length +
                                   of_out * r.log_obstruction_by_log_slope * out.slope_by_length;
    log_geometry_by_log_length_ = i.log_shadowing_by_log_slope * in.slope_by_length +
                                  r.log_shadowing_by_log_slope * out.slope_by_length;
    const ByAxes &slope_i = in.slope_by_axes, &slope_r = out.slope_by_axes;
    const double rough_i = of_in * i.log_obstruction_by_log_slope;
    const double rough_r = of_out * r.log_obstruction_by_log_slope;
    log_roughness_by_axes_ = rough_i * slope_i + rough_r * slope_r;
    log_geometry_by_axes_ = i.log_shadowing_by_log_slope * slope_i + r.log_shadowing_by_log_slope * slope_r;
    const StretchedChange stretched{surface, in_, out_};
    stretched_squared_by_axes_ = stretched.squared_by_axes();
    if (surface.isotropic()) return;
    log_roughness_.phi = -rough_r * slope_r.azimuth;
    log_geometry_.phi -= r.log_shadowing_by_log_slope * slope_r.azimuth;
    stretched_squared_ = stretched.squared_by_angles(in_, out_);
}

BrdfGradient directional_diffuse_gradient(const PairGradient& pair, const Wavelength& wavelength,
                                          const CoatedIndex& index, DiffuseLobe lobe_of,
                                          std::span<ByFilm<>> films) noexcept {
    std::ranges::fill(films, ByFilm<>{});
    const BrdfGradient lobe = lobe_gradient(pair, wavelength, lobe_of);
    if (lobe.value == 0) return {0, {}};
    const FresnelGradient amplitudes = index.gradient(pair.factors().cos_theta_d(), {});
    const double reflectance = amplitudes.value.unpolarised_reflectance();
    const auto by_fresnel = [&](const FresnelAmplitudes& by) {
        return lobe.value * amplitudes.unpolarised_reflectance(by);
    };
    const double by_cosine = by_fresnel(amplitudes.by_cos_theta);
    const ByAngles<double>& cosine = pair.cos_theta_d();
    Gradient<> by = by_material(
        lobe.by, amplitudes, [&](double of) { return reflectance * of; }, by_fresnel);
    by.theta_i = reflectance * lobe.by.theta_i + by_cosine * cosine.theta_i;
    by.theta_r = reflectance * lobe.by.theta_r + by_cosine * cosine.theta_r;
    by.phi = reflectance * lobe.by.phi + by_cosine * cosine.phi;
    each_film(index, pair.factors().cos_theta_d(), wavelength, films, by_fresnel);
    return {reflectance * lobe.value, by};
}

BrdfGradient brdf_gradient(const PairGradient& pair, const Wavelength& wavelength, const CoatedIndex& index,
                           double uniform_diffuse, DiffuseLobe lobe, std::span<ByFilm<>> films) noexcept {
    BrdfGradient result = directional_diffuse_gradient(pair, wavelength, index, lobe, films);
    result.value += uniform_diffuse;
    result.by.diffuse_albedo = std::numbers::inv_pi;
    return result;
}

MuellerGradient directional_diffuse_mueller_gradient(const PairGradient& pair, const Wavelength& wavelength,
                                                     const CoatedIndex& index, DiffuseLobe lobe_of,
                                                     std::span<ByFilm<Mueller>> films) noexcept {
    std::ranges::fill(films, ByFilm<Mueller>{});
    const BrdfGradient lobe = lobe_gradient(pair, wavelength, lobe_of);
    if (lobe.value == 0) return {};
    const FresnelGradient amplitudes = index.gradient(pair.factors().cos_theta_d(), {});
    const auto facet = [&](const FresnelAmplitudes& f) { return facet_jones(pair.in(), pair.out(), f); };
    const JonesMatrix jones = facet(amplitudes.value);
    const JonesMatrix by_cosine = facet(amplitudes.by_cos_theta);
    const auto turned = facet_jones_gradient(pair.in(), pair.out(), jones, amplitudes);
    const ByAngles<double>& cosine = pair.cos_theta_d();
    const ScaledMueller term{lobe.value, jones};
    const auto by_angle = [&](double of_lobe, double of_cosine, const JonesMatrix& turn) {
        return term.by_scale(of_lobe) + term.by_jones(of_cosine * by_cosine + turn);
    };
    const auto by_scale = [&](double of) { return term.by_scale(of); };
    const auto by_fresnel = [&](const FresnelAmplitudes& by) { return term.by_jones(facet(by)); };
    MuellerGradient result{term.value(), by_material(lobe.by, amplitudes, by_scale, by_fresnel)};
    result.by.theta_i = by_angle(lobe.by.theta_i, cosine.theta_i, turned.theta_i);
    result.by.theta_r = by_angle(lobe.by.theta_r, cosine.theta_r, turned.theta_r);
    result.by.phi = by_angle(lobe.by.phi, cosine.phi, turned.phi);
    each_film(index, pair.factors().cos_theta_d(), wavelength, films, by_fresnel);
    return result;
}

SpecularGradient specular_reflectance_gradient(const Surface& surface, const ViewGradient& in,
                                               const Wavelength& wavelength, const CoatedIndex& index,
                                               std::span<ByFilm<>> films) noexcept {
    std::ranges::fill(films, ByFilm<>{});
    const BrdfGradient coherent = coherent_gradient(surface, in, wavelength);
    const FresnelGradient amplitudes = index.gradient(in.direction.cos_theta(), {});
    const double reflectance = amplitudes.value.unpolarised_reflectance();
    const auto by_fresnel = [&](const FresnelAmplitudes& by) {
        return coherent.value * amplitudes.unpolarised_reflectance(by);
    };
    Gradient<> by = by_material(
        coherent.by, amplitudes, [&](double of) { return reflectance * of; }, by_fresnel);
    by.theta_i =
        reflectance * coherent.by.theta_i - in.direction.sin_theta() * by_fresnel(amplitudes.by_cos_theta);
    each_film(index, in.direction.cos_theta(), wavelength, films, by_fresnel);
    return {SpecularReflectance{reflectance * coherent.value}, by};
}

MuellerGradient specular_mueller_gradient(const Surface& surface, const ViewGradient& in,
                                          const Wavelength& wavelength, const CoatedIndex& index,
                                          std::span<ByFilm<Mueller>> films) noexcept {
    std::ranges::fill(films, ByFilm<Mueller>{});
    const BrdfGradient coherent = coherent_gradient(surface, in, wavelength);
    const FresnelGradient amplitudes = index.gradient(in.direction.cos_theta(), {});
    const auto diagonal = [](const FresnelAmplitudes& f) { return JonesMatrix{f.s, 0.0, 0.0, f.p}; };
    const ScaledMueller term{coherent.value, diagonal(amplitudes.value)};
    const auto by_scale = [&](double of) { return term.by_scale(of); };
    const auto by_fresnel = [&](const FresnelAmplitudes& by) { return term.by_jones(diagonal(by)); };
    MuellerGradient result{term.value(), by_material(coherent.by, amplitudes, by_scale, by_fresnel)};
    result.by.theta_i = term.by_scale(coherent.by.theta_i) +
                        term.by_jones(-in.direction.sin_theta() * diagonal(amplitudes.by_cos_theta));
    each_film(index, in.direction.cos_theta(), wavelength, films, by_fresnel);
    return result;
}

}  // namespace hts
