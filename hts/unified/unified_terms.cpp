#include "hts/unified/unified_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "hts/phi/phi_sum.hpp"
#include "hts/unified/film_lobe.hpp"
#include "hts/unified/lobe_of_kicks.hpp"

namespace hts {
namespace {

using Complex = std::complex<double>;

double square(double x) {
    return x * x;
}

/// What Bragg's matrix has of one ray.
struct BraggRay {
    Complex root;   // r
    Complex s_sum;  // c + r
    Complex p_sum;  // e (c + Z) + r

    BraggRay(const Direction& d, const Complex& square_of_index, const Complex& excess, double lift) {
        const double c = d.cos_theta();
        root = std::sqrt(std::norm(excess) < 0.25 ? excess + c * c : square_of_index - square(d.sin_theta()));
        s_sum = c + root;
        p_sum = square_of_index * (c + lift) + root;
    }
};

/// s_i s_r - cos phi, with its digits also where phi and both cosines are small.
double bend(const Direction& in, const Direction& out) {
    return (square(in.cos_phi() + out.cos_phi()) + square(in.sin_phi() + out.sin_phi()) -
            square(in.sin_theta() - out.sin_theta()) - square(in.cos_theta()) - square(out.cos_theta())) /
           2;
}

JonesMatrix bragg_jones_of_films(const Direction& in, const Direction& out, const CoatedIndex& index,
                                 double lift) {
    std::array<CoatedIndex::Fields, CoatedIndex::most_films + 1> of_in, of_out;
    index.fields(in.cos_theta(), lift, of_in);
    index.fields(out.cos_theta(), lift, of_out);
    return bragg_of_fields(in, out, index, of_in, of_out);
}

/// 1 - L
double above_horizon(double k_sigma, double cosine) {
    return -std::expm1(-4 * std::log1p(1.25 * k_sigma * cosine));
}

Kicks limit_of_kicks(DiffuseLobe lobe, double g, double t) {
    if (lobe == DiffuseLobe::none || g == 0) return {0, 1, 0, PhiMethod::zero};
    if (lobe == DiffuseLobe::first_order) return {std::exp(std::log(g) - g - t), 1, 0, PhiMethod::limit};
    const double beta = std::min(1.0, 1 / g);
    return {std::exp(-t / g - std::log(g)), beta, 1 - beta, PhiMethod::limit};
}

/// a + share (b - a) of two matrices with factors of their own.
JonesMatrix between(const JonesMatrix& a, double of_a, const JonesMatrix& b, double of_b) {
    return {of_a * a.ss + of_b * b.ss, of_a * a.sp + of_b * b.sp, of_a * a.ps + of_b * b.ps,
            of_a * a.pp + of_b * b.pp};
}

}  // namespace

double flat_reflectance(const CoatedIndex& index) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    constexpr unsigned levels = 12;
    constexpr double enough = 1e-13;
    const auto reflected = [&](double c) { return 2 * c * index.amplitudes(c).unpolarised_reflectance(); };
    const double n = index.substrate().n(), k = index.substrate().k();
    // sqrt(e - s^2) has a kink where total reflection begins, for a real index below 1
    const double kink = std::sqrt(std::clamp(1 - (n - k) * (n + k), 0.0, 1.0));
    const auto below = [&](double u) { return 2 * u * kink * reflected(kink * (1 - u * u)); };
    const auto above = [&](double u) { return 2 * u * (1 - kink) * reflected(kink + (1 - kink) * u * u); };
    const double sum = (kink > 0 ? Rule::integrate(below, 0.0, 1.0, levels, enough) : 0) +
                       (kink < 1 ? Rule::integrate(above, 0.0, 1.0, levels, enough) : 0);
    return std::clamp(sum, 0.0, 1.0);
}

double bragg_lift(double k_sigma, double k_tau) noexcept {
    constexpr double roughest = 6, shortest = 2;  // of what the constant was fitted to
    const double held = std::max(k_tau, shortest);
    const double fade = std::min(1.0, k_tau / shortest);
    return 0.25 * k_sigma * std::min(k_sigma, roughest) / (held * std::sqrt(held)) * fade;
}

UnifiedWave::UnifiedWave(Surface rough, const ReturnFactor& m, const Wavelength& wavelength, CoatedIndex of)
    : surface{std::move(rough)},
      seen{surface.seen_by(wavelength)},
      index{std::move(of)},
      k_sigma{wavelength.wave_number() * surface.rms_roughness()},
      k_tau{wavelength.wave_number() * seen.correlation_length()},
      k_length{wavelength.wave_number() * surface.correlation_length()},
      lift{bragg_lift(k_sigma, k_tau)},
      returned{m.returned(flat_reflectance(index))} {}

JonesMatrix bragg_jones(const Direction& in, const Direction& out, const CoatedIndex& index,
                        double lift) noexcept {
    if (index.coated()) return bragg_jones_of_films(in, out, index, lift);
    const double n = index.substrate().n(), k = index.substrate().k();
    const Complex square_of_index{(n - k) * (n + k), 2 * n * k}, excess{(n - 1) * (n + 1) - k * k, 2 * n * k};
    if (excess == 0.0) return {};
    const double cosine = -(in.cos_phi() * out.cos_phi() + in.sin_phi() * out.sin_phi());
    const double sine = -sin_azimuth_between(in, out);
    const BraggRay i{in, square_of_index, excess, lift}, o{out, square_of_index, excess, lift};
    const Complex s_in = excess / i.s_sum, p_in = excess / i.p_sum, roots = i.root * o.root;
    const double sines = in.sin_theta() * out.sin_theta();
    // r_i r_r cos phi - e s_i s_r, whose parts cancel at grazing angles where |e| is large; there it is
    // -e bend - cos phi (e - r_i r_r)
    Complex along = roots * cosine - square_of_index * sines;
    constexpr double large = 100;
    if (std::norm(square_of_index) > large * large) {
        const Complex lost =
            square(in.sin_theta()) + square(out.sin_theta()) - sines * sines / square_of_index;
        along = -square_of_index * bend(in, out) - cosine * lost / (1.0 + roots / square_of_index);
    }
    return {-cosine * s_in / o.s_sum, -sine * (i.root / i.p_sum) * (excess / o.s_sum),
            -sine * s_in * (o.root / o.p_sum), p_in * (along / o.p_sum)};
}

Kicks kicks(double g, double t, DiffuseLobe lobe, Tolerance tolerance) noexcept {
    if (lobe != DiffuseLobe::full) return limit_of_kicks(lobe, g, t);
    constexpr double little =
        1e-3;  // of w, below which the difference from 1 keeps too little and the sums are short
    if (tolerance.relative_error() >= accuracy::quick_kicks) {
        const PhiGradient tabled = phi_gradient(g, t, Tolerance{accuracy::tabled_phi_gradient});
        if (tabled.value == 0) return {0, 1, 0, PhiMethod::zero};
        const double beta = -tabled.log_d_t;
        if (beta < 1 - little) return {tabled.value, beta, 1 - beta, PhiMethod::table};
    }
    const Phi value = phi(g, t);
    if (value.value == 0) return {0, 1, 0, value.method};
    const phi_detail::PhiSum sum = phi_detail::phi_sum(g, t);
    return {value.value, sum.inverse_mean, sum.rest, value.method};
}

Kicks kicks(const Surface& surface, double g, double t, DiffuseLobe lobe, Tolerance tolerance) noexcept {
    if (!surface.correlation()) return kicks(g, t, lobe, tolerance);
    if (lobe == DiffuseLobe::none || g == 0) return {0, 1, 0, PhiMethod::zero};
    const double q = 2 * std::sqrt(t);
    if (lobe == DiffuseLobe::first_order)
        return {2 * g * std::exp(surface.correlation()->log_spectrum(q) - g), 1, 0, PhiMethod::limit};
    const ScatteringIntegral twice = surface.correlation()->lobe(g, q);
    return {twice.value, twice.inverse_mean, 1 - twice.inverse_mean, PhiMethod::spline};
}

UnifiedLobe unified_lobe(const UnifiedView& in, const UnifiedView& out, const UnifiedWave& wave,
                         DiffuseLobe lobe, Tolerance tolerance,
                         std::optional<double> lobe_argument) noexcept {
    const WaveVectorChange change = wave_vector_change(in.direction, out.direction);
    const double g = square(wave.k_sigma * change.vertical);
    const double t = lobe_argument.value_or(
        square(wave.k_length *
               (wave.surface.isotropic() ? change.horizontal
                                         : stretched_horizontal(wave.surface, in.direction, out.direction)) /
               2));
    return lobe_of_kicks(in, out, wave, g, t, kicks(wave.surface, g, t, lobe, tolerance));
}

UnifiedLobe lobe_of_kicks(const UnifiedView& in, const UnifiedView& out, const UnifiedWave& wave, double g,
                          double t, const Kicks& kicks) noexcept {
    const WaveVectorChange change = wave_vector_change(in.direction, out.direction);
    UnifiedLobe result{{}, g, t, kicks, 0};
    const auto& [phi, beta, w, method] = result.kicks;
    const double c_i = in.direction.cos_theta(), c_r = out.direction.cos_theta();
    const double cosines = c_i * c_r;
    if (!(phi > 0 && cosines > 0)) return result;
    const double returned = 1 + wave.returned * w * (in.return_factor * out.return_factor - 1);
    const double spread = cosines + w * (in.masked * c_r + out.masked * c_i);
    result.shadowing = returned * (cosines / spread);
    const double kirchhoff = w * (above_horizon(wave.k_sigma, c_i) * above_horizon(wave.k_sigma, c_r));
    const double scale =
        wave.k_length * (std::numbers::inv_sqrtpi / 2) * std::sqrt(phi) * std::sqrt(returned / spread);
    const JonesMatrix facet =
        facet_jones(in.direction, out.direction, wave.index.amplitudes(change.cos_theta_d()));
    const JonesMatrix bragg = bragg_jones(in.direction, out.direction, wave.index, wave.lift);
    result.jones = between(facet, scale * kirchhoff * change.root_geometrical_factor() / 2, bragg,
                           scale * (1 - kirchhoff) * (2 * cosines / change.vertical));
    return result;
}

double mixed_share(const Surface& surface) noexcept {
    return std::min(0.5, 0.05 * square(surface.slope_width()));
}

Mueller unified_mueller(const JonesMatrix& jones, double mixed) noexcept {
    const Mueller pure = Mueller::from_jones(jones);
    if (mixed == 0) return pure;
    return (1 - mixed) * pure + mixed * Mueller::from_jones({jones.pp, jones.ps, jones.sp, jones.ss});
}

}  // namespace hts
