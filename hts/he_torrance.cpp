#include "hts/he_torrance.hpp"

#include <limits>

#include "hts/sampling/simd.hpp"

namespace hts {
namespace {

namespace detail = sampling_detail;
using detail::Light;
using detail::Mixture;

Light light(const Direction& in) {
    return {in.cos_theta(), in.sin_theta()};
}

Direction out_of_frame(const Direction& in, Vector3 v) {
    return Direction::from_unit_vector(
        {v.x * in.cos_phi() - v.y * in.sin_phi(), v.x * in.sin_phi() + v.y * in.cos_phi(), v.z});
}

}  // namespace

struct HeTorrance::Sampler {
    std::vector<Mixture> mixtures;
    detail::Forms forms;

    [[nodiscard]] const Mixture& at(const Direction& in) const noexcept {
        return mixtures[detail::mixture_index(in.cos_theta())];
    }
};

HeTorrance::HeTorrance(const Surface& surface, const SpectralSample& sample, Tolerance tolerance)
    : spectrum_{surface, {sample}, tolerance},
      sampler_{std::make_shared<const Sampler>(
          Sampler{detail::fitted_mixtures(surface, sample), detail::forms()})} {}

std::size_t HeTorrance::bytes() const noexcept {
    return sizeof *this - sizeof spectrum_ + spectrum_.bytes() + sizeof(Sampler) +
           sampler_->mixtures.size() * sizeof(Mixture);
}

double HeTorrance::specular_probability(const Direction& in) const noexcept {
    return sampler_->at(in).share(detail::specular);
}

double HeTorrance::pdf(const Direction& in, const Direction& out) const noexcept {
    return sampler_->forms.pdf(sampler_->mixtures.data(), in, out);
}

double HeTorrance::brdf(const Direction& in, const Direction& out) const noexcept {
    double value = 0;
    spectrum_.brdf({in, out}, {&value, 1});
    return value;
}

SpecularReflectance HeTorrance::specular_reflectance(const Direction& in) const noexcept {
    double value = 0;
    spectrum_.specular_reflectance(in, {&value, 1});
    return SpecularReflectance{value};
}

Mueller HeTorrance::mueller(const Direction& in, const Direction& out) const noexcept {
    Mueller value;
    spectrum_.mueller({in, out}, {&value, 1});
    return value;
}

Mueller HeTorrance::specular_mueller(const Direction& in) const noexcept {
    return hts::specular_mueller(surface(), view(surface(), in), at().wavelength, at().index);
}

Draw HeTorrance::draw(const Direction& in, const Uniforms& u) const noexcept {
    constexpr double not_evaluated = std::numeric_limits<double>::quiet_NaN();
    const Mixture& mixture = sampler_->at(in);
    const detail::Drawn drawn = sampler_->forms.draw(mixture, light(in), u);
    if (drawn.part == detail::specular)
        return {in.mirror(), not_evaluated, mixture.share(detail::specular), Lobe::specular};
    if (!(drawn.out.z > 0)) return Draw::none(in);
    return {out_of_frame(in, drawn.out), not_evaluated, drawn.pdf,
            drawn.part == detail::uniform_diffuse ? Lobe::uniform_diffuse : Lobe::directional_diffuse};
}

Draw HeTorrance::sample(const Direction& in, const Uniforms& u) const noexcept {
    Draw drawn = draw(in, u);
    if (drawn.lobe == Lobe::none) return drawn;
    const double value =
        drawn.lobe == Lobe::specular
            ? hts::specular_reflectance(surface(), view(surface(), in), at().wavelength, at().index).value()
            : brdf(in, drawn.out) * drawn.out.cos_theta();
    drawn.weight = value / drawn.pdf;
    return drawn;
}

}  // namespace hts
