/// Tables built in parts, by several processes or in several goes: nothing that was computed is lost.
///
/// A part is a file of finished slices with their checksums. While a table is built its part stands beside
/// the target, as TARGET.slices; a build that finds one of the same job goes on where it ends. A shard's part
/// is itself the result, and `merged_table` joins the parts of all shards.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tables/table/build_table.hpp"

namespace hts::tables {

/// Part k of N: every N-th slice, from the k-th on.
struct TableShard {
    std::size_t number = 1, count = 1;

    /// "k/N"; hts::Error unless these are whole numbers, k from 1 to N.
    [[nodiscard]] static TableShard from_text(std::string_view text);
    /// Its slices of a table that has so many.
    [[nodiscard]] std::vector<std::size_t> slices(std::size_t all) const;

    friend bool operator==(const TableShard&, const TableShard&) = default;
};

/// What is built.
struct TableJob {
    TableSource source;
    std::vector<double> wavelengths_um;
    TableRequest request;

    friend bool operator==(const TableJob&, const TableJob&) = default;
};

/// The exact model of a job, or of a finished table.
///   tolerance   of its arithmetic
[[nodiscard]] spectral::Reflectance exact_model(const TableSource& source,
                                                std::span<const double> wavelengths_um,
                                                Tolerance tolerance = Tolerance{
                                                    hts::accuracy::finest_tolerance});
/// As exact as building the job needs: a hundredth of its tolerance, at most 1e-6.
[[nodiscard]] spectral::Reflectance exact_model(const TableJob& job);

/// Computes slices, in order, and hands each to `keep`; on all cores unless something else is given to
/// build_table_file.
using SliceWorker =
    std::function<void(const TablePlan& plan, std::span<const std::size_t> slices,
                       const std::function<void(std::size_t, const std::vector<double>&)>& keep)>;
[[nodiscard]] SliceWorker threads_worker(const spectral::Reflectance& exact);

/// Builds a table, or a shard's part of it, into a file that appears when it is whole.
///   path   hts::Error where it cannot be written
void build_table_file(const spectral::Reflectance& exact, const TableJob& job,
                      const std::filesystem::path& path, const TableShard& shard, const SliceWorker& worker,
                      const TableProgress& progress = {});

/// Joins the parts of all shards. hts::Error that names the files that are broken or of another job, or the
/// parts that lack.
void merge_table_file(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& path);

}  // namespace hts::tables
