#include "validation/pictures/appearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "hts/microfacet/lobes.hpp"
#include "spectral/parallel.hpp"
#include "validation/pictures/evenly.hpp"

namespace hts::validation {
namespace {

/// Blue, green and red: those that draw.
constexpr std::array<std::size_t, 3> drawing_bands{5, 15, 25};

spectral::Reflectance prepared(const spectral::Material& material, Tolerance tolerance,
                               spectral::OutsideRange outside) {
    if (outside == spectral::OutsideRange::error) outside = spectral::OutsideRange::hold;
    return material.at(picture_wavelengths(), {.tolerance = tolerance, .outside = outside});
}

}  // namespace

const spectral::WavelengthGrid& picture_wavelengths() {
    static const auto grid = spectral::WavelengthGrid::linear(0.40, 0.70, bands);
    return grid;
}

Spectrum Spectrum::grey(double value) noexcept {
    Spectrum result;
    result.values.fill(value);
    return result;
}

Spectrum& Spectrum::operator+=(const Spectrum& other) noexcept {
    for (std::size_t i = 0; i < bands; ++i) values[i] += other.values[i];
    return *this;
}

void Spectrum::add(double factor, const Spectrum& other) noexcept {
    for (std::size_t i = 0; i < bands; ++i) values[i] += factor * other.values[i];
}

void Spectrum::add(double factor, const Spectrum& one, const Spectrum& other) noexcept {
    for (std::size_t i = 0; i < bands; ++i) values[i] += factor * one.values[i] * other.values[i];
}

double Spectrum::mean() const noexcept {
    return std::accumulate(values.begin(), values.end(), 0.0) / bands;
}

double Spectrum::largest() const noexcept {
    return *std::max_element(values.begin(), values.end());
}

Spectrum operator*(const Spectrum& a, const Spectrum& b) noexcept {
    Spectrum result;
    for (std::size_t i = 0; i < bands; ++i) result.values[i] = a.values[i] * b.values[i];
    return result;
}

Spectrum operator*(double factor, const Spectrum& a) noexcept {
    Spectrum result;
    for (std::size_t i = 0; i < bands; ++i) result.values[i] = factor * a.values[i];
    return result;
}

namespace {

/// Mean over incident light from everywhere of what the diffuse lobes reflect: the uniform part and, by
/// evenly spread draws, the rest. Added up in their order, for any number of threads.
Spectrum average_albedo(const Appearance& appearance, const Spectrum& uniform) {
    constexpr std::uint32_t draws = 8192, at_once = 256;
    struct Drawn {
        double weight = 0;
        Spectrum brdf;
    };
    std::vector<Drawn> all(draws);
    spectral::parallel_blocks(draws, at_once, [&](std::size_t first, std::size_t number) {
        for (std::size_t i = first; i < first + number; ++i) {
            const auto place = static_cast<std::uint32_t>(i);
            const auto [a, b] = even_point(stream(1, 0, 0), place);
            const auto [c, d] = even_point(stream(1, 0, 1), place);
            const auto [e, f] = even_point(stream(1, 0, 2), place);
            const Direction in = Direction::from_vector(cosine_vector(a, b));
            const SpectralDraw drawn = appearance.draw(in, {c, d, e, f});
            if (!(drawn.pdf > 0) || drawn.lobe == Lobe::specular) continue;
            all[i] = {drawn.out.cos_theta() / (drawn.pdf * draws), appearance.brdf({in, drawn.out})};
        }
    });
    Spectrum sum = uniform;
    for (const auto& [weight, brdf] : all) {
        if (weight == 0) continue;
        sum.add(weight, brdf);
        sum.add(-weight / std::numbers::pi, uniform);
    }
    return sum;
}

}  // namespace

Appearance::Appearance(const spectral::Material& material, spectral::OutsideRange outside)
    : reflectance_{prepared(material, Tolerance{accuracy::rendered_brdf}, outside)},
      mirror_{prepared(material, Tolerance{accuracy::finest_tolerance}, outside)} {
    std::vector<std::optional<spectral::Sampler>> fitted(drawing_bands.size());
    spectral::parallel_for(fitted.size(),
                           [&](std::size_t i) { fitted[i] = reflectance_.sampler(drawing_bands[i]); });
    for (const auto& sampler : fitted) samplers_.push_back(*sampler);
    Spectrum uniform;
    reflectance_.uniform_diffuse(uniform.values);
    diffuse_albedo_ = average_albedo(*this, std::numbers::pi * uniform);
}

Spectrum Appearance::brdf(const DirectionPair& pair) const noexcept {
    Spectrum result;
    reflectance_.evaluator().brdf(pair, result.values);
    return result;
}

void Appearance::brdf(std::span<const DirectionPair> pairs, std::span<Spectrum> result) const noexcept {
    static_assert(sizeof(Spectrum) == bands * sizeof(double));
    if (!pairs.empty())
        reflectance_.evaluator().brdf_batch(pairs, {result.front().values.data(), pairs.size() * bands});
}

Spectrum Appearance::specular_reflectance(const Direction& in) const noexcept {
    Spectrum result;
    mirror_.evaluator().specular_reflectance(in, result.values);
    return result;
}

SpectralDraw Appearance::draw(const Direction& in, const std::array<double, 4>& u) const noexcept {
    const auto chosen = static_cast<std::size_t>(u[3] * static_cast<double>(samplers_.size()));
    const Draw drawn = samplers_[chosen].draw(in, {u[0], u[1], u[2]});
    if (drawn.lobe == Lobe::none) return {drawn.out, drawn.lobe, 0};
    if (drawn.lobe == Lobe::specular) return {drawn.out, drawn.lobe, specular_probability(in)};
    return {drawn.out, drawn.lobe, pdf(in, drawn.out)};
}

double Appearance::pdf(const Direction& in, const Direction& out) const noexcept {
    double sum = 0;
    for (const spectral::Sampler& sampler : samplers_) sum += sampler.pdf(in, out);
    return sum / static_cast<double>(samplers_.size());
}

double Appearance::specular_probability(const Direction& in) const noexcept {
    double sum = 0;
    for (const spectral::Sampler& sampler : samplers_) sum += sampler.specular_probability(in);
    return sum / static_cast<double>(samplers_.size());
}

}  // namespace hts::validation
