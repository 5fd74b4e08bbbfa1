#include "hts/sampling/lobe_sampler.hpp"

#include <limits>
#include <vector>

#include "hts/sampling/simd.hpp"

namespace hts {
namespace {

namespace detail = sampling_detail;
using detail::Light;
using detail::Mixture;

Light light(const Direction& in) {
    return {in.cos_theta(), in.sin_theta()};
}

}  // namespace

struct LobeSampler::Fitted {
    Surface surface;
    std::vector<Mixture> mixtures;
    detail::Forms forms;

    [[nodiscard]] const Mixture& at(const Direction& in) const noexcept {
        const std::size_t azimuth = surface.isotropic() ? 0 : detail::azimuth_index(surface, in);
        return mixtures[azimuth * detail::mixture_count + detail::mixture_index(in.cos_theta())];
    }
};

LobeSampler::LobeSampler(const ScatteringLobe& lobe)
    : fitted_{std::make_shared<const Fitted>(
          Fitted{lobe.surface, detail::fitted_mixtures(lobe), detail::forms()})} {}

std::size_t LobeSampler::bytes() const noexcept {
    return sizeof *this + sizeof(Fitted) + fitted_->mixtures.size() * sizeof(Mixture);
}

double LobeSampler::specular_probability(const Direction& in) const noexcept {
    return fitted_->at(in).share(detail::specular);
}

double LobeSampler::pdf(const Direction& in, const Direction& out) const noexcept {
    const Surface& surface = fitted_->surface;
    if (surface.isotropic()) return fitted_->forms.pdf(fitted_->mixtures.data(), in, out);
    if (!(out.cos_theta() > 0)) return 0;
    return fitted_->forms.stretched_density(fitted_->at(in), {surface, in}, detail::into_frame(in, out));
}

Draw LobeSampler::draw(const Direction& in, const Uniforms& u) const noexcept {
    constexpr double not_evaluated = std::numeric_limits<double>::quiet_NaN();
    const Mixture& mixture = fitted_->at(in);
    const detail::Drawn drawn = fitted_->surface.isotropic()
                                    ? fitted_->forms.draw(mixture, light(in), u)
                                    : fitted_->forms.stretched_draw(mixture, {fitted_->surface, in}, u);
    if (drawn.part == detail::specular)
        return {in.mirror(), not_evaluated, mixture.share(detail::specular), Lobe::specular};
    if (!(drawn.out.z > 0)) return Draw::none(in);
    return {Direction::from_unit_vector(detail::out_of_frame(in, drawn.out)), not_evaluated, drawn.pdf,
            drawn.part == detail::uniform_diffuse ? Lobe::uniform_diffuse : Lobe::directional_diffuse};
}

}  // namespace hts
