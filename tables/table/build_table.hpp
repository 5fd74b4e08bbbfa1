/// Makes tables with a promised error: see table.hpp for what is promised.
///
///     const auto exact = material.at(wavelengths, {.tolerance = Tolerance{1e-9}});
///     const Table table = build_table(*exact, {reflector.name()}, {.tolerance = 1e-3});
///
/// In three steps, each deterministic: the same bytes for any number of threads, shards or interruptions.
///   plan     a basis of spectra grows until every random direction's spectrum is a sum of them; the number
///            of nodes of each axis until the error on random directions meets three quarters of the
///            tolerance, and then shrinks as far as it may: half as many nodes on any axis would fail
///   slices   exact values at the nodes of one grazing angle, in any order, on
///            machines of one instruction set
///   finish   splines, the small curves, and the error measured on random directions, the last of several
///            sets that the plan was tried on; where it misses the tolerance, slices of a denser plan;
///            `table_error` with another seed is independent
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tables/table/table.hpp"

namespace hts::tables {

/// What is asked of a table.
struct TableRequest {
    double tolerance = 1e-3;  ///< 1e-9 ... 0.5
    std::uint64_t seed = 1;   ///< of the random directions, below 2^52
    bool polarised = false;   ///< the Mueller matrix too
    std::size_t largest_bytes = std::size_t{1} << 30;

    friend bool operator==(const TableRequest&, const TableRequest&) = default;
};

/// What was decided before the first slice.
struct TablePlan {
    TableRequest request;
    TableSpacing spacing;
    TableNodes nodes;           ///< of the lobe; the curves' are found at the end
    std::vector<double> floor;  ///< [1/sr], one value per wavelength
    std::vector<double> basis;  ///< orthonormal spectra, one after the other; ln(f + floor) is a sum of them
    std::size_t refinements = 0;  ///< times that a finished table's error was above the tolerance

    [[nodiscard]] std::size_t slices() const noexcept { return nodes.grazing; }
    friend bool operator==(const TablePlan&, const TablePlan&) = default;
};

/// What is done, of how much.
using TableProgress = std::function<void(const std::string& step, double share)>;

/// Error of a table, measured: half of the pairs uniform in solid angle up to 88 deg, half with theta_i
/// uniform and the half vector's slope spread over every scale from 0.003 to 3, which no lobe escapes. Where
/// the table is polarised the elements of the Mueller matrix count, each by the same measure.
///   table, exact   of the same wavelengths, else hts::Error
[[nodiscard]] TableError table_error(const spectral::Reflectance& table, const spectral::Reflectance& exact,
                                     std::uint64_t pairs, std::uint64_t seed);

/// hts::Error where the surface is not isotropic or not reciprocal, has no polarisation that was asked for,
/// or would take more than largest_bytes.
[[nodiscard]] TablePlan plan_table(const spectral::Reflectance& exact, const TableRequest& request,
                                   const TableProgress& progress = {});

/// Values of one slice, the components of ln(f + floor) in the basis, in the order of the file.
[[nodiscard]] std::vector<double> table_slice(const spectral::Reflectance& exact, const TablePlan& plan,
                                              std::size_t slice);

/// The bytes of the file, from all slices in order, whatever its error.
struct MeasuredTable {
    std::string bytes;
    TableError error;
};
[[nodiscard]] MeasuredTable measured_table(const spectral::Reflectance& exact, const TableSource& source,
                                           const TablePlan& plan, std::vector<std::vector<double>> slices);

/// All slices of a plan, in order.
using SliceSource = std::function<std::vector<std::vector<double>>(const TablePlan& plan)>;
/// Computes them, on all cores.
[[nodiscard]] SliceSource computed_slices(const spectral::Reflectance& exact);

/// The bytes of the file. Where the measured error is above the tolerance, slices of a plan with more nodes
/// on every axis are asked for, by the same rule everywhere; hts::Error after three such rounds, or where the
/// file would be larger than largest_bytes.
[[nodiscard]] std::string finished_table(const spectral::Reflectance& exact, const TableSource& source,
                                         TablePlan plan, const SliceSource& slices);

/// All of it.
[[nodiscard]] Table build_table(const spectral::Reflectance& exact, const TableSource& source,
                                const TableRequest& request, const TableProgress& progress = {});

}  // namespace hts::tables
