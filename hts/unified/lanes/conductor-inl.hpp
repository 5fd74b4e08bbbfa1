// The shortcut of metals in lanes: |F|^2 of the facet times the lobe of a perfect conductor, whose matrices
// are real; included once per instruction set.
#if defined(HTS_UNIFIED_CONDUCTOR_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_UNIFIED_CONDUCTOR_INL
#undef HTS_UNIFIED_CONDUCTOR_INL
#else
#define HTS_UNIFIED_CONDUCTOR_INL
#endif

#include "hts/unified/lanes/unified_kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// What multiplies Phi of unpolarised light: (|M_c|^2 |F|^2/|d|^2) G/(c_i c_r), M_c of a perfect conductor
/// over c_i + c_r. All its divisions are one.
///   f      of the facet
///   mean   H of kicks_table.hpp
template <class Lanes, class V>
HWY_INLINE V conductor_scale(const Lanes& o, const UnifiedPair<V>& pair, const evaluation::FresnelTerms<V>& f,
                             V horizon, V lift, V returned, V mean) {
    const V one = o.real(1), all = one + mean;  // beta = 1/all, w = mean/all
    const V in_horizon = fourth_power_less_one(o, horizon * pair[cos_in]);
    const V out_horizon = fourth_power_less_one(o, horizon * pair[cos_out]);
    const V outer = all * ((one + in_horizon) * (one + out_horizon));
    const V spread = o.mul_add(all, pair[cosines], mean * pair[masked]);
    const V lifted_in = pair[cos_in] + lift, lifted_out = pair[cos_out] + lift;
    const V lifted = lifted_in * lifted_out, facet = f.s_below * f.s_below * f.p_below;
    const V shares = outer * spread, rest = lifted * facet;
    const V over = one / (shares * rest);
    const V over_lifted = over * (shares * facet);
    const V share = mean * (in_horizon * out_horizon) * (over * (spread * rest));

    const V kirchhoff_part = share * pair[kirchhoff], bragg_part = (one - share) * pair[bragg];
    const V parallel = kirchhoff_part * (pair[ss_of_p] - pair[ss_of_s]);
    const V turned = kirchhoff_part * (pair[sp_of_s] + pair[ps_of_s]);
    const V across = bragg_part * pair[sin_phi] * over_lifted;
    const V ss = o.neg_mul_add(bragg_part, pair[cos_phi], parallel);
    const V pp = o.neg_mul_add(bragg_part * over_lifted, pair[bend], o.real(0) - parallel);
    const V sp = o.mul_add(across, lifted_out, turned), ps = o.mul_add(across, lifted_in, turned);
    const V squared = o.mul_add(ss, ss, pp * pp) + o.mul_add(sp, sp, ps * ps);
    const V shadowed = o.mul_add(returned * mean, pair[returns], all) * (over * (outer * lifted));
    return o.real(0.5) * squared * f.p_mean * shadowed;
}

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
