#include "tables/formats/specular_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "tables/formats/lobe.hpp"

namespace hts::tables {
namespace {

constexpr double least_solid_angle = 1e-9, most_solid_angle = 1;

void require_solid_angle(double solid_angle) {
    if (!(solid_angle >= least_solid_angle && solid_angle <= most_solid_angle))
        throw out_of_range("solid angle of the specular box", solid_angle, "sr", "from 1e-9 to 1 sr");
}

class SpecularBox final : public spectral::Evaluator {
  public:
    SpecularBox(spectral::Reflectance brdf, double solid_angle)
        : spectral::Evaluator{brdf.name(), brdf.wavelengths()},
          brdf_{std::move(brdf)},
          half_chord_squared_{solid_angle / (4 * std::numbers::pi)},
          scale_{1 / (solid_angle * (1 - half_chord_squared_))} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        brdf_.evaluator().brdf(pair, values);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0) || !inside(pair)) return;
        static thread_local std::vector<double> specular;  // grows once
        specular.resize(values.size());
        brdf_.evaluator().specular_reflectance(pair.in, specular);
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

    spectral::Reflectance brdf_;
    double half_chord_squared_;  // sin^2(delta/2)
    double scale_;               // 1/(pi sin^2 delta) = 1/(solid angle (1 - sin^2(delta/2)))
};

class SpecularLobe final : public spectral::Evaluator {
  public:
    SpecularLobe(spectral::Reflectance brdf, double solid_angle)
        : spectral::Evaluator{brdf.name(), brdf.wavelengths()},
          brdf_{std::move(brdf)},
          width_{squared_sine(solid_angle)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        brdf_.evaluator().brdf(pair, values);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return;
        const Vector3 m = bisector(pair);
        const double q = (m.x * m.x + m.y * m.y) / (2 * (1 + m.z) * width_);
        if (!(q < 1)) return;
        static thread_local std::vector<double> specular;  // grows once
        specular.resize(values.size());
        brdf_.evaluator().specular_reflectance(pair.in, specular);
        const double scale = 3 * (1 - q) * (1 - q) / (4 * std::numbers::pi * width_) /
                             (4 * dot(pair.in.vector(), m) * pair.out.cos_theta());
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += scale * specular[k];
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0.0);
    }

    /// h of a solid angle.
    static double squared_sine(double solid_angle) noexcept {
        return 3 * solid_angle / (16 * std::numbers::pi);
    }

  private:
    spectral::Reflectance brdf_;
    double width_;
};

}  // namespace

double specular_box_half_angle(double solid_angle) {
    require_solid_angle(solid_angle);
    return 2 * std::asin(std::sqrt(solid_angle / (4 * std::numbers::pi)));
}

double specular_lobe_tilt(double solid_angle) {
    return 2 * std::asin(std::sqrt(SpecularLobe::squared_sine(solid_angle)));
}

spectral::Reflectance with_specular_lobe(spectral::Reflectance brdf, double solid_angle) {
    require_solid_angle(solid_angle);
    return spectral::Reflectance{std::make_shared<const SpecularLobe>(std::move(brdf), solid_angle)};
}

spectral::Reflectance with_specular_box(spectral::Reflectance brdf, double solid_angle) {
    require_solid_angle(solid_angle);
    return spectral::Reflectance{std::make_shared<const SpecularBox>(std::move(brdf), solid_angle)};
}

}  // namespace hts::tables
