// The mean number of kicks for a block of items, in the manner of phi_block-inl.hpp; included
// once per instruction set.
#if defined(HTS_KICKS_BLOCK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_KICKS_BLOCK_INL
#undef HTS_KICKS_BLOCK_INL
#else
#define HTS_KICKS_BLOCK_INL
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hts/phi/phi_cells-inl.hpp"
#include "hts/unified/lanes/kicks_table.hpp"
#include "hts/unified/lanes/unified_simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace phi = phi_detail::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// H of kicks_table.hpp for a block of items.
///   Items   g(i), t(i) and inverse_g(i): vectors of items i ... i + lanes - 1
template <class Spec, std::size_t most_lanes, class Items>
struct KicksBlock {
    using Tag = hn::CappedTag<double, most_lanes>;
    using Lanes = hl::WideLanes<Tag>;
    using V = hn::Vec<Tag>;
    using C = phi::Cells<Spec, Tag>;
    using T = typename Spec::Coefficient;
    static constexpr Tag d{};
    static constexpr typename C::NarrowTag narrow{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    bool inside = true;
    HWY_ALIGN double mean[size];
    HWY_ALIGN std::int64_t x_bits[size], zeta_bits[size], entry[size], cell[size];
    HWY_ALIGN T x[size], z[size], sums[C::width * size];

    ///   count   of items, a multiple of lanes
    HWY_INLINE void prepare(const Items& items, std::size_t count) {
        constexpr Lanes o{};
        const KicksTable<Spec>& table = kicks_table<Spec>();
        for (std::size_t i = 0; i < count; i += lanes) {
            const auto at = phi::coordinates<Spec>(o, items.g(i), items.t(i), items.inverse_g(i));
            hn::Store(at.x_bits, Lanes::di, x_bits + i);
            hn::Store(at.zeta_bits, Lanes::di, zeta_bits + i);
            hn::Store(at.slot, Lanes::di, entry + i);
        }
        for (std::size_t i = 0; i < count; ++i) entry[i] = table.directory[entry[i]];
        for (std::size_t i = 0; i < count; i += lanes) place(i);
        for (std::size_t i = 0; i < count; ++i)
            hn::Store(C::sums(table.cells + cell[i], x[i], z[i]), C::pack, sums + C::width * i);
        for (std::size_t i = 0; i < count; i += lanes) {
            const V q = C::value(sums + C::width * i, hn::Load(narrow, z + i));
            hn::Store(hl::scaled_exp2<Spec::exp_degree>(o, q, items.g(i)), d, mean + i);
        }
        if (HWY_UNLIKELY(!inside)) add_items_beyond(items, count);
    }

  private:
    HWY_INLINE void place(std::size_t i) {
        constexpr Lanes o{};
        const phi::Finder<Spec, Lanes> find{o};
        const auto found = hn::Load(Lanes::di, entry + i);
        const auto at = o.max0(found);  // lanes outside read the first cell; their result is not used
        const auto xs = hn::Load(Lanes::di, x_bits + i), zetas = hn::Load(Lanes::di, zeta_bits + i);
        const auto log2_nx = o.bit_and(o.template shift_right<3>(at), o.integer(15));
        const auto log2_nz = o.bit_and(at, o.integer(7));
        const auto row = o.add(o.template shift_right<8>(at), o.shift_left(find.piece(xs, log2_nx), log2_nz));
        const auto index = o.template times<Spec::rows * Spec::lanes>(o.add(row, find.piece(zetas, log2_nz)));
        hn::Store(index, Lanes::di, cell + i);
        hn::Store(C::narrow(find.position(o.shift_left(xs, log2_nx))), narrow, x + i);
        hn::Store(C::narrow(find.position(o.shift_left(zetas, log2_nz))), narrow, z + i);
        inside = inside && hn::AllTrue(d, o.not_negative(found));
    }
    HWY_NOINLINE void add_items_beyond(const Items& items, std::size_t count) {
        for (std::size_t i = 0; i < count; i += lanes) {
            HWY_ALIGN double g[lanes], t[lanes];
            hn::Store(items.g(i), d, g);
            hn::Store(items.t(i), d, t);
            for (std::size_t j = 0; j < lanes; ++j)
                if (entry[i + j] < 0) mean[i + j] = far_mean_kicks(g[j], t[j]);
        }
    }
};

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
