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

Direction out_of_frame(const Direction& in, Vector3 v) {
    return Direction::from_unit_vector(
        {v.x * in.cos_phi() - v.y * in.sin_phi(), v.x * in.sin_phi() + v.y * in.cos_phi(), v.z});
}

}  // namespace

struct LobeSampler::Fitted {
    std::vector<Mixture> mixtures;
    detail::Forms forms;

    [[nodiscard]] const Mixture& at(const Direction& in) const noexcept {
        return mixtures[detail::mixture_index(in.cos_theta())];
    }
};

LobeSampler::LobeSampler(const ScatteringLobe& lobe)
    : fitted_{std::make_shared<const Fitted>(Fitted{detail::fitted_mixtures(lobe), detail::forms()})} {}

std::size_t LobeSampler::bytes() const noexcept {
    return sizeof *this + sizeof(Fitted) + fitted_->mixtures.size() * sizeof(Mixture);
}

double LobeSampler::specular_probability(const Direction& in) const noexcept {
    return fitted_->at(in).share(detail::specular);
}

double LobeSampler::pdf(const Direction& in, const Direction& out) const noexcept {
    return fitted_->forms.pdf(fitted_->mixtures.data(), in, out);
}

Draw LobeSampler::draw(const Direction& in, const Uniforms& u) const noexcept {
    constexpr double not_evaluated = std::numeric_limits<double>::quiet_NaN();
    const Mixture& mixture = fitted_->at(in);
    const detail::Drawn drawn = fitted_->forms.draw(mixture, light(in), u);
    if (drawn.part == detail::specular)
        return {in.mirror(), not_evaluated, mixture.share(detail::specular), Lobe::specular};
    if (!(drawn.out.z > 0)) return Draw::none(in);
    return {out_of_frame(in, drawn.out), not_evaluated, drawn.pdf,
            drawn.part == detail::uniform_diffuse ? Lobe::uniform_diffuse : Lobe::directional_diffuse};
}

}  // namespace hts
