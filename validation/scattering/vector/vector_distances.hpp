/// How far closed forms are from the exact lobes of rough conducting surfaces that are kept. Private to
/// vector/.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "validation/scattering/vector/vector_results.hpp"

namespace hts::validation {

/// An exact lobe with the models' in its bins.
struct ComparedLobe {
    VectorCase of;
    std::vector<VectorBin> exact;
    std::array<std::vector<Channels>, vector_models.size()> model;

    [[nodiscard]] VectorDistance distance_of(VectorModel from, VectorLight light, VectorRegion region) const {
        return distance(exact, model[static_cast<std::size_t>(from)], light, region);
    }
};

/// What begins each row of the tables that are kept: the case.
[[nodiscard]] std::vector<std::string> case_columns();
[[nodiscard]] std::vector<double> case_row(const VectorCase& of, const VectorSettings& settings);

/// The table of lobes that is kept, and what it holds.
[[nodiscard]] FigureTable vector_lobe_table(const std::vector<VectorResult>& results,
                                            const VectorSettings& settings);
[[nodiscard]] std::vector<ComparedLobe> compared(const FigureTable& lobes);

/// Over all cases, by light and region: median and greatest distance of each model.
[[nodiscard]] ReportTable vector_summary_table(const std::vector<ComparedLobe>& lobes);
/// A row per surface, its lobes by polarisation in and out of the plane of incidence.
[[nodiscard]] Figure vector_lobe_figure(const std::vector<ComparedLobe>& lobes, double theta_i_deg);
/// A panel per model and light, its cells by surface and angle of incidence.
[[nodiscard]] Figure vector_map_figure(const std::vector<ComparedLobe>& lobes);
/// Of the published model and he_unified by case.
[[nodiscard]] FigureTable vector_distance_table(const std::vector<ComparedLobe>& lobes);
/// By case.
[[nodiscard]] ReportTable vector_case_table(const std::vector<ComparedLobe>& lobes);

}  // namespace hts::validation
