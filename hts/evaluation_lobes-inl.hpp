// Phi times a factor, for a block of items or one vector of them; included once per instruction set.
#if defined(HTS_EVALUATION_LOBES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_EVALUATION_LOBES_INL
#undef HTS_EVALUATION_LOBES_INL
#else
#define HTS_EVALUATION_LOBES_INL
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hts/phi_cells-inl.hpp"
#include "hts/phi_terms-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::evaluation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace phi = phi_detail::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// scale Phi(g, t) for a block of items, in three passes, so that no pass waits for the one before: places
/// across lanes, polynomials item by item (a row of coefficients fills a vector), exponentials across lanes.
template <class Spec, std::size_t most_lanes>
struct Lobes {
    using Tag = hn::CappedTag<double, most_lanes>;
    using Lanes = hl::WideLanes<Tag>;
    using V = hn::Vec<Tag>;
    using Cells = phi::Cells<Spec, Tag>;
    using T = typename Spec::Coefficient;
    static constexpr Tag d{};
    static constexpr typename Cells::NarrowTag narrow{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    const phi_detail::Table<Spec>& table = phi_detail::table<Spec>();
    bool inside = true;
    HWY_ALIGN double multiplier[size], factor[size], line_x[size], lines[2 * size];
    HWY_ALIGN std::int64_t cell[size], line[size];
    HWY_ALIGN T x[size], z[size], sums[Cells::width * size];
    HWY_ALIGN double g[size], t[size], scale[size];  // filled only where the table has no cell

    HWY_INLINE void place(std::size_t i, V variance, V argument, V inverse_variance, V factor_outside) {
        const auto p = phi::place(Lanes{}, table, variance, argument, inverse_variance);
        const V nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
        hn::Store(p.multiplier, d, multiplier + i);
        hn::Store(hn::IfThenElse(p.inside, p.factor * factor_outside, nan), d, factor + i);
        hn::Store(p.line_x, d, line_x + i);
        hn::Store(p.cell, Lanes::di, cell + i);
        hn::Store(p.line, Lanes::di, line + i);
        hn::Store(Cells::narrow(p.x), narrow, x + i);
        hn::Store(Cells::narrow(p.z), narrow, z + i);
        if (HWY_LIKELY(hn::AllTrue(d, p.inside))) return;
        inside = false;
        hn::Store(variance, d, g + i);
        hn::Store(argument, d, t + i);
        hn::Store(factor_outside, d, scale + i);
    }

    HWY_INLINE void add_polynomials(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            hn::Store(Cells::sums(table.cells + cell[i], x[i], z[i]), Cells::pack, sums + Cells::width * i);
            hn::Store(line_of(i), phi::two, lines + 2 * i);
        }
    }

    /// The value of items i ... i + lanes - 1.
    HWY_INLINE V value(std::size_t i) {
        constexpr Lanes o{};
        V slope, width;
        hn::LoadInterleaved2(d, lines + 2 * i, slope, width);
        const auto q = Cells::value(sums + Cells::width * i, hn::Load(narrow, z + i));
        const V exponent = phi::exponent(o, hn::Load(d, multiplier + i), slope, width, q);
        const V lobe = hl::scaled_exp2<Spec::exp_degree>(o, exponent, hn::Load(d, factor + i));
        return HWY_LIKELY(inside) ? lobe : with_far_items(i, lobe);
    }

    /// All three passes for one vector. Pairs of pieces are joined before they are stored: a load of two separate
    /// stores would wait for both to reach the cache.
    HWY_INLINE V one_vector(V variance, V argument, V inverse_variance, V factor_outside) {
        place(0, variance, argument, inverse_variance, factor_outside);
        HTS_UNROLL
        for (std::size_t i = 0; i < lanes; ++i) {
            hn::Store(Cells::sums(table.cells + cell[i], x[i], z[i]), Cells::pack, sums + Cells::width * i);
        }
        if constexpr (lanes < 4) {
            for (std::size_t i = 0; i < lanes; ++i) hn::Store(line_of(i), phi::two, lines + 2 * i);
        } else {
            constexpr hn::CappedTag<double, 4> four;
            HTS_UNROLL
            for (std::size_t i = 0; i < lanes; i += 2) {
                hn::Store(hn::Combine(four, line_of(i + 1), line_of(i)), four, lines + 2 * i);
            }
        }
        return value(0);
    }
    HWY_INLINE hn::Vec<decltype(phi::two)> line_of(std::size_t i) const {
        return phi::line_sums<Spec>(table.lines + line[i], line_x[i]);
    }

    HWY_NOINLINE V with_far_items(std::size_t i, V lobe) const {
        HWY_ALIGN double values[lanes];
        hn::Store(lobe, d, values);
        for (std::size_t j = 0; j < lanes; ++j) {
            if (std::isnan(values[j]))
                values[j] = phi::phi_beyond_table<Spec>(g[i + j], t[i + j]) * scale[i + j];
        }
        return hn::Load(d, values);
    }
};

#endif

}  // namespace hts::evaluation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
