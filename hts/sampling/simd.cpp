// The sampler, compiled for every instruction set and chosen at run time.
#include "hts/sampling/simd.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/sampling/simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/sampling/kernel-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::sampling_detail::HWY_NAMESPACE {

HWY_ATTR double density_of(const Mixture& mixture, const Light& light, Vector3 out) {
    return density(mixture, light, out);
}

HWY_ATTR double pdf(const Mixture* mixtures, const Direction& in, const Direction& out) {
    if (HWY_UNLIKELY(!(out.cos_theta() > 0))) return 0;
    return density(mixtures[mixture_index(in.cos_theta())], Light{in.cos_theta(), in.sin_theta()},
                   in_frame_of(in, out));
}

HWY_ATTR Drawn draw_of(const Mixture& mixture, const Light& light, const Uniforms& u) {
    return draw(mixture, light, u);
}

HWY_ATTR Vector3 draw_from_part(const Mixture& mixture, const Light& light, std::size_t part,
                                const Uniforms& u) {
    return drawn_from(mixture, light, part, u);
}

HWY_ATTR double stretched_density_of(const Mixture& mixture, const StretchedLight& light, Vector3 out) {
    return density(mixture, light, out);
}

HWY_ATTR Drawn stretched_draw_of(const Mixture& mixture, const StretchedLight& light, const Uniforms& u) {
    return draw(mixture, light, u);
}

HWY_ATTR Vector3 stretched_draw_from_part(const Mixture& mixture, const StretchedLight& light,
                                          std::size_t part, const Uniforms& u) {
    return drawn_from(mixture, light, part, u);
}

Forms form_table() {
    return {density_of,
            pdf,
            draw_of,
            draw_from_part,
            stretched_density_of,
            stretched_draw_of,
            stretched_draw_from_part};
}

}  // namespace hts::sampling_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::sampling_detail {

HWY_EXPORT(form_table);

StretchedLight::StretchedLight(const Surface& surface, const Direction& in) noexcept
    : Light{in.cos_theta(), in.sin_theta()} {
    const auto& [along, across] = surface.correlation_lengths();
    const double first = along / surface.correlation_length(), second = across / surface.correlation_length();
    const double c = in.cos_phi() * surface.axis().cos_phi() + in.sin_phi() * surface.axis().sin_phi();
    const double s = in.cos_phi() * surface.axis().sin_phi() - in.sin_phi() * surface.axis().cos_phi();
    xx = first * c * c + second * s * s;
    xy = (first - second) * c * s;
    yy = first * s * s + second * c * c;
    reach = std::hypot(xy, yy);
}

Vector3 out_of_frame(const Direction& in, Vector3 v) noexcept {
    return {v.x * in.cos_phi() - v.y * in.sin_phi(), v.x * in.sin_phi() + v.y * in.cos_phi(), v.z};
}

Vector3 into_frame(const Direction& in, const Direction& out) noexcept {
    const double along = out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi();
    return {out.sin_theta() * along, out.sin_theta() * sin_azimuth_between(in, out), out.cos_theta()};
}

const Forms& forms() noexcept {
    static const Forms best = HWY_DYNAMIC_DISPATCH(form_table)();
    return best;
}

}  // namespace hts::sampling_detail
#endif
