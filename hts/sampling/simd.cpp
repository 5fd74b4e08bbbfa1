// The sampler, compiled for every instruction set and chosen at run time.
#include "hts/sampling/simd.hpp"

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
    return density(mixtures[mixture_index(in.cos_theta())], {in.cos_theta(), in.sin_theta()},
                   in_frame_of(in, out));
}

HWY_ATTR Drawn draw_of(const Mixture& mixture, const Light& light, const Uniforms& u) {
    return draw(mixture, light, u);
}

HWY_ATTR Vector3 draw_from_part(const Mixture& mixture, const Light& light, std::size_t part,
                                const Uniforms& u) {
    return drawn_from(mixture, light, part, u);
}

Forms form_table() {
    return {density_of, pdf, draw_of, draw_from_part};
}

}  // namespace hts::sampling_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::sampling_detail {

HWY_EXPORT(form_table);

const Forms& forms() noexcept {
    static const Forms best = HWY_DYNAMIC_DISPATCH(form_table)();
    return best;
}

}  // namespace hts::sampling_detail
#endif
