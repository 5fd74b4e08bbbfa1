#include "validation/scattering/vector/vector_models.hpp"

#include <cmath>
#include <numbers>

#include "hts/unified/unified_terms.hpp"

namespace hts::validation {
namespace {

SpectralSample conductor() {
    return {Wavelength::from_micrometres(1), perfect_conductor(), 0};
}

Channels squared(const JonesMatrix& jones) {
    return {{std::norm(jones.ss), std::norm(jones.sp), std::norm(jones.ps), std::norm(jones.pp)}};
}

/// What pure states of polarisation find in each other.
Channels of_pure_states(const Mueller& m) {
    const double even = m(0, 0) + m(1, 1), odd = m(0, 0) - m(1, 1), out = m(1, 0), in = m(0, 1);
    return {{(even + in + out) / 2, (odd - in + out) / 2, (odd + in - out) / 2, (even - in - out) / 2}};
}

std::array<double, 2> diagonal(const Mueller& m) {
    const Channels all = of_pure_states(m);
    return {all[Channel::ss], all[Channel::pp]};
}

}  // namespace

std::string_view name(VectorModel model) noexcept {
    constexpr std::array<std::string_view, vector_models.size()> names{"kirchhoff", "smith", "he",
                                                                       "he_unified"};
    return names[static_cast<std::size_t>(model)];
}

std::string_view name(Channel channel) noexcept {
    constexpr std::array<std::string_view, channels.size()> names{"ss", "sp", "ps", "pp"};
    return names[static_cast<std::size_t>(channel)];
}

ClosedForms::ClosedForms(const Surface& surface)
    : he_{surface, {conductor()}}, unified_{surface, {conductor()}} {}

std::array<Channels, vector_models.size()> ClosedForms::lobes(const Direction& in,
                                                              const Direction& out) const {
    const UnifiedView view_in = unified_.view(in), view_out = unified_.view(out);
    const UnifiedWave& wave = unified_.waves()[0];
    const UnifiedLobe unified = unified_lobe(view_in, view_out, wave);
    const double cosines = in.cos_theta() * out.cos_theta();
    const double amplitude =
        wave.k_length * std::numbers::inv_sqrtpi / 4 * wave_vector_change(in, out).root_geometrical_factor();
    const double strength = amplitude * amplitude * unified.kicks.phi / cosines;
    const Channels facet = squared(facet_jones(in, out, {-1, 1}));
    const double masked =
        cosines / (cosines + view_in.masked * out.cos_theta() + view_out.masked * in.cos_theta());
    std::array<Channels, vector_models.size()> result{};
    const auto of = [&](VectorModel model) -> Channels& { return result[static_cast<std::size_t>(model)]; };
    of(VectorModel::kirchhoff).add(out.cos_theta() * strength, facet);
    of(VectorModel::smith).add(out.cos_theta() * strength * masked, facet);
    Mueller he;
    he_.mueller({in, out}, {&he, 1});
    of(VectorModel::he).add(out.cos_theta(), of_pure_states(he));
    of(VectorModel::he_unified).add(out.cos_theta(), squared(unified.jones));
    return result;
}

std::array<Channels, vector_models.size()> ClosedForms::lobes(const PlaneWaveBeam& beam,
                                                              const Direction& out) const {
    std::array<Channels, vector_models.size()> mean{};
    for (const BeamWave& wave : beam.waves()) {
        const auto some = lobes(wave.in(), out);
        for (std::size_t m = 0; m < mean.size(); ++m) mean[m].add(wave.weight, some[m]);
    }
    return mean;
}

std::array<std::array<double, 2>, vector_models.size()> ClosedForms::mirrors(
    const PlaneWaveBeam& beam) const {
    std::array<std::array<double, 2>, vector_models.size()> mean{};
    for (const BeamWave& wave : beam.waves()) {
        const Direction in = wave.in();
        const double change = 2 * unified_.waves()[0].k_sigma * in.cos_theta();
        Mueller he, unified;
        he_.specular_mueller(in, {&he, 1});
        unified_.specular_mueller(in, {&unified, 1});
        const double kirchhoff = std::exp(-change * change);
        const std::array<std::array<double, 2>, vector_models.size()> some{
            {{kirchhoff, kirchhoff}, {kirchhoff, kirchhoff}, diagonal(he), diagonal(unified)}};
        for (std::size_t m = 0; m < mean.size(); ++m) {
            for (std::size_t q = 0; q < 2; ++q) mean[m][q] += wave.weight * some[m][q];
        }
    }
    return mean;
}

}  // namespace hts::validation
