// Phi's limits for a block of items, in the manner of phi_block-inl.hpp; included once per instruction set.
#if defined(HTS_EVALUATION_LIMITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_LIMITS_INL
#undef HTS_EVALUATION_LIMITS_INL
#else
#define HTS_EVALUATION_LIMITS_INL
#endif

#include <cstddef>
#include <numbers>
#include <type_traits>

#include "hts/lanes/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// What needs no preparation: `Limit::value` of each item.
template <class Limit, class Items>
struct LimitBlock {
    static constexpr auto d = Items::d;
    using Lanes = hl::WideLanes<std::remove_const_t<decltype(d)> >;
    using V = hn::Vec<decltype(d)>;
    static constexpr std::size_t size = 64;

    const Items& items;

    explicit HWY_INLINE LimitBlock(const Items& of) : items{of} {}
    HWY_INLINE void prepare(std::size_t) const {}
    HWY_INLINE V value(std::size_t i) const {
        return Limit::value(Lanes{}, items.g(i), items.t(i), items.inverse_g(i), items.scale(i));
    }
    HWY_INLINE V one_vector() const { return value(0); }
};

/// scale exp(-x)
template <class Lanes, class V>
HWY_INLINE V scaled_exp_of_minus(const Lanes& o, V x, V scale) {
    constexpr int degree = 5;  // 1e-7
    return hl::scaled_exp2<degree>(o, x * o.real(-std::numbers::log2e), scale);
}

/// Phi = g exp(-g - t), one bounce of the wave off the first order of roughness.
struct FirstOrderLimit {
    template <class Lanes, class V>
    static HWY_INLINE V value(const Lanes& o, V g, V t, V, V scale) {
        return scaled_exp_of_minus(o, g + t, g * scale);
    }
};
/// Phi = exp(-t/g)/g
struct GeometricLimit {
    template <class Lanes, class V>
    static HWY_INLINE V value(const Lanes& o, V, V t, V inverse_g, V scale) {
        return scaled_exp_of_minus(o, t * inverse_g, inverse_g * scale);
    }
};

template <class Items>
using FirstOrderBlock = LimitBlock<FirstOrderLimit, Items>;
template <class Items>
using RoughLimitBlock = LimitBlock<GeometricLimit, Items>;

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
