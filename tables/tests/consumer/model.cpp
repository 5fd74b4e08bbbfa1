// Adds a model to those that material files may name, with installed headers alone:
// Minnaert's limb darkening.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <spectral/spectral.hpp>

namespace {

/// f = albedo (k + 1)/(2 pi) (cos theta_i cos theta_r)^(k - 1); albedo is that of light along the normal.
class Minnaert {
  public:
    Minnaert(double albedo, double exponent) : albedo_{albedo}, exponent_{exponent} {
        if (!(albedo >= 0 && albedo <= 1)) throw hts::out_of_range("albedo", albedo, "", "0 ... 1");
        if (!(exponent >= 1 && exponent <= 10)) throw hts::out_of_range("exponent", exponent, "", "1 ... 10");
    }

    [[nodiscard]] double brdf(const hts::Direction& in, const hts::Direction& out) const noexcept {
        const double cosines = in.cos_theta() * out.cos_theta();
        if (cosines <= 0) return 0;
        return albedo_ * (exponent_ + 1) * std::numbers::inv_pi / 2 * std::pow(cosines, exponent_ - 1);
    }
    [[nodiscard]] double pdf(const hts::Direction& in, const hts::Direction& out) const noexcept {
        return in.cos_theta() > 0 ? out.cos_theta() * std::numbers::inv_pi : 0;
    }
    [[nodiscard]] hts::Draw sample(const hts::Direction& in, const hts::Uniforms& u) const noexcept {
        if (in.cos_theta() <= 0 || u[0] == 0) return hts::Draw::none(in);
        const double sine = std::sqrt(1 - u[0]), turn = 2 * std::numbers::pi * u[1];
        const auto out =
            hts::Direction::from_unit_vector({sine * std::cos(turn), sine * std::sin(turn), std::sqrt(u[0])});
        return {out, std::numbers::pi * brdf(in, out), pdf(in, out)};
    }

  private:
    double albedo_, exponent_;
};

}  // namespace

int main() {
    using namespace hts::spectral;
    auto models = built_in_models();
    models.push_back(
        model_of_numbers<Minnaert>("minnaert", "Minnaert 1941", {{"albedo", 0.5}, {"exponent", 1}}));
    const Material moon = material_from_text(
        R"({"name": "moon", "model": "minnaert", "albedo": 0.12, "exponent": 1.4})", "moon.json", models);
    const Reflectance reflectance = moon.at(WavelengthGrid::linear(0.4, 0.7, 2));
    const auto up = hts::Direction::from_degrees(0, 0);
    const double expected = 0.12 * 2.4 * std::numbers::inv_pi / 2, found = reflectance.brdf({up, up})[1];
    std::printf("%s, %s: %.6f /sr\n", moon.name().c_str(), moon.model_source().c_str(), found);
    return std::abs(found - expected) < 1e-12 ? 0 : 1;
}
