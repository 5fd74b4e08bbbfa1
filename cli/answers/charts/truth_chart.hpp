/// What a cheaper method, a finer tolerance and another model cost and bring: error against exact scattering
/// beside the time of an evaluation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "validation/scattering/twins/conductor_cases.hpp"

namespace hts::cli {

/// A method in a panel.
struct TruthPoint {
    std::size_t panel;
    std::string method;                   ///< "he", "he_unified", …
    double tolerance;                     ///< of the arithmetic; of a lookup table, that it promises
    validation::Distances median, worst;  ///< over the panel's cases [dB]
    double nanoseconds;                   ///< of a pair of directions at four wavelengths, one thread
};

struct TruthPanel {
    std::string title;
    std::size_t surfaces, cases;
};

struct TruthChart {
    std::vector<TruthPanel> panels;
    std::vector<TruthPoint> points;
    std::uint64_t seed;
    std::string machine;
};

/// Distances from the kept exact lobes of perfect conductors, smooth, intermediate, rough and gentle, and
/// steep, of each method's twin for profiles, and times of the method on a surface of each kind.
///   seed       of the pairs of directions that are timed
///   progress   is told each step, truth_chart_steps() in all
[[nodiscard]] std::size_t truth_chart_steps();
[[nodiscard]] TruthChart measured_truth(std::uint64_t seed,
                                        const std::function<void(const std::string& step)>& progress);

/// A panel per kind of surface.
[[nodiscard]] validation::Figure truth_figure(const TruthChart& chart);

}  // namespace hts::cli
