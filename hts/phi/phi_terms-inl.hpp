// The terms of Phi for small g beyond its tables, where few of them count; included once per instruction set.
#if defined(HTS_PHI_TERMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_PHI_TERMS_INL
#undef HTS_PHI_TERMS_INL
#else
#define HTS_PHI_TERMS_INL
#endif

#include <cmath>
#include <cstddef>
#include <numbers>

#include "hts/lanes/polynomials-inl.hpp"
#include "hts/phi/phi_far.hpp"
#include "hts/phi/tables/phi_table.hpp"
#include "hts/phi/tables/terms.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::phi_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Beyond it Phi < 1e-287 for every g < 2^emin.
inline constexpr double largest_term_t = 15000;

/// Terms that count for g < 2^emin and t. There w = ln(m*/g) > 4.8, so the largest is at m* < sqrt(t/4.8) and
/// the width sqrt(m*/(1 + 2w)) < sqrt(m*/10); nine widths and three terms leave 1e-17.
HWY_INLINE double terms_that_count(double t) {
    const double peak = std::sqrt(t * (1 / 4.8));
    return peak + std::sqrt(peak * 8.1) + 3;
}

/// e^-g sum g^m/(m! m) e^(-t/m), every term that counts, a lane to a term.
template <class Spec>
HWY_INLINE double sum_of_terms(double g, double t) {
    constexpr hn::CappedTag<double, 8> d;
    constexpr hl::WideLanes<hn::CappedTag<double, 8> > o;
    constexpr std::size_t lanes = hn::MaxLanes(d);
    const auto log_g = o.real(std::log2(g));
    const auto t_bits = o.real(t * std::numbers::log2e);
    const auto scale = o.real(-g * std::numbers::log2e);
    const double count = std::fmin(terms_that_count(t), most_terms);
    auto m = hn::Iota(d, 1);
    auto sum = o.real(0);
    for (std::size_t i = 0; static_cast<double>(i) < count; i += lanes) {
        const auto power = o.mul_add(m, log_g, o.sub(scale, hn::Load(d, term_logs + i)));
        const auto exponent = o.neg_mul_add(t_bits, hn::Load(d, term_reciprocals + i), power);
        sum = o.add(sum, hl::scaled_exp2<Spec::exp_degree>(o, exponent, o.real(1)));
        m = o.add(m, o.real(lanes));
    }
    return hn::GetLane(hn::SumOfLanes(d, sum));
}

/// Phi where the table has no cell.
template <class Spec>
HWY_ATTR HWY_NOINLINE double phi_beyond_table(double g, double t) {
    constexpr double largest_g = lanes::power_of_2(Spec::emin);
    if (g > 0 && g < largest_g && t >= 0 && t < largest_term_t) return sum_of_terms<Spec>(g, t);
    return far_phi_value(g, t);
}

#endif

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
