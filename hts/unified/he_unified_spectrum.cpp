#include "hts/unified/he_unified_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>

#include "hts/error.hpp"
#include "hts/sampling/scattering_lobe.hpp"
#include "hts/unified/film_lobe.hpp"
#include "hts/unified/lanes/return_rows.hpp"
#include "hts/unified/lanes/unified_simd.hpp"
#include "hts/unified/unified_mirror.hpp"

namespace hts {
namespace {

using unified_detail::Forms;
using unified_detail::in_powers;
using unified_detail::Prepared;
using unified_detail::ReturnRow;
using unified_detail::set_return_rows;

constexpr std::size_t padding = 8;  // the longest vector

double square(double x) {
    return x * x;
}

Prepared prepare(const Surface& surface, const ReturnFactor& m, double mixed,
                 std::span<const SpectralSample> samples, std::span<const UnifiedWave> waves) {
    const double sigma_squared = square(surface.rms_roughness());
    const std::size_t padded = (samples.size() + padding - 1) / padding * padding;
    Prepared p{{surface.slope_width(),
                sigma_squared,
                1 / sigma_squared,
                square(surface.correlation_length()) / 4,
                2 * m.slope(),
                mixed,
                in_powers(m.coefficients()),
                evaluation_detail::axis_terms(surface),
                {},
                0,
                0},
               std::ranges::all_of(samples,
                                   [](const SpectralSample& s) {
                                       return std::hypot(s.index.substrate().n(), s.index.substrate().k()) >=
                                              std::sqrt(unified_detail::dense_square);
                                   }),
               samples.size(),
               padded,
               std::vector<double>(Prepared::columns * padded)};
    for (std::size_t i = 0; i < padded; ++i) {
        const SpectralSample& s = samples[std::min(i, samples.size() - 1)];
        const UnifiedWave& wave = waves[std::min(i, samples.size() - 1)];
        const double n = s.index.substrate().n(), k = s.index.substrate().k();
        const double d_real = (n - 1) * (n + 1) - k * k, d_imaginary = 2 * n * k;
        const double wave_squared = square(s.wavelength.wave_number());
        const auto set = [&p, padded, i](Prepared::Column column, double value) {
            p.data[column * padded + i] = value;
        };
        set(Prepared::wave_squared, wave_squared);
        set(Prepared::inverse_wave_squared, 1 / wave_squared);
        set(Prepared::d_real, d_real);
        set(Prepared::d_imaginary, d_imaginary);
        // films make their own Jones matrix, which is not over d
        const double of_index = s.index.coated() ? 1 : square(d_real) + square(d_imaginary);
        set(Prepared::weight, square(wave.k_length) * of_index * (std::numbers::inv_pi / 4));
        set(Prepared::horizon, 1.25 * wave.k_sigma);
        set(Prepared::lift, wave.lift);
        set(Prepared::returned, wave.returned);
        set(Prepared::uniform, s.uniform_diffuse);
        set(Prepared::mirror_slant, std::sqrt(unified_mirror_slant) / wave.k_tau);
        set(Prepared::mirror_grazing, unified_mirror_grazing / (wave.k_tau * std::sqrt(wave.k_tau)));
        const std::complex<double> impedance = wave.index.normal_impedance();
        set(Prepared::impedance_real, impedance.real());
        set(Prepared::impedance_imaginary, impedance.imag());
        // N sqrt(1 - x), x = s^2/e, by the binomial series
        std::complex<double> term{n, k};
        for (std::size_t j = 0; j < unified_detail::root_terms; ++j) {
            set(static_cast<Prepared::Column>(Prepared::root_real + j), term.real());
            set(static_cast<Prepared::Column>(Prepared::root_imaginary + j), term.imag());
            const auto j_real = static_cast<double>(j);
            term *= (j_real - 0.5) / (j_real + 1) / (std::complex<double>{n, k} * std::complex<double>{n, k});
        }
    }
    return p;
}

/// What the wavelengths see of a surface, for the lanes: see Prepared::seen.
template <class Seen>
void set_seen(Prepared& p, const std::vector<Seen>& seen) {
    const bool isotropic = p.surface.axes.isotropic;
    p.seen.resize((Prepared::return_factor + (isotropic ? ReturnFactor::terms : 0)) * p.padded);
    for (std::size_t i = 0; i < p.padded; ++i) {
        const auto& [surface, m] = seen[std::min(i, seen.size() - 1)];
        const auto axes = evaluation_detail::axis_terms(surface);
        p.seen[Prepared::slope_width * p.padded + i] = isotropic ? surface.slope_width() : axes.width_along;
        p.seen[Prepared::slope_width_across * p.padded + i] = axes.width_across;
        if (!isotropic) continue;
        p.seen[Prepared::return_width * p.padded + i] = 2 * m.slope();
        const auto powers = in_powers(m.coefficients());
        for (std::size_t j = 0; j < powers.size(); ++j)
            p.seen[(Prepared::return_factor + j) * p.padded + i] = powers[j];
    }
    set_return_rows(p.surface, std::span{p.seen}.first(Prepared::return_width * p.padded));
}

/// The matrix with that of the uniform diffuse term; without one, zeros keep their signs.
Mueller with_uniform(const Mueller& lobe, const SpectralSample& sample) {
    return sample.uniform_diffuse == 0 ? lobe : lobe + Mueller::depolariser(sample.uniform_diffuse);
}

void require_metals(std::span<const SpectralSample> samples) {
    for (const SpectralSample& sample : samples) {
        const double reflectance = sample.index.amplitudes(1).unpolarised_reflectance();
        if (reflectance >= accuracy::least_of_conductors) continue;
        throw Error{"conductor_shortcut at " + shortest(sample.wavelength.micrometres()) + " um: " +
                    out_of_range("reflectance of the flat surface along the normal", reflectance, "",
                                 ">= " + shortest(accuracy::least_of_conductors) + ", that of a metal")
                        .what()};
    }
}

/// What is known of isotropic surfaces alone.
void require_theory(const Surface& surface, const UnifiedChoices& choices) {
    if (surface.isotropic() && !surface.correlation()) return;
    const auto refusal = [&](const char* choice, const char* why) {
        const char* const kind =
            surface.isotropic() ? "whose correlation is not gaussian" : "of two correlation lengths";
        return Error{std::string{choice} + " of a surface " + kind + ": " + why};
    };
    if (choices.mirror == UnifiedChoices::Mirror::second_order)
        throw refusal("the second-order mirror term", R"(must be "closed")");
    if (choices.polarisation_mixing)
        throw refusal("polarisation mixing", "must be false (it was fitted to isotropic Gaussian ones)");
}

}  // namespace

void require_theory_of_films(const UnifiedChoices& choices) {
    if (choices.mirror == UnifiedChoices::Mirror::second_order)
        throw Error{"mirror second_order: must be closed where there are films"};
    if (choices.polarisation_mixing)
        throw Error{"polarisation_mixing true: must be false where there are films"};
    if (choices.conductor_shortcut)
        throw Error{"conductor_shortcut true: must be false where there are films"};
}

struct HeUnifiedSpectrum::Lanes {
    Forms forms;
    Prepared prepared;
    std::vector<FilmLobe> films;  // of all samples, where they have films, or of none

    /// Under films, for each sample use(i, its Jones matrix); false where the lanes do not take the pair.
    template <class Use>
    bool each_of_films(const DirectionPair& pair, Use&& use) const noexcept {
        constexpr std::size_t most = 64;
        std::array<double, most> lobes, shares;
        const FilmPair of{pair};
        for (std::size_t first = 0; first < films.size(); first += most) {
            const std::size_t count = std::min(most, films.size() - first);
            if (!forms.shares_one(prepared, pair, first, count, lobes.data(), shares.data())) return false;
            for (std::size_t i = 0; i < count; ++i) use(first + i, films[first + i](of, lobes[i], shares[i]));
        }
        return true;
    }
    /// BRDFs of a pair; false where the lanes do not take it.
    [[nodiscard]] bool brdf(const DirectionPair& pair, std::span<const SpectralSample> samples,
                            std::span<double> result) const noexcept {
        if (films.empty()) return forms.brdf_one(prepared, pair, result.data());
        return each_of_films(pair, [&](std::size_t i, const JonesMatrix& j) {
            result[i] = samples[i].uniform_diffuse +
                        (std::norm(j.ss) + std::norm(j.sp) + std::norm(j.ps) + std::norm(j.pp)) / 2;
        });
    }
};

HeUnifiedSpectrum::HeUnifiedSpectrum(const Surface& surface, std::vector<SpectralSample> samples,
                                     Tolerance tolerance, DiffuseLobe lobe, const UnifiedChoices& choices)
    : surface_{surface},
      samples_{std::move(samples)},
      tolerance_{tolerance},
      lobe_{lobe},
      choices_{choices},
      return_factor_{surface},
      mixed_{choices.polarisation_mixing ? mixed_share(surface) : 0} {
    const bool coated =
        std::ranges::any_of(samples_, [](const SpectralSample& sample) { return sample.index.coated(); });
    if (coated) require_theory_of_films(choices);
    if (choices.conductor_shortcut) require_metals(samples_);
    require_theory(surface, choices);
    waves_.reserve(samples_.size());
    for (const Surface& seen : evaluation_detail::seen_surfaces(surface_, samples_, lobe_))
        seen_.push_back({seen, ReturnFactor{seen}});
    for (const SpectralSample& sample : samples_) {
        const ReturnFactor& m = seen_.empty() ? return_factor_ : seen_[waves_.size()].return_factor;
        waves_.emplace_back(surface_, m, sample.wavelength, sample.index);
        if (choices_.conductor_shortcut) {
            conductors_.push_back(waves_.back());
            conductors_.back().index = CoatedIndex{perfect_conductor()};
        }
        if (choices_.mirror == UnifiedChoices::Mirror::second_order)
            mirrors_.emplace_back(waves_.back().k_sigma, waves_.back().k_tau, sample.index.substrate());
    }
    const bool all_coated =
        std::ranges::all_of(samples_, [](const SpectralSample& sample) { return sample.index.coated(); });
    if (coated != all_coated || lobe != DiffuseLobe::full ||
        tolerance.relative_error() < accuracy::finest_lane_tolerance ||
        !evaluation_detail::is_ordinary(surface_, samples_))
        return;
    const Forms forms = unified_detail::forms(tolerance, !seen_.empty());
    if (forms.brdf_one == nullptr) return;
    Prepared prepared = prepare(surface_, return_factor_, mixed_, samples_, waves_);
    prepared.conductor = choices_.conductor_shortcut;
    if (seen_.empty()) {
        const auto& axes = prepared.surface.axes;
        set_return_rows(prepared.surface, std::array{axes.width_along, axes.width_across});
    } else {
        prepared.correlation = &surface_.correlation()->table();
        set_seen(prepared, seen_);
    }
    std::vector<FilmLobe> films;
    for (std::size_t i = 0; coated && i < samples_.size(); ++i)
        films.emplace_back(samples_[i].index, waves_[i].lift);
    lanes_ = std::make_shared<const Lanes>(Lanes{forms, std::move(prepared), std::move(films)});
}

std::size_t HeUnifiedSpectrum::bytes() const noexcept {
    std::size_t sum = sizeof *this + samples_.size() * (sizeof(SpectralSample) + sizeof(UnifiedWave)) +
                      conductors_.size() * sizeof(UnifiedWave) + seen_.size() * sizeof(Seen);
    if (lanes_) {
        sum += sizeof(Lanes) +
               (lanes_->prepared.data.size() + lanes_->prepared.seen.size()) * sizeof(double) +
               lanes_->prepared.surface.return_rows.size() * sizeof(ReturnRow);
    }
    if (lanes_)
        for (const FilmLobe& film : lanes_->films) sum += film.bytes();
    for (const SecondOrderMirror& mirror : mirrors_) sum += mirror.bytes();
    return sum;
}

void HeUnifiedSpectrum::brdf(const DirectionPair& pair, std::span<double> result) const {
    evaluation_detail::require_size("brdf", result.size(), samples_.size());
    if (lanes_ && lanes_->brdf(pair, samples_, result)) return;
    exact_brdf(pair, result);
}

void HeUnifiedSpectrum::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    evaluation_detail::require_size("brdf", result.size(), samples_.size(), pairs.size());
    const std::size_t count = samples_.size();
    const bool films = lanes_ && !lanes_->films.empty();
    if (lanes_ && !films && lanes_->forms.brdf_many(lanes_->prepared, pairs, result.data())) return;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto values = result.subspan(i * count, count);
        if (films)
            brdf(pairs[i], values);
        else if (!lanes_ || !evaluation_detail::is_ordinary(pairs[i]))
            exact_brdf(pairs[i], values);
    }
}

void HeUnifiedSpectrum::mueller(const DirectionPair& pair, std::span<Mueller> result) const {
    evaluation_detail::require_size("mueller", result.size(), samples_.size());
    if (!lanes_) return exact_mueller(pair, result);
    const bool taken = lanes_->films.empty()
                           ? lanes_->forms.mueller_one(lanes_->prepared, pair, result.data())
                           : lanes_->each_of_films(pair, [&](std::size_t i, const JonesMatrix& jones) {
                                 result[i] = with_uniform(unified_mueller(jones, mixed_), samples_[i]);
                             });
    if (!taken) exact_mueller(pair, result);
}

void HeUnifiedSpectrum::exact_brdf(const DirectionPair& pair, std::span<double> result) const noexcept {
    UnifiedView in = view(pair.in), out = view(pair.out);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (i > 0 && !seen_.empty()) {
            in = view(pair.in, i);
            out = view(pair.out, i);
        }
        result[i] = samples_[i].uniform_diffuse + unpolarised_lobe(in, out, i);
    }
}

double HeUnifiedSpectrum::unpolarised_lobe(const UnifiedView& in, const UnifiedView& out, std::size_t sample,
                                           std::optional<double> lobe_argument) const noexcept {
    const auto lobe = [&](const UnifiedWave& wave) {
        return unified_lobe(in, out, wave, lobe_, tolerance_, lobe_argument).brdf();
    };
    if (conductors_.empty()) return lobe(waves_[sample]);
    const double cos_theta_d = wave_vector_change(in.direction, out.direction).cos_theta_d();
    return samples_[sample].index.amplitudes(cos_theta_d).unpolarised_reflectance() *
           lobe(conductors_[sample]);
}

void HeUnifiedSpectrum::exact_mueller(const DirectionPair& pair, std::span<Mueller> result) const noexcept {
    UnifiedView in = view(pair.in), out = view(pair.out);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (i > 0 && !seen_.empty()) {
            in = view(pair.in, i);
            out = view(pair.out, i);
        }
        result[i] = with_uniform(
            unified_mueller(unified_lobe(in, out, waves_[i], lobe_, tolerance_).jones, mixed_), samples_[i]);
    }
}

FresnelAmplitudes HeUnifiedSpectrum::mirror(const Direction& in, std::size_t sample) const noexcept {
    return mirrors_.empty() ? unified_mirror(in, waves_[sample]) : mirrors_[sample](in);
}

void HeUnifiedSpectrum::specular_reflectance(const Direction& in, std::span<double> result) const {
    evaluation_detail::require_size("specular_reflectance", result.size(), samples_.size());
    if (lanes_ && lanes_->films.empty() && mirrors_.empty() &&
        lanes_->forms.specular_one(lanes_->prepared, in, result.data()))
        return;
    for (std::size_t i = 0; i < samples_.size(); ++i) result[i] = mirror(in, i).unpolarised_reflectance();
}

void HeUnifiedSpectrum::specular_mueller(const Direction& in, std::span<Mueller> result) const {
    evaluation_detail::require_size("specular_mueller", result.size(), samples_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const FresnelAmplitudes f = mirror(in, i);
        result[i] = Mueller::from_jones({f.s, 0.0, 0.0, f.p});
    }
}

ScatteringLobe HeUnifiedSpectrum::scattering_lobe() const {
    const SpectralSample& sample = samples_.front();
    const HeUnifiedSpectrum one{surface_,
                                {{sample.wavelength, sample.index, 0}},
                                Tolerance{accuracy::finest_lane_tolerance},
                                lobe_,
                                choices_};
    return {.wave_number = sample.wavelength.wave_number(),
            .surface = surface_,
            .diffuse_albedo = sample.uniform_diffuse * std::numbers::pi,
            .brdf =
                [one](const DirectionPair& pair) {
                    double value = 0;
                    one.brdf(pair, {&value, 1});
                    return value;
                },
            .mirror =
                [one](const Direction& in) {
                    double value = 0;
                    one.specular_reflectance(in, {&value, 1});
                    return value;
                },
            .effective_roughness = [sigma = surface_.rms_roughness()](const Direction&) { return sigma; }};
}

}  // namespace hts
