/// Every model of the library, and lookup tables, against He-Torrance: how close one comes, and what it
/// costs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/report/report.hpp"

namespace hts::cli {

/// A model on a surface, at the wavelengths of the chart.
struct ModelPoint {
    std::string surface, model;
    double median, high;  ///< |f - f_he|/(f_he + peak/100), median and 99 % over random pairs
    double nanoseconds;   ///< of a pair of directions at all four wavelengths, one thread
    std::size_t bytes;    ///< of the tables that it reads; 0 if none
};

struct ModelChart {
    std::vector<ModelPoint> points;
    std::uint64_t seed;
    std::string machine;
};

/// Fits each model to He-Torrance on four surfaces, from nearly smooth to very rough, builds tables of it,
/// measures the error on directions that neither ever saw, and then the times.
///   quick      fewer directions and starts
///   progress   is told each step, model_chart_steps() in all
[[nodiscard]] std::size_t model_chart_steps();
[[nodiscard]] ModelChart measured_models(bool quick, std::uint64_t seed,
                                         const std::function<void(const std::string& step)>& progress);

/// A panel per surface, error against time.
[[nodiscard]] validation::Figure model_figure(const ModelChart& chart);

}  // namespace hts::cli
