// phi for one pair and for spans, compiled for every instruction set and chosen at run time.
#include "hts/phi_simd.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "hts/phi_far.hpp"
#include "hts/phi_table.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hts/phi_simd.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "hts/phi_cells-inl.hpp"
#include "hts/phi_terms-inl.hpp"
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
    return {{phi_one, phi_one, phi_one}, {phi_many, phi_many, phi_many}, far_phi};
}

#else

/// A block of values in three passes, so that no pass waits for the one before: places across lanes,
/// polynomials value by value (a row of coefficients fills a vector), exponentials across lanes.
template <class Spec>
struct Block {
    static constexpr hn::CappedTag<double, 8> d{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;
    using Lanes = hl::WideLanes<hn::CappedTag<double, 8> >;
    using C = Cells<Spec, hn::CappedTag<double, 8> >;
    using T = typename Spec::Coefficient;
    static constexpr typename C::NarrowTag narrow{};

    HWY_ALIGN double multiplier[size], factor[size], line_x[size], lines[2 * size];
    HWY_ALIGN std::int64_t cell[size], line[size];
    HWY_ALIGN T x[size], z[size], sums[C::width * size];

    /// count: a multiple of lanes. Returns whether the table has all cells; the factor is NaN where it has
    /// not.
    HWY_INLINE bool place_all(const Table<Spec>& table, const double* g, const double* t, std::size_t count) {
        bool inside = true;
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto p = place(Lanes{}, table, hn::LoadU(d, g + i), hn::LoadU(d, t + i));
            hn::Store(p.multiplier, d, multiplier + i);
            hn::Store(
                hn::IfThenElse(p.inside, p.factor, hn::Set(d, std::numeric_limits<double>::quiet_NaN())), d,
                factor + i);
            hn::Store(p.line_x, d, line_x + i);
            hn::Store(p.cell, Lanes::di, cell + i);
            hn::Store(p.line, Lanes::di, line + i);
            hn::Store(C::narrow(p.x), narrow, x + i);
            hn::Store(C::narrow(p.z), narrow, z + i);
            inside = inside && hn::AllTrue(d, p.inside);
        }
        return inside;
    }

    HWY_INLINE void add_polynomials(const Table<Spec>& table, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            hn::Store(C::sums(table.cells + cell[i], x[i], z[i]), C::pack, sums + C::width * i);
            hn::Store(line_sums<Spec>(table.lines + line[i], line_x[i]), two, lines + 2 * i);
        }
    }

    HWY_INLINE void exponentials(double* out, std::size_t count) const {
        constexpr Lanes o{};
        for (std::size_t i = 0; i < count; i += lanes) {
            hn::Vec<decltype(d)> slope, width;
            hn::LoadInterleaved2(d, lines + 2 * i, slope, width);
            const auto q = C::value(sums + C::width * i, hn::Load(narrow, z + i));
            hn::StoreU(
                hl::scaled_exp2<Spec::exp_degree>(
                    o, exponent(o, hn::Load(d, multiplier + i), slope, width, q), hn::Load(d, factor + i)),
                d, out + i);
        }
    }

    HWY_INLINE void run(const Table<Spec>& table, const double* g, const double* t, double* out,
                        std::size_t count) {
        const bool inside = place_all(table, g, t, count);
        add_polynomials(table, count);
        exponentials(out, count);
        if (HWY_UNLIKELY(!inside))
            for (std::size_t i = 0; i < count; ++i)
                if (std::isnan(out[i])) out[i] = phi_beyond_table<Spec>(g[i], t[i]);
    }
};

/// exponent and factor of one pair: Phi = factor 2^exponent, or no table there.
struct Tabled {
    double exponent, factor;
    bool inside;
};

/// The same operations in the same order as Block, hence the same bits.
template <class Spec>
HWY_INLINE Tabled tabled(const Table<Spec>& table, double g, double t) {
    using C = Cells<Spec, hn::CappedTag<double, 1> >;
    using T = typename Spec::Coefficient;
    constexpr hl::Plain o{};
    const auto p = place(o, table, g, t);
    if (HWY_UNLIKELY(!p.inside)) return {0, 0, false};
    const T z = static_cast<T>(p.z);
    const T cell = C::fold(C::sums(table.cells + p.cell, static_cast<T>(p.x), z), z);
    const auto line = line_sums<Spec>(table.lines + p.line, p.line_x);
    const double slope = hn::GetLane(line);
    const double width = hn::GetLane(hn::UpperHalf(hn::CappedTag<double, 1>{}, line));
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

template <class Spec>
HWY_ATTR void phi_many(const double* g, const double* t, double* out, std::size_t count) {
    const Table<Spec>& tab = table<Spec>();
    Block<Spec> block;
    constexpr std::size_t lanes = Block<Spec>::lanes, size = Block<Spec>::size;
    std::size_t i = 0;
    for (; i + lanes <= count;) {
        const std::size_t n = std::min(size, (count - i) / lanes * lanes);
        block.run(tab, g + i, t + i, out + i, n);
        i += n;
    }
    if (i == count) return;
    double g_pad[lanes] = {}, t_pad[lanes] = {}, out_pad[lanes];
    std::memcpy(g_pad, g + i, (count - i) * sizeof(double));
    std::memcpy(t_pad, t + i, (count - i) * sizeof(double));
    block.run(tab, g_pad, t_pad, out_pad, lanes);
    std::memcpy(out + i, out_pad, (count - i) * sizeof(double));
}

PhiForms forms() {
    return {{phi_one<Low>, phi_one<Medium>, phi_one<High>},
            {phi_many<Low>, phi_many<Medium>, phi_many<High>},
            phi_with_log};
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
