// Where (g, t) lies in a table of Phi, in lanes; included once per instruction set.
#if defined(HTS_PHI_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_PHI_KERNEL_INL
#undef HTS_PHI_KERNEL_INL
#else
#define HTS_PHI_KERNEL_INL
#endif

#include "hts/lanes/lanes-inl.hpp"
#include "hts/phi/tables/phi_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::phi_detail::HWY_NAMESPACE {

/// What phi_table.hpp's formula needs besides the coefficients.
template <class Lanes>
struct Place {
    typename Lanes::Real multiplier, factor;
    typename Lanes::Real x, z, line_x;  // positions within the pieces, each in [-1/2, 1/2]
    typename Lanes::Int cell, line;     // offsets into cells and lines
    typename Lanes::Flag inside;        // false where the table has no cell
};

/// Finds the place by the exponent and the leading mantissa bits of three coordinates: the pieces of an
/// octave are 2^k of equal width, so the next k bits are the piece and the rest is the position within it.
template <class Spec, class Lanes>
struct Finder {
    using Real = typename Lanes::Real;
    using Int = typename Lanes::Int;
    using Mask = typename Lanes::Mask;
    using F = lanes::Format<typename Lanes::Number>;
    static constexpr std::int64_t mantissa = (std::int64_t{1} << F::mantissa) - 1;
    static constexpr std::int64_t bias = F::bias;
    static constexpr double below_one = 1 - 4 * F::ulp;  // keeps 1 + zeta below 2
    static constexpr double low = lanes::power_of_2(Spec::emin), high = lanes::power_of_2(Spec::emax);

    const Lanes& o;

    HWY_INLINE Int mantissa_bits(Int bits) const { return o.bit_and(bits, o.integer(mantissa)); }
    HWY_INLINE Real with_exponent_0(Int bits) const {
        return o.from_bits(o.bit_or(mantissa_bits(bits), o.integer(bias << F::mantissa)));
    }
    HWY_INLINE Int exponent(Int bits) const { return o.template shift_right<F::mantissa>(bits); }
    /// The piece, of 2^log2_pieces, and the position within it.
    HWY_INLINE Int piece(Int bits, Int log2_pieces) const {
        return o.shift_right(mantissa_bits(bits), o.sub(o.integer(F::mantissa), log2_pieces));
    }
    HWY_INLINE Real position(Int shifted) const { return o.sub(with_exponent_0(shifted), o.real(1.5)); }

    /// Octaves of g; 0 below them, the last above.
    HWY_INLINE Int row(Int g_bits) const {
        return o.clamp(o.sub(exponent(g_bits), o.integer(bias + Spec::emin - 1)), 0,
                       Spec::emax - Spec::emin + 1);
    }
    /// 1 + zeta, which runs from 1 to 2 through a row.
    HWY_INLINE Real along_row(Real g, Int g_bits, Real inverse_g, Mask top) const {
        const Real m = with_exponent_0(g_bits);
        const Real moebius = o.divide(o.sub(m, o.real(root2)), o.add(m, o.real(root2)));
        const Real octave = o.mul_add(moebius, o.real(zeta_scale), o.real(1.5));
        const Real end =
            o.mul_add(o.select(top, inverse_g, g),
                      o.select(top, o.real(high * below_one), o.real(below_one / low)), o.real(1.0));
        return o.select(o.either(top, o.less(g, o.real(low))), end, octave);
    }
    /// NaN lands in the last octave, which is empty in every row.
    HWY_INLINE Int octave(Int x_bits) const {
        return o.unsigned_min(o.sub(exponent(x_bits), o.integer(bias)), octaves_per_row - 1);
    }
    HWY_INLINE Int line_piece(Int v_bits, const Table<Spec>& table) const {
        const Int piece = o.sub(o.template shift_right<F::mantissa - Spec::line_sub>(v_bits),
                                o.integer(bias << Spec::line_sub));
        return o.unsigned_min(piece, table.line_pieces - 1);
    }
};

/// A point's coordinates, and where the directory says more.
template <class Lanes>
struct Coordinates {
    typename Lanes::Real v;
    typename Lanes::Int x_bits, zeta_bits;
    typename Lanes::Int slot;  // in the directory
};

/// inverse_g: 1/g, to a rounding error or two.
template <class Spec, class Lanes>
HWY_INLINE Coordinates<Lanes> coordinates(const Lanes& o, typename Lanes::Real g, typename Lanes::Real t,
                                          typename Lanes::Real inverse_g) {
    const Finder<Spec, Lanes> find{o};
    const auto v = o.mul_add(o.mul(t, o.real(v_scale)), o.mul(inverse_g, inverse_g), o.real(1.0));
    const auto top = o.greater_equal(g, o.real(Finder<Spec, Lanes>::high));
    const auto g_bits = o.bits(g);
    const auto x_bits = o.bits(o.select(top, v, o.add(t, o.real(1.0))));
    return {v, x_bits, o.bits(find.along_row(g, g_bits, inverse_g, top)),
            o.add(o.template times<octaves_per_row>(find.row(g_bits)), find.octave(x_bits))};
}

/// found: the directory's entry at `at`'s slot.
template <class Spec, class Lanes>
HWY_INLINE Place<Lanes> place_at(const Lanes& o, const Table<Spec>& table, typename Lanes::Real g,
                                 typename Lanes::Real t, typename Lanes::Real inverse_g,
                                 const Coordinates<Lanes>& at, typename Lanes::Int found) {
    using Int = typename Lanes::Int;
    const Finder<Spec, Lanes> find{o};
    const Int entry = o.max0(found);  // lanes outside read the first cell; their result is not used
    const auto saddle = o.any_bit(entry, saddle_bit);
    Place<Lanes> p;
    p.multiplier = o.select(saddle, o.mul(t, inverse_g), t);
    p.inside = o.not_negative(o.bit_or(found, o.bit_or(o.bits(g), o.bits(t))));
    p.factor = o.select(saddle, inverse_g, g);
    const Int log2_nx = o.bit_and(o.template shift_right<3>(entry), o.integer(15));
    const Int log2_nz = o.bit_and(entry, o.integer(7));
    const Int jx = find.piece(at.x_bits, log2_nx);
    const Int jz = find.piece(at.zeta_bits, log2_nz);
    p.x = find.position(o.shift_left(at.x_bits, log2_nx));
    p.z = find.position(o.shift_left(at.zeta_bits, log2_nz));
    const Int first = o.template shift_right<8>(entry);
    p.cell = o.template times<Spec::rows * Spec::lanes>(o.add(o.add(first, o.shift_left(jx, log2_nz)), jz));
    const Int v_bits = o.bits(at.v);
    p.line = o.template times<2 * Spec::line_rows>(
        o.select_integer(saddle, find.line_piece(v_bits, table), o.integer(table.line_pieces)));
    p.line_x = find.position(o.template shift_left<Spec::line_sub>(v_bits));
    return p;
}

template <class Spec, class Lanes>
HWY_INLINE Place<Lanes> place(const Lanes& o, const Table<Spec>& table, typename Lanes::Real g,
                              typename Lanes::Real t, typename Lanes::Real inverse_g,
                              const Coordinates<Lanes>& at) {
    if constexpr (sizeof(typename Lanes::Number) == 4)
        return place_at<Spec>(o, table, g, t, inverse_g, at, o.gather(table.narrow_directory, at.slot));
    else
        return place_at<Spec>(o, table, g, t, inverse_g, at, o.gather(table.directory, at.slot));
}

template <class Spec, class Lanes>
HWY_INLINE Place<Lanes> place(const Lanes& o, const Table<Spec>& table, typename Lanes::Real g,
                              typename Lanes::Real t, typename Lanes::Real inverse_g) {
    return place(o, table, g, t, inverse_g, coordinates<Spec>(o, g, t, inverse_g));
}

template <class Spec, class Lanes>
HWY_INLINE Place<Lanes> place(const Lanes& o, const Table<Spec>& table, typename Lanes::Real g,
                              typename Lanes::Real t) {
    return place(o, table, g, t, o.divide(o.real(1.0), g));
}

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
