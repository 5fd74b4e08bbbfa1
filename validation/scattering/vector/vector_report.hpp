/// Exact scattering by rough conducting surfaces, polarised, in and out of the plane of incidence, and how
/// far closed forms are from it: what `hts truth vector` writes.
#pragma once

#include <filesystem>

#include "tables/sharing/table_parts.hpp"
#include "validation/scattering/ground_truth.hpp"

namespace hts::validation {

/// Solves the realisations of a shard that have no file in the folder yet, the surfaces in turn, so that a
/// run that is stopped has about as many of each.
///   side           of the square [wavelengths]
///   realisations   of each surface
void solve_vector_realisations(const std::filesystem::path& parts, const tables::TableShard& shard,
                               double side, std::size_t realisations);

/// The study of what stands in a folder of solved realisations on squares of that side.
///   hts::Error where a surface has fewer than `fewest_vector_realisations`
[[nodiscard]] GroundTruth vector_study(const std::filesystem::path& parts, double side);
/// Of the study that is kept.
inline constexpr double vector_side = 18;
inline constexpr std::size_t fewest_vector_realisations = 10;
/// One surface on a small patch, six realisations.
[[nodiscard]] GroundTruth quick_vector_study();

/// The section of a report: the quick study beside what is kept; of a full one what is kept alone, since it
/// takes hours.
[[nodiscard]] Section vector_section(Effort effort);

/// Distances of models from the lobes that are kept.
struct KeptVectorDistances {
    FigureTable by_case;  ///< of the published model and he_unified, for spectral/energy/solved_surfaces.hpp
    std::vector<ReportTable> of_all_models;  ///< by light and region, and by case
};
[[nodiscard]] KeptVectorDistances kept_vector_distances();

}  // namespace hts::validation
