#include "hts/rendering/he_torrance_single.hpp"

#include <algorithm>
#include <utility>

#include "hts/evaluation/prepared.hpp"
#include "hts/evaluation/single_simd.hpp"

namespace hts {
namespace {

using evaluation_detail::require_size;

constexpr std::size_t drawing_wavelengths = 3;

Direction direction(const Vector3f& v) noexcept {
    return Direction::from_unit_vector({v.x, v.y, v.z});
}
Vector3f rounded(const Direction& direction) noexcept {
    const Vector3 v = direction.vector();
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
bool above(const Vector3f& v) noexcept {
    return v.z > 0;
}

}  // namespace

struct HeTorranceSingle::Data {
    HeTorranceSpectrum exact;  // for what single precision does not hold, and the specular term
    evaluation_detail::SingleForms forms{};
    evaluation_detail::PreparedSingle prepared{};

    Data(const Surface& surface, std::vector<SpectralSample> samples, DiffuseLobe lobe)
        : exact{surface, std::move(samples), Tolerance{}, lobe} {
        const auto held = exact.samples();
        const bool coated =
            std::ranges::any_of(held, [](const SpectralSample& sample) { return sample.index.coated(); });
        if (coated || lobe == DiffuseLobe::none || !evaluation_detail::fits_single(surface, held)) return;
        forms = evaluation_detail::single_forms(lobe);
        prepared = evaluation_detail::prepared_as<float>(surface, held);
    }

    [[nodiscard]] std::size_t size() const noexcept { return exact.samples().size(); }

    /// What compute(values) writes in double precision, rounded.
    template <class Compute>
    void round_doubles(float* result, const Compute& compute) const {
        constexpr std::size_t most = 64;  // beyond it memory is allocated
        std::array<double, most> few;
        std::vector<double> many(size() > most ? size() : 0);
        const std::span<double> values = size() > most ? std::span{many} : std::span{few}.first(size());
        compute(values);
        std::ranges::transform(values, result, [](double value) { return static_cast<float>(value); });
    }
    void brdf(const VectorPair& pair, float* result) const {
        if (forms.brdf_of_vectors != nullptr && forms.brdf_of_vectors(prepared, pair, result)) return;
        if (!(above(pair.in) && above(pair.out))) return static_cast<void>(std::fill_n(result, size(), 0.0F));
        round_doubles(result, [&](std::span<double> values) {
            exact.brdf({direction(pair.in), direction(pair.out)}, values);
        });
    }
};

HeTorranceSingle::HeTorranceSingle(const Surface& surface, std::vector<SpectralSample> samples,
                                   DiffuseLobe lobe)
    : data_{std::make_shared<const Data>(surface, std::move(samples), lobe)} {}

std::size_t HeTorranceSingle::size() const noexcept {
    return data_->size();
}

std::span<const SpectralSample> HeTorranceSingle::samples() const noexcept {
    return data_->exact.samples();
}

void HeTorranceSingle::brdf(const Vector3f& in, const Vector3f& out, std::span<float> result) const {
    require_size("brdf", result.size(), size());
    data_->brdf({in, out}, result.data());
}

void HeTorranceSingle::brdf(std::span<const VectorPair> pairs, std::span<float> result) const {
    require_size("brdf", result.size(), size(), pairs.size());
    const auto& many = data_->forms.brdf_of_many_vectors;
    if (many != nullptr && many(data_->prepared, pairs, result.data())) return;
    for (std::size_t i = 0; i < pairs.size(); ++i) data_->brdf(pairs[i], result.data() + i * size());
}

void HeTorranceSingle::specular_reflectance(const Vector3f& in, std::span<float> result) const {
    require_size("specular_reflectance", result.size(), size());
    if (!above(in)) return static_cast<void>(std::ranges::fill(result, 0.0F));
    data_->round_doubles(result.data(), [&](std::span<double> values) {
        data_->exact.specular_reflectance(direction(in), values);
    });
}

HeTorranceRendering::HeTorranceRendering(const Surface& surface, const std::vector<SpectralSample>& samples)
    : HeTorranceSingle{surface, samples} {
    for (std::size_t i = 0; i < drawing_wavelengths; ++i) {
        const SpectralSample& sample = samples[(2 * i + 1) * samples.size() / (2 * drawing_wavelengths)];
        samplers_.emplace_back(HeTorranceSpectrum{surface, {sample}}.scattering_lobe());
    }
}

float HeTorranceRendering::pdf(const Vector3f& in, const Vector3f& out) const noexcept {
    if (!(above(in) && above(out))) return 0;
    const Direction from = direction(in), to = direction(out);
    double sum = 0;
    for (const LobeSampler& sampler : samplers_) sum += sampler.pdf(from, to);
    return static_cast<float>(sum / drawing_wavelengths);
}

float HeTorranceRendering::brdf_and_pdf(const Vector3f& in, const Vector3f& out,
                                        std::span<float> result) const {
    brdf(in, out, result);
    return pdf(in, out);
}

SpectralDraw HeTorranceRendering::sample(const Vector3f& in, const std::array<float, 4>& u,
                                         std::span<float> result) const {
    require_size("sample", result.size(), size());
    const auto none = [&](const Vector3f& out) {
        std::ranges::fill(result, 0.0F);
        return SpectralDraw{out, 0, Lobe::none};
    };
    if (!above(in)) return none(in);
    const Direction from = direction(in);
    const std::size_t chosen = std::min(
        static_cast<std::size_t>(u[3] * static_cast<float>(drawing_wavelengths)), drawing_wavelengths - 1);
    const Draw drawn = samplers_[chosen].draw(from, {u[0], u[1], u[2]});
    const Vector3f out = rounded(drawn.out);
    if (drawn.lobe == Lobe::specular) {
        specular_reflectance(in, result);
        return {out, specular_probability(in), drawn.lobe};
    }
    if (drawn.lobe == Lobe::none || !above(out)) return none(out);
    brdf(in, out, result);
    double density = drawn.pdf;
    for (std::size_t i = 0; i < samplers_.size(); ++i) {
        if (i != chosen) density += samplers_[i].pdf(from, drawn.out);
    }
    return {out, static_cast<float>(density / drawing_wavelengths), drawn.lobe};
}

float HeTorranceRendering::specular_probability(const Vector3f& in) const noexcept {
    if (!above(in)) return 0;
    double sum = 0;
    for (const LobeSampler& sampler : samplers_) sum += sampler.specular_probability(direction(in));
    return static_cast<float>(sum / drawing_wavelengths);
}

}  // namespace hts
