#include "hts/terms.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hts/error.hpp"
#include "hts/roughness.hpp"

namespace hts {
namespace {

double square(double x) {
    return x * x;
}

Phi limit(double log) {
    return {std::exp(log), log, PhiMethod::limit};
}

Phi phi_of(DiffuseLobe lobe, double g, double t) {
    if (lobe == DiffuseLobe::full) return hts::phi(g, t);
    if (lobe == DiffuseLobe::none || g == 0)
        return {0, -std::numeric_limits<double>::infinity(), PhiMethod::zero};
    return limit(lobe == DiffuseLobe::first_order ? std::log(g) - g - t : -t / g - std::log(g));
}

}  // namespace

View view(const Surface& surface, const Direction& direction) noexcept {
    return {direction, visibility(surface, direction)};
}

PairFactors::PairFactors(const Surface& surface, const View& in, const View& out) noexcept
    : change_{wave_vector_change(in.direction, out.direction)},
      stretched_{surface.isotropic() ? change_.horizontal
                                     : surface.stretched(horizontal_change(in.direction, out.direction))},
      cos_theta_d_{change_.cos_theta_d()},
      effective_roughness_{surface.rms_roughness() *
                           effective_roughness_ratio(in.visibility.obstruction + out.visibility.obstruction)},
      shadowing_{in.visibility.shadowing * out.visibility.shadowing},
      correlation_length_{surface.correlation_length()},
      shadowing_over_cosines_{in.visibility.shadowing_over_cosine * out.visibility.shadowing_over_cosine},
      correlation_{surface.correlation() ? &*surface.correlation() : nullptr} {}

double PairFactors::phase_variance(const Wavelength& wavelength) const noexcept {
    return hts::phase_variance(effective_roughness_, change_.vertical, wavelength);
}

double PairFactors::lobe_argument(const Wavelength& wavelength) const noexcept {
    return square(wavelength.wave_number() * stretched_ * correlation_length_ / 2);
}

Phi PairFactors::phi(double g, double t, DiffuseLobe lobe) const noexcept {
    if (correlation_ == nullptr || lobe == DiffuseLobe::none || g == 0) return phi_of(lobe, g, t);
    const double q = 2 * std::sqrt(t);
    if (lobe == DiffuseLobe::first_order)
        return limit(std::numbers::ln2 + std::log(g) - g + correlation_->log_spectrum(q));
    const ScatteringIntegral twice = correlation_->lobe(g, q);
    return {twice.value, twice.log, PhiMethod::spline};
}

double PairFactors::lobe(double phi, const Wavelength& wavelength) const noexcept {
    if (phi == 0) return 0;
    const double root_g =
        change_.root_geometrical_factor();  // on both sides of Phi, which is small where G is large
    const double tau_over_lambda = correlation_length_ / wavelength.micrometres();
    return std::numbers::pi / 4 * square(tau_over_lambda) * (root_g * phi * root_g) * shadowing_over_cosines_;
}

const char* name(DiffuseLobe lobe) noexcept {
    switch (lobe) {
        case DiffuseLobe::none:
            return "none";
        case DiffuseLobe::first_order:
            return "first_order";
        case DiffuseLobe::rough_limit:
            return "rough_limit";
        case DiffuseLobe::full:
            return "full";
    }
    return "";
}

DirectionalDiffuse directional_diffuse(const PairFactors& pair, const Wavelength& wavelength,
                                       const CoatedIndex& index, DiffuseLobe lobe_of) noexcept {
    const double g = pair.phase_variance(wavelength);
    const double t = pair.lobe_argument(wavelength);
    const Phi roughness = pair.phi(g, t, lobe_of);
    const FresnelAmplitudes amplitudes = index.amplitudes(pair.cos_theta_d());
    const double lobe = pair.lobe(roughness.value, wavelength);
    return {amplitudes.unpolarised_reflectance() * lobe, lobe, amplitudes, g, t, roughness.method};
}

Mueller directional_diffuse_mueller(const Direction& in, const Direction& out,
                                    const DirectionalDiffuse& term) noexcept {
    return term.lobe * Mueller::from_jones(facet_jones(in, out, term.amplitudes));
}

double coherent_fraction(const Surface& surface, const View& in, const Wavelength& wavelength) noexcept {
    const double effective_roughness =
        surface.rms_roughness() * effective_roughness_ratio(2 * in.visibility.obstruction);
    const double g = phase_variance(effective_roughness, 2 * in.direction.cos_theta(), wavelength);
    return std::exp(-g) * square(in.visibility.shadowing);
}

SpecularReflectance specular_reflectance(const Surface& surface, const View& in, const Wavelength& wavelength,
                                         const CoatedIndex& index) noexcept {
    return SpecularReflectance{index.amplitudes(in.direction.cos_theta()).unpolarised_reflectance() *
                               coherent_fraction(surface, in, wavelength)};
}

Mueller specular_mueller(const Surface& surface, const View& in, const Wavelength& wavelength,
                         const CoatedIndex& index) noexcept {
    const FresnelAmplitudes f = index.amplitudes(in.direction.cos_theta());
    return coherent_fraction(surface, in, wavelength) * Mueller::from_jones({f.s, 0.0, 0.0, f.p});
}

double uniform_diffuse(double albedo) {
    if (!(albedo >= 0 && albedo <= 1)) throw out_of_range("diffuse albedo", albedo, "", "from 0 to 1");
    return albedo * std::numbers::inv_pi;
}

Mueller uniform_diffuse_mueller(double albedo) {
    return Mueller::depolariser(uniform_diffuse(albedo));
}

}  // namespace hts
