// The scattering integral of a shape of correlation for a block of items, in lanes; included once per
// instruction set.
#if defined(HTS_LOBE_BLOCK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_LOBE_BLOCK_INL
#undef HTS_LOBE_BLOCK_INL
#else
#define HTS_LOBE_BLOCK_INL
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "hts/correlation/lobe_table.hpp"
#include "hts/lanes/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::correlation_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// A cell of cubic B-splines: its number, and the weights of its four coefficients.
template <class V, class I>
struct SplineCell {
    I first;
    V weight[4];
};

/// log2 of 2 D, and D/D2 - 1, of a block of items in passes, as phi_block-inl.hpp has them: places across
/// lanes, the four rows of a cell added item by item (four coefficients fill a vector), sums across lanes.
///   with_mean   whether the second is wanted
///   error       beside that of LobeTable 1e-7, relative, of `value`
template <std::size_t most_lanes, bool with_mean>
class LobeBlock {
    using Tag = hn::CappedTag<double, most_lanes>;
    using Lanes = hl::WideLanes<Tag>;
    using V = hn::Vec<Tag>;
    using Cell = SplineCell<V, typename Lanes::Int>;
    static constexpr Tag d{};
    static constexpr hn::CappedTag<double, 4> four{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), quantities = with_mean ? 2 : 1;

  public:
    static constexpr std::size_t size = 64;
    HWY_ALIGN double log2_lobe[size], mean[with_mean ? size : 1];

    ///   items   g(i) and t(i), q = 2 sqrt(t)      count   of items, a multiple of lanes
    template <class Items>
    HWY_INLINE void prepare(const LobeTable& table, const Items& items, std::size_t count) {
        const LobeTable::Coefficients c = table.coefficients();
        bool inside = true;
        for (std::size_t i = 0; i < count; i += lanes) place_row(c, items.g(i), i);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < 4; j += hn::MaxLanes(four))
                hn::Store(hn::LoadU(four, c.log_width + first_[i] + j), four, sums_[0] + 4 * i + j);
        }
        for (std::size_t i = 0; i < count; i += lanes) inside &= place_column(items.g(i), items.t(i), i);
        for (std::size_t i = 0; i < count; ++i) {
            add_rows(c.lobe, i, sums_[0]);
            if constexpr (with_mean) add_rows(c.mean, i, sums_[1]);
        }
        constexpr Lanes o{};
        for (std::size_t i = 0; i < count; i += lanes) {
            hn::Store(sum(0, i) * o.real(std::numbers::log2e), d, log2_lobe + i);
            if constexpr (with_mean) hn::Store(kicks(o.min(sum(1, i), o.real(0))), d, mean + i);
        }
        if (HWY_UNLIKELY(!inside)) {
            for (std::size_t i = 0; i < count; i += lanes) add_items_beyond(table, items.g(i), items.t(i), i);
        }
    }

    /// scale 2 D of items i ... i + lanes - 1.
    HWY_INLINE V value(std::size_t i, V scale) const {
        return hl::scaled_exp2<5>(Lanes{}, hn::Load(d, log2_lobe + i), scale);
    }

  private:
    /// x = mantissa 2^exponent, mantissa from sqrt(1/2) to sqrt(2).
    struct Split {
        V mantissa, exponent;
    };
    static HWY_INLINE Split split(V x) {
        constexpr Lanes o{};
        constexpr std::int64_t root_half = 0x3fe6a09e667f3bcd;
        const auto exponent = hn::ShiftRight<52>(o.sub(o.bits(x), o.integer(root_half)));  // keeps the sign
        return {o.from_bits(o.sub(o.bits(x), hn::ShiftLeft<52>(exponent))), hn::ConvertTo(d, exponent)};
    }
    /// ln of it, from t = (mantissa - 1)/(mantissa + 1).
    ///   error   absolute, 1e-12
    static HWY_INLINE V logarithm(const Split& of, V t) {
        constexpr Lanes o{};
        constexpr std::array<double, 7> series{2, 2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13};
        return o.mul_add(of.exponent, o.real(std::numbers::ln2), t * hl::polynomial(o, series, t * t));
    }
    static HWY_INLINE Cell cell(V position, std::size_t last) {
        constexpr Lanes o{};
        const V floor = hn::Floor(o.min(o.max(position, o.real(0)), o.real(static_cast<double>(last - 1))));
        const V x = position - floor, y = o.real(1) - x;
        const V x2 = x * x, y2 = y * y, sixth = o.real(1.0 / 6), two_thirds = o.real(2.0 / 3);
        const V half_x = o.mul_add(o.real(0.5), x, o.real(-1)),
                half_y = o.mul_add(o.real(0.5), y, o.real(-1));
        return {hn::ConvertTo(Lanes::di, floor),
                {y2 * y * sixth, o.mul_add(half_x, x2, two_thirds), o.mul_add(half_y, y2, two_thirds),
                 x2 * x * sixth}};
    }
    static HWY_INLINE V within(V g) {
        constexpr Lanes o{};
        return o.min(o.max(g, o.real(LobeTable::least_g)), o.real(LobeTable::greatest_g));
    }
    HWY_INLINE void place_row(const LobeTable::Coefficients& c, V g, std::size_t i) {
        constexpr Lanes o{};
        // ln g + crowding g/(g + crowded) with one division
        const V held = within(g);
        const Split of_g = split(held);
        const V below = of_g.mantissa + o.real(1), beside = held + o.real(LobeTable::crowded);
        const V over = o.real(1) / (below * beside);
        const V row = logarithm(of_g, (of_g.mantissa - o.real(1)) * (beside * over)) +
                      o.real(LobeTable::crowding) * held * (below * over);
        const Cell by_g = cell((row - o.real(c.first_row)) * o.real(1 / LobeTable::row_step), c.rows - 1);
        hn::Store(by_g.first, Lanes::di, first_ + i);
        HTS_UNROLL
        for (std::size_t k = 0; k < 4; ++k) hn::Store(by_g.weight[k], d, by_g_[k] + i);
    }
    /// Whether the table has all of them.
    HWY_INLINE bool place_column(V g, V t, std::size_t i) {
        constexpr Lanes o{};
        V a, b, c, e;
        hn::LoadInterleaved4(d, sums_[0] + 4 * i, a, b, c, e);
        const auto by = [this, i](std::size_t k) HWY_ATTR { return hn::Load(d, by_g_[k] + i); };
        const V log_width = o.mul_add(a, by(0), b * by(1)) + o.mul_add(c, by(2), e * by(3));
        // 2 asinh(q/width) = ln(1 + 2 x + 2 sqrt(x + x^2)), x the square
        const V x = hl::scaled_exp2<10>(o, log_width * o.real(-2 * std::numbers::log2e), o.real(4) * t);
        const Split of_u = split(o.mul_add(o.real(2), x + o.sqrt(o.mul_add(x, x, x)), o.real(1)));
        const V twice_u = logarithm(of_u, (of_u.mantissa - o.real(1)) / (of_u.mantissa + o.real(1)));
        const V column = twice_u * o.real(0.5 / LobeTable::column_step);
        const Cell by_u = cell(column, LobeTable::columns - 1);
        const auto row_begin = o.template times<LobeTable::row_length>(hn::Load(Lanes::di, first_ + i));
        hn::Store(o.add(row_begin, by_u.first), Lanes::di, first_ + i);
        HTS_UNROLL
        for (std::size_t k = 0; k < 4; ++k) hn::Store(by_u.weight[k], d, by_u_[k] + i);
        const auto inside = hn::And(hn::Eq(g, within(g)), hn::Le(column, o.real(LobeTable::last_column)));
        hn::Store(hn::IfThenElse(inside, o.real(1), o.real(0)), d, inside_ + i);
        return hn::AllTrue(d, inside);
    }
    HWY_INLINE void add_rows(const double* coefficients, std::size_t i, double* sums) const {
        const double* const at = coefficients + first_[i];
        HTS_UNROLL
        for (std::size_t j = 0; j < 4; j += hn::MaxLanes(four)) {
            auto sum = hn::Set(four, by_g_[0][i]) * hn::LoadU(four, at + j);
            HTS_UNROLL
            for (std::size_t k = 1; k < 4; ++k)
                sum = hn::MulAdd(hn::Set(four, by_g_[k][i]),
                                 hn::LoadU(four, at + k * LobeTable::row_length + j), sum);
            hn::Store(sum, four, sums + 4 * i + j);
        }
    }
    HWY_INLINE V sum(std::size_t quantity, std::size_t i) const {
        constexpr Lanes o{};
        V a, b, c, e;
        hn::LoadInterleaved4(d, sums_[quantity] + 4 * i, a, b, c, e);
        const auto by = [this, i](std::size_t k) HWY_ATTR { return hn::Load(d, by_u_[k] + i); };
        return o.mul_add(a, by(0), b * by(1)) + o.mul_add(c, by(2), e * by(3));
    }
    /// D/D2 - 1 from ln D2/D.
    static HWY_INLINE V kicks(V log_inverse_mean) {
        constexpr Lanes o{};
        return hl::scaled_exp2<10>(o, log_inverse_mean * o.real(-std::numbers::log2e), o.real(1)) - o.real(1);
    }
    HWY_NOINLINE void add_items_beyond(const LobeTable& table, V g_of_items, V t_of_items, std::size_t i) {
        HWY_ALIGN double g[lanes], t[lanes];
        hn::Store(g_of_items, d, g);
        hn::Store(t_of_items, d, t);
        for (std::size_t j = 0; j < lanes; ++j) {
            if (inside_[i + j] == 1) continue;
            const LobeRow::Value value = table(g[j], 2 * std::sqrt(t[j]));
            log2_lobe[i + j] = value.log_lobe * std::numbers::log2e;
            if constexpr (with_mean) mean[i + j] = std::expm1(-value.log_inverse_mean);
        }
    }

    HWY_ALIGN double by_g_[4][size], by_u_[4][size], inside_[size];
    HWY_ALIGN std::int64_t first_[size];
    HWY_ALIGN double sums_[quantities][4 * size];
};

#endif

}  // namespace hts::correlation_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
