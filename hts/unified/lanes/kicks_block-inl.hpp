// The mean number of kicks for a block of items, in the manner of phi_block-inl.hpp; included
// once per instruction set.
#if defined(HTS_KICKS_BLOCK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_KICKS_BLOCK_INL
#undef HTS_KICKS_BLOCK_INL
#else
#define HTS_KICKS_BLOCK_INL
#endif

#include <cstddef>
#include <cstdint>

#include "hts/phi/phi_block-inl.hpp"
#include "hts/unified/lanes/kicks_table.hpp"
#include "hts/unified/lanes/unified_simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::unified_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;
namespace phi = phi_detail::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// H of kicks_table.hpp for a block of items, by the coordinates that Phi of the same items has found: the
/// companion of a PhiBlock.
///   Items   g(i) and t(i): vectors of items i ... i + lanes - 1
template <class Spec, class Items>
struct KicksBlock {
    using Tag = std::remove_const_t<decltype(Items::d)>;
    using Lanes = hl::WideLanes<Tag>;
    using Int = typename Lanes::Int;
    using V = hn::Vec<Tag>;
    using C = phi::Cells<Spec, Tag>;
    using T = typename Spec::Coefficient;
    static constexpr Tag d{};
    static constexpr typename C::NarrowTag narrow{};
    static constexpr std::size_t lanes = hn::MaxLanes(d), size = 64;

    bool inside = true;
    HWY_ALIGN std::int64_t entry[size], cell[size];
    HWY_ALIGN T x[size], z[size], sums[C::width * size];

    HWY_INLINE void at(std::size_t i, const phi::Coordinates<Lanes>& found) {
        constexpr Lanes o{};
        const Int entries = o.gather(kicks_table<Spec>().directory, found.slot);
        hn::Store(entries, Lanes::di, entry + i);
        place(i, found.x_bits, found.zeta_bits, entries);
    }
    template <class Phi>
    HWY_INLINE void at_all(const Phi& found, std::size_t count) {
        const std::int64_t* const directory = kicks_table<Spec>().directory;
        for (std::size_t i = 0; i < count; ++i) {
            entry[i] = directory[found.entry[i]];
            asm("");  // the compiler would gather
        }
        for (std::size_t i = 0; i < count; i += lanes)
            place(i, hn::Load(Lanes::di, found.x_bits + i), hn::Load(Lanes::di, found.zeta_bits + i),
                  hn::Load(Lanes::di, entry + i));
    }
    /// After the places are found.
    ///   count   of items, a multiple of lanes
    HWY_INLINE void prepare(std::size_t count) {
        const T* const cells = kicks_table<Spec>().cells;
        for (std::size_t i = 0; i < count; ++i)
            hn::Store(C::sums(cells + cell[i], x[i], z[i]), C::pack, sums + C::width * i);
    }
    /// H of items i ... i + lanes - 1.
    HWY_INLINE V value(const Items& items, std::size_t i) const {
        const V q = C::value(sums + C::width * i, hn::Load(narrow, z + i));
        const V mean = hl::scaled_exp2<Spec::exp_degree>(Lanes{}, q, items.g(i));
        return HWY_LIKELY(inside) ? mean : with_items_beyond(items, i, mean);
    }

  private:
    HWY_INLINE void place(std::size_t i, Int x_bits, Int zeta_bits, Int found) {
        constexpr Lanes o{};
        const phi::Finder<Spec, Lanes> find{o};
        const Int at = o.max0(found);  // lanes outside read the first cell; their result is not used
        const Int log2_nx = o.bit_and(o.template shift_right<3>(at), o.integer(15));
        const Int log2_nz = o.bit_and(at, o.integer(7));
        const Int row =
            o.add(o.template shift_right<8>(at), o.shift_left(find.piece(x_bits, log2_nx), log2_nz));
        const Int index =
            o.template times<Spec::rows * Spec::lanes>(o.add(row, find.piece(zeta_bits, log2_nz)));
        hn::Store(index, Lanes::di, cell + i);
        hn::Store(C::narrow(find.position(o.shift_left(x_bits, log2_nx))), narrow, x + i);
        hn::Store(C::narrow(find.position(o.shift_left(zeta_bits, log2_nz))), narrow, z + i);
        inside = inside && hn::AllTrue(d, o.not_negative(found));
    }
    HWY_NOINLINE V with_items_beyond(const Items& items, std::size_t i, V mean) const {
        HWY_ALIGN double values[lanes], g[lanes], t[lanes];
        hn::Store(mean, d, values);
        hn::Store(items.g(i), d, g);
        hn::Store(items.t(i), d, t);
        for (std::size_t j = 0; j < lanes; ++j)
            if (entry[i + j] < 0) values[j] = far_mean_kicks(g[j], t[j]);
        return hn::Load(d, values);
    }
};

#endif

}  // namespace hts::unified_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
