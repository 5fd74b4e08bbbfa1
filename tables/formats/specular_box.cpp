#include "tables/formats/specular_box.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/error.hpp"

namespace hts::tables {
namespace {

constexpr double least_solid_angle = 1e-9, most_solid_angle = 1;

class SpecularBox final : public SpectralBrdf {
  public:
    SpecularBox(std::shared_ptr<const SpectralBrdf> brdf, double solid_angle)
        : SpectralBrdf{brdf->name(), brdf->wavelengths()},
          brdf_{std::move(brdf)},
          half_chord_squared_{solid_angle / (4 * std::numbers::pi)},
          scale_{1 / (solid_angle * (1 - half_chord_squared_))} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        brdf_->brdf(pair, values);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0) || !inside(pair)) return;
        static thread_local std::vector<double> specular;  // grows once
        specular.resize(values.size());
        brdf_->specular_reflectance(pair.in, specular);
        const double scale = scale_ / pair.in.cos_theta();
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += scale * specular[k];
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0.0);
    }

  private:
    /// By (|out - mirror|/2)^2 = sin^2(angle/2), which keeps small angles exact.
    [[nodiscard]] bool inside(const DirectionPair& pair) const noexcept {
        const Vector3 apart = pair.out.vector() - pair.in.mirror().vector();
        return dot(apart, apart) / 4 <= half_chord_squared_;
    }

    std::shared_ptr<const SpectralBrdf> brdf_;
    double half_chord_squared_;  // sin^2(delta/2)
    double scale_;               // 1/(pi sin^2 delta) = 1/(solid angle (1 - sin^2(delta/2)))
};

}  // namespace

std::unique_ptr<SpectralBrdf> with_specular_box(std::shared_ptr<const SpectralBrdf> brdf,
                                                double solid_angle) {
    if (!(solid_angle >= least_solid_angle && solid_angle <= most_solid_angle)) {
        throw out_of_range("solid angle of the specular box", solid_angle, "sr", "from 1e-9 to 1 sr");
    }
    return std::make_unique<SpecularBox>(std::move(brdf), solid_angle);
}

}  // namespace hts::tables
