// Phi times a factor, for a block of items or one vector of them; included once per instruction set.
#if defined(HTS_PHI_BLOCK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_PHI_BLOCK_INL
#undef HTS_PHI_BLOCK_INL
#else
#define HTS_PHI_BLOCK_INL
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hts/phi/phi_cells-inl.hpp"
#include "hts/phi/phi_terms-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::phi_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// scale Phi(g, t) for a block of items, in passes, so that no pass waits for the one before: coordinates
/// across lanes, the directory item by item (quicker than a gather), places across lanes, polynomials item by
/// item (a row of coefficients fills a vector), exponentials across lanes.
///   Items   g(i), t(i), inverse_g(i) and scale(i): vectors of items i ... i + lanes - 1
template <class Spec, std::size_t most_lanes, class Items>
struct PhiBlock {
    using Tag = hn::CappedTag<double, most_lanes>;
    using Lanes = hl::WideLanes<Tag>;
    using V = hn::Vec<Tag>;
    using C = Cells<Spec, Tag>;
    using T = typename Spec::Coefficient;
    static constexpr Tag d{};
    static constexpr typename C::NarrowTag narrow{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    const Items& items;
    bool inside = true;
    HWY_ALIGN double inverse_g[size], v[size];
    HWY_ALIGN std::int64_t x_bits[size], zeta_bits[size], entry[size];
    HWY_ALIGN double multiplier[size], factor[size], line_x[size], lines[2 * size];
    HWY_ALIGN std::int64_t cell[size], line[size];
    HWY_ALIGN T x[size], z[size], sums[C::width * size];

    explicit HWY_INLINE PhiBlock(const Items& of) : items{of} {}

    /// All passes but the last.
    ///   count   of items, a multiple of lanes
    HWY_INLINE void prepare(std::size_t count) {
        const Items here = items;  // copies: no store below can change them
        const Table<Spec> table = phi_detail::table<Spec>();
        for (std::size_t i = 0; i < count; i += lanes) {
            const V inverse = here.inverse_g(i);
            const auto at = coordinates<Spec>(Lanes{}, here.g(i), here.t(i), inverse);
            hn::Store(inverse, d, inverse_g + i);
            hn::Store(at.v, d, v + i);
            hn::Store(at.x_bits, Lanes::di, x_bits + i);
            hn::Store(at.zeta_bits, Lanes::di, zeta_bits + i);
            hn::Store(at.slot, Lanes::di, entry + i);
        }
        for (std::size_t i = 0; i < count; ++i) entry[i] = table.directory[entry[i]];
        for (std::size_t i = 0; i < count; i += lanes) {
            const Coordinates<Lanes> at{
                hn::Load(d, v + i), hn::Load(Lanes::di, x_bits + i), hn::Load(Lanes::di, zeta_bits + i), {}};
            store(i,
                  place_at<Spec>(Lanes{}, table, here.g(i), here.t(i), hn::Load(d, inverse_g + i), at,
                                 hn::Load(Lanes::di, entry + i)),
                  here.scale(i));
        }
        for (std::size_t i = 0; i < count; ++i) {
            add_cell(table, i);
            hn::Store(line_of(table, i), two, lines + 2 * i);
        }
    }

    /// scale Phi of items i ... i + lanes - 1.
    HWY_INLINE V value(std::size_t i) const {
        constexpr Lanes o{};
        V slope, width;
        hn::LoadInterleaved2(d, lines + 2 * i, slope, width);
        const auto q = C::value(sums + C::width * i, hn::Load(narrow, z + i));
        const V e = exponent(o, hn::Load(d, multiplier + i), slope, width, q);
        const V product = hl::scaled_exp2<Spec::exp_degree>(o, e, hn::Load(d, factor + i));
        return HWY_LIKELY(inside) ? product : with_items_beyond(i, product);
    }

    /// All passes for one vector. Pairs of pieces are joined before they are stored: a load of two separate
    /// stores would wait for both to reach the cache.
    HWY_INLINE V one_vector() {
        const Table<Spec> table = phi_detail::table<Spec>();
        store(0, place(Lanes{}, table, items.g(0), items.t(0), items.inverse_g(0)), items.scale(0));
        HTS_UNROLL
        for (std::size_t i = 0; i < lanes; ++i) add_cell(table, i);
        if constexpr (lanes < 4) {
            for (std::size_t i = 0; i < lanes; ++i) hn::Store(line_of(table, i), two, lines + 2 * i);
        } else {
            constexpr hn::CappedTag<double, 4> four;
            HTS_UNROLL
            for (std::size_t i = 0; i < lanes; i += 2) {
                hn::Store(hn::Combine(four, line_of(table, i + 1), line_of(table, i)), four, lines + 2 * i);
            }
        }
        return value(0);
    }

  private:
    /// The factor of items for which the table has no cell is NaN.
    HWY_INLINE void store(std::size_t i, const Place<Lanes>& p, V scale) {
        const V nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
        hn::Store(p.multiplier, d, multiplier + i);
        hn::Store(hn::IfThenElse(p.inside, p.factor * scale, nan), d, factor + i);
        hn::Store(p.line_x, d, line_x + i);
        hn::Store(p.cell, Lanes::di, cell + i);
        hn::Store(p.line, Lanes::di, line + i);
        hn::Store(C::narrow(p.x), narrow, x + i);
        hn::Store(C::narrow(p.z), narrow, z + i);
        inside = inside && hn::AllTrue(d, p.inside);
    }
    HWY_INLINE void add_cell(const Table<Spec>& table, std::size_t i) {
        hn::Store(C::sums(table.cells + cell[i], x[i], z[i]), C::pack, sums + C::width * i);
    }
    HWY_INLINE hn::Vec<decltype(two)> line_of(const Table<Spec>& table, std::size_t i) const {
        return line_sums<Spec>(table.lines + line[i], line_x[i]);
    }

    HWY_NOINLINE V with_items_beyond(std::size_t i, V product) const {
        HWY_ALIGN double values[lanes], g[lanes], t[lanes], scale[lanes];
        hn::Store(product, d, values);
        hn::Store(items.g(i), d, g);
        hn::Store(items.t(i), d, t);
        hn::Store(items.scale(i), d, scale);
        for (std::size_t j = 0; j < lanes; ++j) {
            if (std::isnan(values[j])) values[j] = phi_beyond_table<Spec>(g[j], t[j]) * scale[j];
        }
        return hn::Load(d, values);
    }
};

#endif

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
