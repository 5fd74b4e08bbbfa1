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
#include <type_traits>

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
///   Items   g(i), t(i), inverse_g(i) and scale(i): vectors of items i ... i + lanes - 1, of tag Items::d
template <class Spec, class Items>
struct PhiBlock {
    using Tag = std::remove_const_t<decltype(Items::d)>;
    using Number = hn::TFromD<Tag>;
    using Lanes = hl::WideLanes<Tag>;
    using Whole = typename Lanes::Whole;
    using V = hn::Vec<Tag>;
    using C = Cells<Spec, Tag>;
    using L = LineSums<Spec, Tag>;
    using T = typename Spec::Coefficient;
    using LineT = typename Spec::Line;
    static constexpr Tag d{};
    static constexpr typename C::NarrowTag narrow{};
    static constexpr typename L::NarrowTag narrow_line{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;
    // items for which a gather is quicker: no vector is loaded right after its numbers were stored one by one
    static constexpr std::size_t few = 4 * lanes < size ? 4 * lanes : 0;

    const Items& items;
    bool inside = true;
    HWY_ALIGN Number inverse_g[size], v[size];
    HWY_ALIGN Whole x_bits[size], zeta_bits[size], entry[size];
    HWY_ALIGN Number multiplier[size], factor[size];
    HWY_ALIGN Whole cell[size], line[size];
    HWY_ALIGN T x[size], z[size], sums[C::width * size];
    HWY_ALIGN LineT line_x[size], line_sums[4 * size];

    explicit HWY_INLINE PhiBlock(const Items& of) : items{of} {}

    /// Nobody but Phi looks at the coordinates.
    struct Alone {
        HWY_INLINE void at(std::size_t, const Coordinates<Lanes>&) const {}
        HWY_INLINE void at_all(const PhiBlock&, std::size_t) const {}
    };
    /// All passes but the last.
    ///   count       of items, a multiple of lanes
    ///   companion   finds places of its own by the same coordinates: at(i, those of items i ... i + lanes -
    ///               1), or of many items at_all(this block, count) when x_bits, zeta_bits and, in `entry`,
    ///               the slots of all are known
    template <class Companion = Alone>
    HWY_INLINE void prepare(std::size_t count, Companion&& companion = {}) {
        const Items here = items;  // copies: no store below can change them
        const Table<Spec> table = phi_detail::table<Spec>();
        if (count <= few) {
            for (std::size_t i = 0; i < count; i += lanes) {
                const V g = here.g(i), t = here.t(i), inverse = here.inverse_g(i);
                const auto at = coordinates<Spec>(Lanes{}, g, t, inverse);
                companion.at(i, at);
                store(i, place(Lanes{}, table, g, t, inverse, at), here.scale(i));
            }
            add_pieces(table, count);
            return;
        }
        for (std::size_t i = 0; i < count; i += lanes) {
            const V inverse = here.inverse_g(i);
            const auto at = coordinates<Spec>(Lanes{}, here.g(i), here.t(i), inverse);
            hn::Store(inverse, d, inverse_g + i);
            hn::Store(at.v, d, v + i);
            hn::Store(at.x_bits, Lanes::di, x_bits + i);
            hn::Store(at.zeta_bits, Lanes::di, zeta_bits + i);
            hn::Store(at.slot, Lanes::di, entry + i);
        }
        companion.at_all(*this, count);
        for (std::size_t i = 0; i < count; ++i) {
            entry[i] = static_cast<Whole>(table.directory[entry[i]]);
            asm("");  // the compiler would gather
        }
        for (std::size_t i = 0; i < count; i += lanes) {
            const Coordinates<Lanes> at{
                hn::Load(d, v + i), hn::Load(Lanes::di, x_bits + i), hn::Load(Lanes::di, zeta_bits + i), {}};
            store(i,
                  place_at<Spec>(Lanes{}, table, here.g(i), here.t(i), hn::Load(d, inverse_g + i), at,
                                 hn::Load(Lanes::di, entry + i)),
                  here.scale(i));
        }
        add_pieces(table, count);
    }

    /// scale Phi of items i ... i + lanes - 1.
    HWY_INLINE V value(std::size_t i) const {
        constexpr Lanes o{};
        const auto at = L::values(line_sums + 4 * i, hn::Load(narrow_line, line_x + i));
        const auto q = C::value(sums + C::width * i, hn::Load(narrow, z + i));
        const V e = exponent(o, hn::Load(d, multiplier + i), at.slope, at.width, q);
        const V product = hl::scaled_exp2<Spec::exp_degree>(o, e, hn::Load(d, factor + i));
        return HWY_LIKELY(inside) ? product : with_items_beyond(i, product);
    }

    /// All passes for one vector.
    HWY_INLINE V one_vector() {
        const Table<Spec> table = phi_detail::table<Spec>();
        store(0, place(Lanes{}, table, items.g(0), items.t(0), items.inverse_g(0)), items.scale(0));
        HTS_UNROLL
        for (std::size_t i = 0; i < lanes; ++i) {
            add_cell(table, i);
            add_line(table, i);
        }
        return value(0);
    }

  private:
    /// The factor of items for which the table has no cell is NaN.
    HWY_INLINE void store(std::size_t i, const Place<Lanes>& p, V scale) {
        const V nan = hn::Set(d, std::numeric_limits<Number>::quiet_NaN());
        hn::Store(p.multiplier, d, multiplier + i);
        hn::Store(hn::IfThenElse(p.inside, p.factor * scale, nan), d, factor + i);
        hn::Store(L::narrow(p.line_x), narrow_line, line_x + i);
        hn::Store(p.cell, Lanes::di, cell + i);
        hn::Store(p.line, Lanes::di, line + i);
        hn::Store(C::narrow(p.x), narrow, x + i);
        hn::Store(C::narrow(p.z), narrow, z + i);
        inside = inside && hn::AllTrue(d, p.inside);
    }
    HWY_INLINE void add_pieces(const Table<Spec>& table, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            add_cell(table, i);
            add_line(table, i);
        }
    }
    HWY_INLINE void add_cell(const Table<Spec>& table, std::size_t i) {
        hn::Store(C::sums(table.cells + cell[i], x[i], z[i]), C::pack, sums + C::width * i);
    }
    HWY_INLINE void add_line(const Table<Spec>& table, std::size_t i) {
        L::store(table.lines + line[i], line_x[i], line_sums + 4 * i);
    }

    HWY_NOINLINE V with_items_beyond(std::size_t i, V product) const {
        HWY_ALIGN Number values[lanes], g[lanes], t[lanes], scale[lanes];
        hn::Store(product, d, values);
        hn::Store(items.g(i), d, g);
        hn::Store(items.t(i), d, t);
        hn::Store(items.scale(i), d, scale);
        for (std::size_t j = 0; j < lanes; ++j) {
            if (std::isnan(values[j]))
                values[j] = static_cast<Number>(phi_beyond_table<Spec>(g[j], t[j]) * scale[j]);
        }
        return hn::Load(d, values);
    }
};

#endif

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
