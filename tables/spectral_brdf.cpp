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
                   spectral::OutsideRange policy)
        : SpectralBrdf{reflector.name, wavelengths}, reflectance_{reflector, wavelengths, policy} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        reflectance_.prepared().brdf(pair, values);
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        reflectance_.prepared().specular_reflectance(in, values);
    }
    [[nodiscard]] bool polarised() const noexcept override { return true; }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        reflectance_.prepared().mueller(pair, values);
    }

  private:
    spectral::SpectralReflectance reflectance_;
};

class ModelBrdf final : public SpectralBrdf {
  public:
    ModelBrdf(const spectral::AnyReflector& reflector, const spectral::WavelengthGrid& wavelengths,
              spectral::OutsideRange policy)
        : SpectralBrdf{reflector.name(), wavelengths}, models_{reflector.at(wavelengths, policy)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        std::ranges::transform(models_, values.begin(), [&](const spectral::AnyModel& model) {
            return model.brdf(pair.in, pair.out);
        });
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        std::ranges::transform(models_, values.begin(), [&](const spectral::AnyModel& model) {
            return model.specular_reflectance(in).value();
        });
    }

  private:
    std::vector<spectral::AnyModel> models_;
};

Direction turned(const Direction& direction, double cosine, double sine) {
    const Vector3 v = direction.vector();
    return Direction::from_unit_vector({cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z});
}

}  // namespace

SpectralBrdf::SpectralBrdf(std::string name, spectral::WavelengthGrid wavelengths)
    : name_{std::move(name)}, wavelengths_{std::move(wavelengths)} {}

void SpectralBrdf::mueller(const DirectionPair& /*pair*/, std::span<Mueller> values) const noexcept {
    std::ranges::fill(values, Mueller{});
}

std::unique_ptr<SpectralBrdf> model_brdf(const spectral::AnyReflector& reflector,
                                         const spectral::WavelengthGrid& wavelengths,
                                         spectral::OutsideRange policy) {
    if (const spectral::Reflector* he = reflector.he_torrance()) {
        return std::make_unique<HeTorranceBrdf>(*he, wavelengths, policy);
    }
    return std::make_unique<ModelBrdf>(reflector, wavelengths, policy);
}

double anisotropy(const SpectralBrdf& brdf) {
    constexpr int pairs = 256;
    std::mt19937_64 random{1};
    std::vector<double> before(brdf.wavelengths().size()), after(before.size());
    double worst = 0;
    for (int i = 0; i < pairs; ++i) {
        const DirectionPair pair{spectral::random_direction(random, 0.1),
                                 spectral::random_direction(random, 0.1)};
        const double turn = 2 * std::numbers::pi * spectral::uniform(random);
        const double cosine = std::cos(turn), sine = std::sin(turn);
        brdf.brdf(pair, before);
        brdf.brdf({turned(pair.in, cosine, sine), turned(pair.out, cosine, sine)}, after);
        for (std::size_t k = 0; k < before.size(); ++k) {
            const double larger = std::max(before[k], after[k]);
            if (larger > 1e-12) worst = std::max(worst, std::abs(before[k] - after[k]) / larger);
        }
    }
    return worst;
}

bool is_isotropic(const SpectralBrdf& brdf) {
    return anisotropy(brdf) < 1e-6;
}

}  // namespace hts::tables
