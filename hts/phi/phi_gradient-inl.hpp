// Derivatives of the polynomials in the table of Phi, one pair at a time. Included once per instruction set.
#if defined(HTS_PHI_GRADIENT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HTS_PHI_GRADIENT_INL
#undef HTS_PHI_GRADIENT_INL
#else
#define HTS_PHI_GRADIENT_INL
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "hts/phi/phi_cells-inl.hpp"
#include "hts/phi/phi_far.hpp"
#include "hts/phi/tables/phi_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace hts::phi_detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace hl = lanes::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// A value and its derivatives by the positions within its piece.
struct CellSlopes {
    double value, by_x, by_z;
};

/// Horner's rule for the value and the derivative at once.
template <std::size_t size>
HWY_INLINE CellSlopes slopes_along_z(const std::array<double, size>& value,
                                     const std::array<double, size>& by_x, double z) {
    CellSlopes s{value[size - 1], by_x[size - 1], 0};
    for (std::size_t j = size - 1; j-- > 0;) {
        s.by_z = s.by_z * z + s.value;
        s.value = s.value * z + value[j];
        s.by_x = s.by_x * z + by_x[j];
    }
    return s;
}

/// Q of a cell.
HWY_INLINE CellSlopes cell_slopes(const double* cell, double x, double z) {
    constexpr hn::CappedTag<double, 4> pack{};
    constexpr std::size_t width = hn::MaxLanes(pack), packs = High::lanes / width;
    hn::Vec<decltype(pack)> value[packs], slope[packs];
    const auto vx = hn::Set(pack, x);
    HTS_UNROLL
    for (std::size_t k = 0; k < packs; ++k) {
        value[k] = hn::Load(pack, cell + (High::rows - 1) * High::lanes + k * width);
        slope[k] = hn::Zero(pack);
    }
    HTS_UNROLL
    for (int i = High::rows - 2; i >= 0; --i) {
        HTS_UNROLL
        for (std::size_t k = 0; k < packs; ++k) {
            slope[k] = hn::MulAdd(slope[k], vx, value[k]);
            value[k] = hn::MulAdd(value[k], vx, hn::Load(pack, cell + i * High::lanes + k * width));
        }
    }
    std::array<double, High::lanes> values, slopes;
    for (std::size_t k = 0; k < packs; ++k) {
        hn::StoreU(value[k], pack, values.data() + k * width);
        hn::StoreU(slope[k], pack, slopes.data() + k * width);
    }
    return slopes_along_z(values, slopes, z);
}

/// F or W, interleaved, and its derivative by the position within its piece.
struct LineSlopes {
    double value, by_x;
};

HWY_INLINE LineSlopes line_slopes(const double* line, double x) {
    LineSlopes s{line[2 * (High::line_rows - 1)], 0};
    for (int i = High::line_rows - 2; i >= 0; --i) {
        s.by_x = s.by_x * x + s.value;
        s.value = s.value * x + line[2 * i];
    }
    return s;
}

/// 2^-e for x = 2^e (1 + ...), by which a position within an octave grows with x.
HWY_INLINE double per_octave(double x) {
    constexpr hl::Plain o{};
    constexpr std::int64_t mantissa = (std::int64_t{1} << 52) - 1;
    return 1 / o.from_bits(o.bits(x) & ~mantissa);
}

/// d zeta / d ln g, zeta the position along a row.
HWY_INLINE double zeta_by_log_g(double g, double inverse_g) {
    constexpr double low = lanes::power_of_2(High::emin), high = lanes::power_of_2(High::emax);
    if (g >= high) return -high * inverse_g;
    if (g < low) return g / low;
    const double m = g * per_octave(g);
    return zeta_scale * 2 * root2 * m / ((m + root2) * (m + root2));
}

HWY_ATTR PhiGradient tabled_gradient(double g, double t) {
    constexpr hl::Plain o{};
    constexpr double high = lanes::power_of_2(High::emax), log_2 = std::numbers::ln2;
    const Table<High>& table = phi_detail::table<High>();
    const double inverse_g = 1 / g;
    const auto at = coordinates<High>(o, g, t, inverse_g);
    const auto entry = o.gather(table.directory, at.slot);
    const auto p = place_at<High>(o, table, g, t, inverse_g, at, entry);
    if (HWY_UNLIKELY(!p.inside || !(g > 0))) return phi_gradient(g, t);
    const bool saddle = (entry & saddle_bit) != 0, top = g >= high;
    const CellSlopes q = cell_slopes(table.cells + p.cell, p.x, p.z);
    const LineSlopes f = line_slopes(table.lines + p.line, p.line_x);
    const LineSlopes w = line_slopes(table.lines + p.line + 1, p.line_x);
    // Q by x = 1 + t or v, and by zeta
    const double v_by_t = v_scale * inverse_g * inverse_g, v_by_log_g = -2 * (at.v - 1);
    const double pieces_x = lanes::power_of_2(static_cast<int>(entry >> 3 & 15));
    const double pieces_z = lanes::power_of_2(static_cast<int>(entry & 7));
    const double q_by_x = q.by_x * pieces_x * per_octave(top ? at.v : 1 + t);
    double by_t = q_by_x * (top ? v_by_t : 1);
    double by_log_g = q_by_x * (top ? v_by_log_g : 0) + q.by_z * pieces_z * zeta_by_log_g(g, inverse_g);
    double log_by_t = 0, log_by_log_g = 0;  // of what is no power of 2
    if (saddle) {
        const double pieces = lanes::power_of_2(High::line_sub) * per_octave(at.v);
        const double by_v = (w.by_x - p.multiplier * f.by_x) * pieces;
        by_t += by_v * v_by_t - f.value * inverse_g;
        by_log_g += by_v * v_by_log_g + p.multiplier * f.value;
        log_by_log_g = -1;
    } else {
        log_by_t = -1;
        log_by_log_g = 1;
    }
    log_by_t += log_2 * by_t;
    log_by_log_g += log_2 * by_log_g;
    const double exponent = q.value + w.value - p.multiplier * f.value;
    const double log = exponent * log_2 + std::log(p.factor);
    if (log < least_log_phi) return phi_gradient(g, t);
    const double value = hl::scaled_exp2<High::exp_degree>(o, exponent, p.factor);
    const double log_by_g = log_by_log_g * inverse_g;
    return {value, value * log_by_g, value * log_by_t, log, log_by_g, log_by_t};
}

#endif

}  // namespace hts::phi_detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
