#include "tables/spectral_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "spectral/random_directions.hpp"
#include "spectral/reflectance.hpp"

namespace hts::tables {
namespace {

class HeTorranceBrdf final : public SpectralBrdf {
  public:
    HeTorranceBrdf(const spectral::Reflector& reflector, const spectral::WavelengthGrid& wavelengths,
                   spectral::OutsideRange policy, Tolerance tolerance)
        : SpectralBrdf{reflector.name, wavelengths},
          reflectance_{reflector, wavelengths, policy, tolerance},
          lobe_{reflector.surface, without_uniform_diffuse(reflectance_.prepared()), tolerance} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        reflectance_.prepared().brdf(pair, values);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        reflectance_.prepared().specular_reflectance(in, values);
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::transform(reflectance_.prepared().samples(), values.begin(),
                               &SpectralSample::uniform_diffuse);
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        lobe_.brdf(pair, values);
    }
    [[nodiscard]] bool polarised() const noexcept override { return true; }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        reflectance_.prepared().mueller(pair, values);
    }

  private:
    [[nodiscard]] static std::vector<SpectralSample> without_uniform_diffuse(
        const PreparedReflectance& prepared) {
        std::vector<SpectralSample> samples{prepared.samples().begin(), prepared.samples().end()};
        for (SpectralSample& sample : samples) sample.uniform_diffuse = 0;
        return samples;
    }

    spectral::SpectralReflectance reflectance_;
    PreparedReflectance lobe_;
};

class ModelBrdf final : public SpectralBrdf {
  public:
    ModelBrdf(const spectral::AnyReflector& reflector, const spectral::WavelengthGrid& wavelengths,
              spectral::OutsideRange policy)
        : SpectralBrdf{reflector.name(), wavelengths}, spectrum_{reflector.spectrum(wavelengths, policy)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        spectrum_.brdf(pair, values);
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        std::ranges::copy(spectrum_.uniform_diffuse(), values.begin());
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        spectrum_.directional_diffuse(pair, values);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        spectrum_.specular_reflectance(in, values);
    }

  private:
    spectral::AnySpectrum spectrum_;
};

Direction turned(const Direction& direction, double cosine, double sine) {
    const Vector3 v = direction.vector();
    return Direction::from_unit_vector({cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z});
}

/// Largest relative change of the BRDF over random pairs when each becomes changed(pair, random angle).
template <class Change>
double largest_change(const SpectralBrdf& brdf, Change&& changed) {
    constexpr int pairs = 256;
    std::mt19937_64 random{1};
    std::vector<double> before(brdf.wavelengths().size()), after(before.size());
    double worst = 0;
    for (int i = 0; i < pairs; ++i) {
        const Direction in = spectral::random_direction(random, 0.1);
        const DirectionPair pair{in, spectral::random_direction(random, 0.1)};
        const double turn = 2 * std::numbers::pi * spectral::uniform(random);
        brdf.brdf(pair, before);
        brdf.brdf(changed(pair, turn), after);
        for (std::size_t k = 0; k < before.size(); ++k) {
            const double larger = std::max(before[k], after[k]);
            if (larger > 1e-12) worst = std::max(worst, std::abs(before[k] - after[k]) / larger);
        }
    }
    return worst;
}

}  // namespace

SpectralBrdf::SpectralBrdf(std::string name, spectral::WavelengthGrid wavelengths)
    : name_{std::move(name)}, wavelengths_{std::move(wavelengths)} {}

void SpectralBrdf::uniform_diffuse(std::span<double> values) const noexcept {
    std::ranges::fill(values, 0.0);
}

void SpectralBrdf::directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept {
    brdf(pair, values);
}

void SpectralBrdf::mueller(const DirectionPair& /*pair*/, std::span<Mueller> values) const noexcept {
    std::ranges::fill(values, Mueller{});
}

std::unique_ptr<SpectralBrdf> model_brdf(const spectral::AnyReflector& reflector,
                                         const spectral::WavelengthGrid& wavelengths,
                                         spectral::OutsideRange policy, Tolerance tolerance) {
    if (const spectral::Reflector* he = reflector.he_torrance()) {
        return std::make_unique<HeTorranceBrdf>(*he, wavelengths, policy, tolerance);
    }
    return std::make_unique<ModelBrdf>(reflector, wavelengths, policy);
}

double anisotropy(const SpectralBrdf& brdf) {
    return largest_change(brdf, [](const DirectionPair& pair, double turn) {
        const double cosine = std::cos(turn), sine = std::sin(turn);
        return DirectionPair{turned(pair.in, cosine, sine), turned(pair.out, cosine, sine)};
    });
}

bool is_isotropic(const SpectralBrdf& brdf) {
    return anisotropy(brdf) < 1e-6;
}

double irreciprocity(const SpectralBrdf& brdf) {
    return largest_change(brdf, [](const DirectionPair& pair, double /*turn*/) {
        return DirectionPair{pair.out, pair.in};
    });
}

}  // namespace hts::tables
