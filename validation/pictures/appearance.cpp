#include "validation/pictures/appearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "hts/microfacet/lobes.hpp"
#include "spectral/models/reflectance.hpp"
#include "validation/pictures/evenly.hpp"

namespace hts::validation {
namespace {

/// Blue, green and red: those that draw.
constexpr std::array<std::size_t, 3> drawing_bands{5, 15, 25};

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

struct Appearance::Face {
    virtual ~Face() = default;
    virtual void brdf(std::span<const DirectionPair> pairs, std::span<Spectrum> result) const noexcept = 0;
    [[nodiscard]] virtual Spectrum specular_reflectance(const Direction& in) const noexcept = 0;
    [[nodiscard]] virtual bool has_specular() const noexcept = 0;
    /// Albedo of the part that is the same for all directions, as far as it is known apart.
    [[nodiscard]] virtual Spectrum uniform_albedo() const noexcept = 0;
    [[nodiscard]] virtual SpectralDraw draw(const Direction& in,
                                            const std::array<double, 4>& u) const noexcept = 0;
    [[nodiscard]] virtual double pdf(const Direction& in, const Direction& out) const noexcept = 0;
};

/// In vector lanes, all wavelengths of many pairs at once.
class Appearance::HeTorrance final : public Face {
  public:
    explicit HeTorrance(const spectral::Reflector& reflector)
        : prepared_{
              reflector.surface,
              spectral::spectral_samples(reflector, picture_wavelengths(), spectral::OutsideRange::clamp),
              Tolerance{accuracy::rendered_brdf}} {
        for (const std::size_t band : drawing_bands) {
            samplers_.emplace_back(reflector.surface, prepared_.samples()[band], prepared_.tolerance());
        }
    }

    void brdf(std::span<const DirectionPair> pairs, std::span<Spectrum> result) const noexcept override {
        static_assert(sizeof(Spectrum) == bands * sizeof(double));
        prepared_.brdf(pairs, {result.front().values.data(), pairs.size() * bands});
    }
    [[nodiscard]] Spectrum specular_reflectance(const Direction& in) const noexcept override {
        const View view = hts::view(prepared_.surface(), in);
        Spectrum result;
        for (std::size_t i = 0; i < bands; ++i) {
            const SpectralSample& sample = prepared_.samples()[i];
            result.values[i] =
                hts::specular_reflectance(prepared_.surface(), view, sample.wavelength, sample.index).value();
        }
        return result;
    }
    [[nodiscard]] bool has_specular() const noexcept override { return true; }
    [[nodiscard]] Spectrum uniform_albedo() const noexcept override {
        Spectrum result;
        for (std::size_t i = 0; i < bands; ++i) {
            result.values[i] = std::numbers::pi * prepared_.samples()[i].uniform_diffuse;
        }
        return result;
    }
    [[nodiscard]] SpectralDraw draw(const Direction& in,
                                    const std::array<double, 4>& u) const noexcept override {
        const auto chosen = static_cast<std::size_t>(u[3] * static_cast<double>(samplers_.size()));
        const DirectionDraw drawn = samplers_[chosen].draw(in, {u[0], u[1], u[2]});
        if (drawn.lobe == Lobe::none) return {drawn.out, drawn.lobe, 0};
        if (drawn.lobe == Lobe::specular) return {drawn.out, drawn.lobe, specular_probability(in)};
        return {drawn.out, drawn.lobe, pdf(in, drawn.out)};
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        double sum = 0;
        for (const DirectionSampler& sampler : samplers_) sum += sampler.pdf(in, out);
        return sum / static_cast<double>(samplers_.size());
    }

  private:
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept {
        double sum = 0;
        for (const DirectionSampler& sampler : samplers_) sum += sampler.specular_probability(in);
        return sum / static_cast<double>(samplers_.size());
    }

    PreparedReflectance prepared_;
    std::vector<DirectionSampler> samplers_;
};

/// All wavelengths of a pair at once.
class Appearance::Other final : public Face {
  public:
    explicit Other(const spectral::AnyReflector& reflector)
        : spectrum_{reflector.spectrum(picture_wavelengths(), spectral::OutsideRange::clamp)} {}

    void brdf(std::span<const DirectionPair> pairs, std::span<Spectrum> result) const noexcept override {
        for (std::size_t k = 0; k < pairs.size(); ++k) spectrum_.brdf(pairs[k], result[k].values);
    }
    [[nodiscard]] Spectrum specular_reflectance(const Direction& /*in*/) const noexcept override {
        return {};
    }
    [[nodiscard]] bool has_specular() const noexcept override { return false; }
    [[nodiscard]] Spectrum uniform_albedo() const noexcept override { return {}; }
    [[nodiscard]] SpectralDraw draw(const Direction& in,
                                    const std::array<double, 4>& u) const noexcept override {
        const auto chosen = static_cast<std::size_t>(u[3] * static_cast<double>(drawing_bands.size()));
        const WeightedDirection drawn =
            spectrum_.models()[drawing_bands[chosen]].sample(in, {u[0], u[1], u[2]});
        if (drawn.lobe == Lobe::none) return {drawn.out, drawn.lobe, 0};
        return {drawn.out, drawn.lobe, pdf(in, drawn.out)};
    }
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept override {
        double sum = 0;
        for (const std::size_t band : drawing_bands) sum += spectrum_.models()[band].pdf(in, out);
        return sum / static_cast<double>(drawing_bands.size());
    }

  private:
    spectral::AnySpectrum spectrum_;
};

namespace {

/// Mean over incident light from everywhere of what the diffuse lobes reflect: the uniform part and, by evenly spread draws,
/// the rest.
Spectrum average_albedo(const Appearance& appearance, const Spectrum& uniform) {
    constexpr std::uint32_t draws = 8192;
    Spectrum sum = uniform;
    for (std::uint32_t i = 0; i < draws; ++i) {
        const auto [a, b] = even_point(stream(1, 0, 0), i);
        const auto [c, d] = even_point(stream(1, 0, 1), i);
        const auto [e, f] = even_point(stream(1, 0, 2), i);
        const Direction in = Direction::from_vector(cosine_vector(a, b));
        const SpectralDraw drawn = appearance.draw(in, {c, d, e, f});
        if (!(drawn.pdf > 0) || drawn.lobe == Lobe::specular) continue;
        const double weight = drawn.out.cos_theta() / (drawn.pdf * draws);
        sum.add(weight, appearance.brdf({in, drawn.out}));
        sum.add(-weight / std::numbers::pi, uniform);
    }
    return sum;
}

}  // namespace

Appearance::Appearance(const spectral::AnyReflector& reflector) {
    if (const spectral::Reflector* he = reflector.he_torrance()) {
        face_ = std::make_shared<const HeTorrance>(*he);
    } else {
        face_ = std::make_shared<const Other>(reflector);
    }
    diffuse_albedo_ = average_albedo(*this, face_->uniform_albedo());
}

Spectrum Appearance::brdf(const DirectionPair& pair) const noexcept {
    Spectrum result;
    face_->brdf({&pair, 1}, {&result, 1});
    return result;
}

void Appearance::brdf(std::span<const DirectionPair> pairs, std::span<Spectrum> result) const noexcept {
    if (!pairs.empty()) face_->brdf(pairs, result);
}

Spectrum Appearance::specular_reflectance(const Direction& in) const noexcept {
    return face_->specular_reflectance(in);
}

bool Appearance::has_specular() const noexcept {
    return face_->has_specular();
}

SpectralDraw Appearance::draw(const Direction& in, const std::array<double, 4>& u) const noexcept {
    return face_->draw(in, u);
}

double Appearance::pdf(const Direction& in, const Direction& out) const noexcept {
    return face_->pdf(in, out);
}

}  // namespace hts::validation
