#include "hts/sampling.hpp"

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

const char* name(Lobe lobe) noexcept {
    switch (lobe) {
        case Lobe::none:
            return "none";
        case Lobe::specular:
            return "specular";
        case Lobe::directional_diffuse:
            return "directional_diffuse";
        case Lobe::uniform_diffuse:
            return "uniform_diffuse";
    }
    return "";
}

struct DirectionSampler::Prepared {
    std::vector<Mixture> mixtures;
    detail::Forms forms;

    [[nodiscard]] const Mixture& at(const Direction& in) const noexcept {
        return mixtures[detail::mixture_index(in.cos_theta())];
    }
};

DirectionSampler::DirectionSampler(const Surface& surface, const SpectralSample& sample, Tolerance tolerance)
    : reflectance_{surface, {sample}, tolerance},
      prepared_{std::make_shared<const Prepared>(
          Prepared{detail::fitted_mixtures(surface, sample), detail::forms()})} {}

std::size_t DirectionSampler::bytes() const noexcept {
    return sizeof *this - sizeof reflectance_ + reflectance_.bytes() + sizeof(Prepared) +
           prepared_->mixtures.size() * sizeof(Mixture);
}

double DirectionSampler::specular_probability(const Direction& in) const noexcept {
    return prepared_->at(in).share(detail::specular);
}

double DirectionSampler::pdf(const Direction& in, const Direction& out) const noexcept {
    return prepared_->forms.pdf(prepared_->mixtures.data(), in, out);
}

DirectionDraw DirectionSampler::draw(const Direction& in, const Uniforms& u) const noexcept {
    const Mixture& mixture = prepared_->at(in);
    const detail::Drawn drawn = prepared_->forms.draw(mixture, light(in), u);
    if (drawn.part == detail::specular) return {in.mirror(), Lobe::specular, mixture.share(detail::specular)};
    if (!(drawn.out.z > 0)) return {in.mirror(), Lobe::none, 0};
    return {out_of_frame(in, drawn.out),
            drawn.part == detail::uniform_diffuse ? Lobe::uniform_diffuse : Lobe::directional_diffuse,
            drawn.pdf};
}

WeightedDirection DirectionSampler::sample(const Direction& in, const Uniforms& u) const noexcept {
    const DirectionDraw drawn = draw(in, u);
    const auto& [out, lobe, pdf] = drawn;
    if (lobe == Lobe::none) return {out, lobe, 0, 0};
    double value = 0;
    if (lobe == Lobe::specular) {
        const SpectralSample& sample = reflectance_.samples().front();
        value = specular_reflectance(surface(), view(surface(), in), sample.wavelength, sample.index).value();
    } else {
        reflectance_.brdf({in, out}, {&value, 1});
        value *= out.cos_theta();
    }
    return {out, lobe, value / pdf, pdf};
}

}  // namespace hts
