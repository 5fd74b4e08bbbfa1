#include "hts/he_torrance_spectrum.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "hts/error.hpp"
#include "hts/evaluation/prepared.hpp"
#include "hts/evaluation/single_simd.hpp"
#include "hts/films/cosine_table.hpp"
#include "hts/roughness.hpp"
#include "hts/sampling/scattering_lobe.hpp"

namespace hts {
namespace {

using evaluation_detail::Forms;
using evaluation_detail::Prepared;
using evaluation_detail::PreparedSingle;
using evaluation_detail::require_size;
using evaluation_detail::SingleForms;

///   seen   by each wavelength; none where the correlation is Gaussian
Prepared prepare(const Surface& surface, const std::vector<SpectralSample>& samples,
                 const std::vector<Surface>& seen) {
    Prepared p = evaluation_detail::prepared_as<double>(surface, samples);
    if (seen.empty()) return p;
    p.correlation = &surface.correlation()->table();
    p.widths.resize(2 * p.padded);
    for (std::size_t i = 0; i < p.padded; ++i) {
        const auto& lengths = seen[std::min(i, seen.size() - 1)].correlation_lengths();
        p.widths[i] = 2 * surface.rms_roughness() / lengths.along;
        p.widths[p.padded + i] = 2 * surface.rms_roughness() / lengths.across;
    }
    return p;
}

}  // namespace

struct HeTorranceSpectrum::Lanes {
    Forms forms;
    Prepared prepared;
    std::vector<FilmTable> films;  // by sample, where one has films, which the lanes lack
    bool all_coated;
    SingleForms single_forms{};  // null unless single precision meets the tolerance
    PreparedSingle single{};

    Lanes(const Forms& of, Prepared samples_prepared, const std::vector<SpectralSample>& samples)
        : forms{of}, prepared{std::move(samples_prepared)} {
        const auto coated = [](const SpectralSample& sample) { return sample.index.coated(); };
        all_coated = std::ranges::all_of(samples, coated);
        if (std::ranges::none_of(samples, coated)) return;
        for (const SpectralSample& sample : samples) films.emplace_back(sample.index);
    }

    [[nodiscard]] bool brdf(const DirectionPair& pair, double* result) const noexcept {
        return single_forms.brdf_one != nullptr ? single_forms.brdf_one(single, pair, result)
                                                : forms.brdf_one(prepared, pair, result);
    }
    [[nodiscard]] bool brdf(std::span<const DirectionPair> pairs, double* result) const noexcept {
        return single_forms.brdf_many != nullptr ? single_forms.brdf_many(single, pairs, result)
                                                 : forms.brdf_many(prepared, pairs, result);
    }
    /// The lanes' lobes of mirrors with the Jones matrices of the films; false where the lanes do not take
    /// the pair.
    [[nodiscard]] bool mueller_of_films(const DirectionPair& pair, const std::vector<SpectralSample>& samples,
                                        std::span<Mueller> result) const noexcept {
        // the lobes stand in front in the room of the matrices, which are filled from the last on
        const auto* const lobes = reinterpret_cast<const double*>(result.data());
        if (!forms.brdf_one(prepared, pair, reinterpret_cast<double*>(result.data()))) return false;
        const double cos_theta_d = wave_vector_change(pair.in, pair.out).cos_theta_d();
        // a facet's matrix is a sum over what it reflects of s and of p
        const JonesMatrix s = facet_jones(pair.in, pair.out, {1.0, 0.0}),
                          p = facet_jones(pair.in, pair.out, {0.0, 1.0});
        for (std::size_t i = result.size(); i-- > 0;) {
            const double lobe = lobes[i];
            const FresnelAmplitudes f = films[i].amplitudes(cos_theta_d);
            const JonesMatrix jones{f.s * s.ss + f.p * p.ss, f.s * s.sp + f.p * p.sp, f.s * s.ps + f.p * p.ps,
                                    f.s * s.pp + f.p * p.pp};
            result[i] = lobe * Mueller::from_jones(jones);
            if (samples[i].uniform_diffuse != 0)
                result[i] = result[i] + Mueller::depolariser(samples[i].uniform_diffuse);
        }
        return true;
    }
};

HeTorranceSpectrum::HeTorranceSpectrum(const Surface& surface, std::vector<SpectralSample> samples,
                                       Tolerance tolerance, DiffuseLobe lobe)
    : surface_{surface},
      seen_{evaluation_detail::seen_surfaces(surface, samples, lobe)},
      samples_{std::move(samples)},
      tolerance_{tolerance},
      lobe_{lobe} {
    if (lobe == DiffuseLobe::none) return;
    if (tolerance.relative_error() < accuracy::finest_lane_tolerance ||
        !evaluation_detail::is_ordinary(surface_, samples_))
        return;
    if (!seen_.empty() && lobe != DiffuseLobe::full) return;
    const Forms forms = evaluation_detail::forms(tolerance, lobe, !seen_.empty());
    if (forms.brdf_one == nullptr) return;
    auto lanes = std::make_unique<Lanes>(forms, prepare(surface_, samples_, seen_), samples_);
    if (tolerance.relative_error() >= accuracy::single_precision_brdf && seen_.empty() &&
        evaluation_detail::fits_single(surface_, samples_)) {
        lanes->single_forms = evaluation_detail::single_forms(lobe);
        lanes->single = evaluation_detail::prepared_as<float>(surface_, samples_);
    }
    lanes_ = std::move(lanes);
}

HeTorranceSpectrum::~HeTorranceSpectrum() = default;
HeTorranceSpectrum::HeTorranceSpectrum(const HeTorranceSpectrum& other)
    : surface_{other.surface_},
      seen_{other.seen_},
      samples_{other.samples_},
      tolerance_{other.tolerance_},
      lobe_{other.lobe_},
      lanes_{other.lanes_ ? std::make_unique<const Lanes>(*other.lanes_) : nullptr} {}
HeTorranceSpectrum::HeTorranceSpectrum(HeTorranceSpectrum&&) noexcept = default;
HeTorranceSpectrum& HeTorranceSpectrum::operator=(HeTorranceSpectrum other) noexcept {
    std::swap(surface_, other.surface_);
    std::swap(seen_, other.seen_);
    std::swap(samples_, other.samples_);
    std::swap(tolerance_, other.tolerance_);
    std::swap(lobe_, other.lobe_);
    std::swap(lanes_, other.lanes_);
    return *this;
}

std::size_t HeTorranceSpectrum::bytes() const noexcept {
    std::size_t sum =
        sizeof *this + samples_.size() * sizeof(SpectralSample) + seen_.size() * sizeof(Surface);
    if (!lanes_) return sum;
    for (const FilmTable& table : lanes_->films) sum += table.bytes();
    return sum + sizeof(Lanes) +
           (lanes_->prepared.data.size() + lanes_->prepared.widths.size()) * sizeof(double) +
           lanes_->single.data.size() * sizeof(float);
}

void HeTorranceSpectrum::brdf(const DirectionPair& pair, std::span<double> result) const {
    require_size("brdf", result.size(), samples_.size());
    if (lanes_ && lanes_->brdf(pair, result.data())) return add_films(pair, result);
    exact_brdf(pair, result);
}

void HeTorranceSpectrum::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    const std::size_t count = samples_.size();
    require_size("brdf", result.size(), count, pairs.size());
    const bool lanes_take_all = lanes_ && lanes_->brdf(pairs, result.data());
    if (lanes_take_all && lanes_->films.empty()) return;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto values = result.subspan(i * count, count);
        if (lanes_ && evaluation_detail::is_ordinary(pairs[i]))
            add_films(pairs[i], values);
        else
            exact_brdf(pairs[i], values);
    }
}

void HeTorranceSpectrum::specular_reflectance(const Direction& in, std::span<double> result) const {
    require_size("specular_reflectance", result.size(), samples_.size());
    if (!lanes_ || !lanes_->forms.specular_one(lanes_->prepared, in, result.data()))
        return exact_specular_reflectance(in, result);
    for (std::size_t i = 0; i < lanes_->films.size(); ++i) {
        if (samples_[i].index.coated())
            result[i] *= lanes_->films[i].amplitudes(in.cos_theta()).unpolarised_reflectance();
    }
}

void HeTorranceSpectrum::mueller(const DirectionPair& pair, std::span<Mueller> result) const {
    require_size("mueller", result.size(), samples_.size());
    if (lanes_ && lanes_->films.empty() && lanes_->forms.mueller_one(lanes_->prepared, pair, result.data()))
        return;
    if (!lanes_ || !lanes_->all_coated || !lanes_->mueller_of_films(pair, samples_, result))
        exact_mueller(pair, result);
}

void HeTorranceSpectrum::specular_mueller(const Direction& in, std::span<Mueller> result) const {
    require_size("specular_mueller", result.size(), samples_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const SpectralSample& sample = samples_[i];
        result[i] = hts::specular_mueller(surface_, hts::view(seen(i), in), sample.wavelength, sample.index);
    }
}

ScatteringLobe HeTorranceSpectrum::scattering_lobe() const {
    const SpectralSample& sample = samples_.front();
    const HeTorranceSpectrum lobe{
        surface_, {{sample.wavelength, sample.index, 0}}, Tolerance{accuracy::finest_lane_tolerance}};
    return {.wave_number = sample.wavelength.wave_number(),
            .surface = surface_,
            .diffuse_albedo = sample.uniform_diffuse * std::numbers::pi,
            .brdf =
                [lobe](const DirectionPair& pair) {
                    double value = 0;
                    lobe.brdf(pair, {&value, 1});
                    return value;
                },
            .mirror =
                [lobe](const Direction& in) {
                    double value = 0;
                    lobe.exact_specular_reflectance(in, {&value, 1});
                    return value;
                },
            .effective_roughness =
                [surface = seen(0)](const Direction& in) {
                    return surface.rms_roughness() *
                           effective_roughness_ratio(2 * visibility(surface, in).obstruction);
                }};
}

/// What the lanes leave out, where they took the pair.
void HeTorranceSpectrum::add_films(const DirectionPair& pair, std::span<double> result) const noexcept {
    if (lanes_->films.empty()) return;
    const double cos_theta_d = wave_vector_change(pair.in, pair.out).cos_theta_d();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const SpectralSample& sample = samples_[i];
        if (!sample.index.coated()) continue;
        result[i] = sample.uniform_diffuse +
                    result[i] * lanes_->films[i].amplitudes(cos_theta_d).unpolarised_reflectance();
    }
}

void HeTorranceSpectrum::exact_brdf(const DirectionPair& pair, std::span<double> result) const noexcept {
    std::transform(samples_.begin(), samples_.end(), result.begin(),
                   [](const SpectralSample& sample) { return sample.uniform_diffuse; });
    if (lobe_ == DiffuseLobe::none) return;
    PairFactors shared = factors(pair, 0);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const SpectralSample& sample = samples_[i];
        if (i > 0 && !seen_.empty()) shared = factors(pair, i);
        result[i] += directional_diffuse(shared, sample.wavelength, sample.index, lobe_).brdf;
    }
}

void HeTorranceSpectrum::exact_specular_reflectance(const Direction& in,
                                                    std::span<double> result) const noexcept {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const SpectralSample& sample = samples_[i];
        result[i] =
            hts::specular_reflectance(surface_, hts::view(seen(i), in), sample.wavelength, sample.index)
                .value();
    }
}

void HeTorranceSpectrum::exact_mueller(const DirectionPair& pair, std::span<Mueller> result) const noexcept {
    PairFactors shared = factors(pair, 0);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const SpectralSample& sample = samples_[i];
        if (i > 0 && !seen_.empty()) shared = factors(pair, i);
        const Mueller uniform = Mueller::depolariser(sample.uniform_diffuse);
        if (lobe_ == DiffuseLobe::none) {
            result[i] = uniform;
            continue;
        }
        result[i] = directional_diffuse_mueller(
            pair.in, pair.out, directional_diffuse(shared, sample.wavelength, sample.index, lobe_));
        if (sample.uniform_diffuse != 0) result[i] = result[i] + uniform;  // else zeros keep their signs
    }
}

}  // namespace hts
