/// Size against error of ways to tabulate a lobe: why tables are laid out as
/// tables/table/table_coordinates.hpp says.
#pragma once

#include <string>
#include <vector>

#include "tables/table/build_table.hpp"

namespace hts::bench {

/// A table of one way and size.
struct TableSize {
    std::string way;
    double bytes;
    /// The largest, by the measure of tables/table/table.hpp, over random pairs and five of the wavelengths.
    double error;
};

/// Every way at several sizes: plain grids of angles, linear in f and cubic in ln f, the half-vector angles
/// of MERL files, the coordinates of this library with all wavelengths, and the same with a basis of few
/// spectra, which is what it writes.
///   pairs, seed   of the random directions, as in tables::table_error
[[nodiscard]] std::vector<TableSize> table_sizes(const spectral::Reflectance& exact, std::size_t pairs,
                                                 std::uint64_t seed);

/// A gnuplot script that draws them.
[[nodiscard]] std::string table_sizes_script(const std::vector<TableSize>& sizes, const std::string& surface);

}  // namespace hts::bench
