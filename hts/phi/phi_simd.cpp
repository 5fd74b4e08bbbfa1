// phi for one pair and for spans, compiled for every instruction set and chosen at run time.
#include "hts/phi/phi_simd.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "hts/phi/phi_far.hpp"
#include "hts/phi/tables/phi_table.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/phi/phi_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/phi/phi_block-inl.hpp"
#include "hts/phi/phi_gradient-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace hts::phi_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR  // no vectors, as on x86 before SSSE3: the sums, slow but right

double phi_one(double g, double t) {
    return far_phi_value(g, t);
}

void phi_many(const double* g, const double* t, double* result, std::size_t count) {
    std::transform(g, g + count, t, result, far_phi_value);
}

PhiForms forms() {
    return {{phi_one, phi_one, phi_one}, {phi_many, phi_many, phi_many}, far_phi, phi_gradient};
}

#else

/// exponent and factor of one pair: Phi = factor 2^exponent, or no table there.
struct Tabled {
    double exponent, factor;
    bool inside;
};

/// The same operations in the same order as PhiBlock, hence the same bits.
template <class Spec>
HWY_INLINE Tabled tabled(const Table<Spec>& table, double g, double t) {
    using C = Cells<Spec, hn::CappedTag<double, 1> >;
    using T = typename Spec::Coefficient;
    constexpr hl::Plain o{};
    const auto p = place(o, table, g, t);
    if (HWY_UNLIKELY(!p.inside)) return {0, 0, false};
    const T z = static_cast<T>(p.z);
    const T cell = C::fold(C::sums(table.cells + p.cell, static_cast<T>(p.x), z), z);
    using L = typename Spec::Line;
    HWY_ALIGN L sums[4];
    const L x = static_cast<L>(p.line_x);
    LineSums<Spec, hn::CappedTag<double, 1> >::store(table.lines + p.line, x, sums);
    const double slope = o.mul_add(sums[2], x, sums[0]), width = o.mul_add(sums[3], x, sums[1]);
    return {exponent(o, p.multiplier, slope, width, static_cast<double>(cell)), p.factor, true};
}

template <class Spec>
HWY_ATTR double phi_one(double g, double t) {
    const Tabled p = tabled(table<Spec>(), g, t);
    if (HWY_UNLIKELY(!p.inside)) return phi_beyond_table<Spec>(g, t);
    return hl::scaled_exp2<Spec::exp_degree>(hl::Plain{}, p.exponent, p.factor);
}

HWY_ATTR Phi phi_with_log(double g, double t) {
    const Tabled p = tabled(table<High>(), g, t);
    if (!p.inside || !(g > 0)) return far_phi(g, t);
    const double log = p.exponent * std::numbers::ln2 + std::log(p.factor);
    if (log < least_log_phi) return far_phi(g, t);
    return {hl::scaled_exp2<High::exp_degree>(hl::Plain{}, p.exponent, p.factor), log, PhiMethod::table};
}

/// Phi itself, from arrays.
struct Plain {
    static constexpr hn::CappedTag<double, 8> d{};
    using V = hn::Vec<decltype(d)>;
    const double *gs, *ts;

    HWY_INLINE V g(std::size_t i) const { return hn::LoadU(d, gs + i); }
    HWY_INLINE V t(std::size_t i) const { return hn::LoadU(d, ts + i); }
    HWY_INLINE V inverse_g(std::size_t i) const { return hn::Div(hn::Set(d, 1.0), g(i)); }
    HWY_INLINE V scale(std::size_t) const { return hn::Set(d, 1.0); }
};

template <class Spec>
using PlainBlock = PhiBlock<Spec, Plain>;

/// count: a multiple of the vector's lanes, no more than a block
template <class Spec>
HWY_INLINE void phi_of_block(const double* g, const double* t, double* out, std::size_t count) {
    const Plain items{g, t};
    PlainBlock<Spec> block{items};
    block.prepare(count);
    for (std::size_t i = 0; i < count; i += block.lanes) hn::StoreU(block.value(i), Plain::d, out + i);
}

template <class Spec>
HWY_ATTR void phi_many(const double* g, const double* t, double* out, std::size_t count) {
    constexpr std::size_t lanes = PlainBlock<Spec>::lanes, size = PlainBlock<Spec>::size;
    std::size_t i = 0;
    for (; i + lanes <= count;) {
        const std::size_t n = std::min(size, (count - i) / lanes * lanes);
        phi_of_block<Spec>(g + i, t + i, out + i, n);
        i += n;
    }
    if (i == count) return;
    double g_pad[lanes] = {}, t_pad[lanes] = {}, out_pad[lanes];
    std::memcpy(g_pad, g + i, (count - i) * sizeof(double));
    std::memcpy(t_pad, t + i, (count - i) * sizeof(double));
    phi_of_block<Spec>(g_pad, t_pad, out_pad, lanes);
    std::memcpy(out + i, out_pad, (count - i) * sizeof(double));
}

PhiForms forms() {
    return {{phi_one<Low>, phi_one<Medium>, phi_one<High>},
            {phi_many<Low>, phi_many<Medium>, phi_many<High>},
            phi_with_log,
            tabled_gradient};
}

#endif

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hts::phi_detail {

HWY_EXPORT(forms);

PhiForms phi_forms() noexcept {
    return HWY_DYNAMIC_DISPATCH(forms)();
}

}  // namespace hts::phi_detail
#endif
