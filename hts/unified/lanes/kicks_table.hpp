// What the tables of the mean number of kicks look like, written by
// hts/unified/lanes/generate_kicks_tables.cpp.
//
//   H = 1/beta - 1, the harmonic mean of the kicks m beyond the first; beta = 1/(1 + H), w = H/(1 + H)
//   H = g 2^P(x, z)
//
// in the cells of phi_table.hpp: the same rows of g and octaves of 1 + t or v, cut anew. Both beta and w keep
// their relative error, where w is small too, which shadowing at grazing directions multiplies.
#pragma once

#include <cstdint>

#include "hts/phi/tables/phi_table.hpp"

namespace hts::unified_detail {

/// For the tables Low and Medium of Phi.
///   error   of H, relative
// clang-format off
struct KicksLow    : phi_detail::Low    { static constexpr double error = 1e-4; };
struct KicksMedium : phi_detail::Medium {
    static constexpr double error = 1e-7;
    using Coefficient = double;
    static constexpr int rows = 8, lanes = 8;
};
// clang-format on

template <class Spec>
struct KicksTable {
    const typename Spec::Coefficient* cells;
    const std::int64_t* directory;  // packed entries or no_entry, as of Phi
    std::size_t bytes;
};

extern const KicksTable<KicksLow> kicks_low;
extern const KicksTable<KicksMedium> kicks_medium;

template <class Spec>
const KicksTable<Spec>& kicks_table() noexcept;
template <>
inline const KicksTable<KicksLow>& kicks_table<KicksLow>() noexcept {
    return kicks_low;
}
template <>
inline const KicksTable<KicksMedium>& kicks_table<KicksMedium>() noexcept {
    return kicks_medium;
}

}  // namespace hts::unified_detail
