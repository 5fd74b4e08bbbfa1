// What the coefficient tables of phi look like, for the evaluator and for the program that fills them
// (hts/phi/tables/generate_phi_tables.cpp).
//
//   Phi = factor 2^(Q(x, z) + W(v) - multiplier F(v))
//
// Where the saddle point leads, factor = 1/g, multiplier = t/g, v = 1 + 2e t/g^2. With u = t/g^2 and w
// exp(2w) = u the saddle's exponent g (e^w (1 - 2w) - 1) is -(t/g) F ln 2, F = (1 - e^w (1 - 2w)) / (u ln 2):
// F(0) = 1/ln 2, so nothing cancels. W = -log2(e^w sqrt(1 + 2w)). F and W depend on v alone, so neither w nor
// a logarithm is computed; W_0(2u) branches at v = 0, hence octaves of v converge alike. Q = log2(Phi /
// saddle) is what is left, smooth and small. For small g and t the first terms lead: factor = g, multiplier =
// t, F = log2 e, W = 0, Q = log2(Phi e^t / g).
#pragma once

#include <cstddef>
#include <cstdint>

namespace hts::phi_detail {

// One table per tolerance.
//   error                what Phi is allowed
//   rows, lanes          a cell holds rows x lanes coefficients: powers of x by powers of z
//   emin, emax           octaves of g with cells of their own; below emin one row linear in g, where t < 7;
//                        from 2^emax on one row in 1/g
//   line_rows, line_sub  the pieces of F and W: coefficients, an even number, and log2 of the pieces per
//                        octave of v
// clang-format off
struct Low    { using Coefficient = float;  using Line = float;  static constexpr double error = 1e-3;
                static constexpr int rows = 4,  lanes = 4,  emin = -6, emax = 3,
                                     line_rows = 6,  line_sub = 2, exp_degree = 3; };
struct Medium { using Coefficient = float;  using Line = double; static constexpr double error = 1e-6;
                static constexpr int rows = 6,  lanes = 4,  emin = -7, emax = 4,
                                     line_rows = 6,  line_sub = 3, exp_degree = 5; };
struct High   { using Coefficient = double; using Line = double; static constexpr double error = 1e-12;
                static constexpr int rows = 12, lanes = 12, emin = -7, emax = 5,
                                     line_rows = 10, line_sub = 3, exp_degree = 10; };
// clang-format on

inline constexpr double least_log_phi = -660;  // cells are fitted where ln Phi is more: above 1e-287
inline constexpr int most_terms = 64;          // of the series below 2^emin, where Phi > 1e-287
inline constexpr int octaves_per_row = 20;
inline constexpr double v_scale = 5.43656365691809;  // 2 e
inline constexpr double root2 = 1.4142135623730951;
/// Position along an octave of g: zeta = 1/2 + zeta_scale (m - sqrt 2)/(m + sqrt 2), m the mantissa; nearly
/// log2 m, and just inside [0, 1].
inline constexpr double zeta_scale = 0x1.7504f32db7c35p+1;

/// A piece of an octave: its cells are those from `first` on, pieces in x by pieces in z.
struct Entry {
    int first;
    bool saddle;
    int log2_x, log2_z;  // of the numbers of pieces
};

inline constexpr std::int64_t no_entry = -1;
inline constexpr std::int64_t saddle_bit = 128;

constexpr std::int64_t packed(const Entry& e) noexcept {
    return std::int64_t{e.first} << 8 | (e.saddle ? saddle_bit : 0) | std::int64_t{e.log2_x} << 3 |
           std::int64_t{e.log2_z};
}

template <class Spec>
struct Table {
    const typename Spec::Coefficient* cells;
    const typename Spec::Line* lines;  // pieces of F and of W, interleaved; the last: F = log2 e, W = 0
    const std::int64_t* directory;  // packed entries or no_entry: by row of g, then by octave of 1 + t (of v
                                    // in the last row)
    int line_pieces;                // without the last
    std::size_t bytes;
    const std::int32_t* narrow_directory = nullptr;  // the same for lanes of single precision, of Low alone
};

extern const Table<Low> table_low;
extern const Table<Medium> table_medium;
extern const Table<High> table_high;

template <class Spec>
const Table<Spec>& table() noexcept;
template <>
inline const Table<Low>& table<Low>() noexcept {
    return table_low;
}
template <>
inline const Table<Medium>& table<Medium>() noexcept {
    return table_medium;
}
template <>
inline const Table<High>& table<High>() noexcept {
    return table_high;
}

}  // namespace hts::phi_detail
