/// The three charts of speed against accuracy: measured here, written by chart_tables.hpp and
/// chart_script.hpp.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/charts/machine.hpp"
#include "bench/phi/accuracy_sweep.hpp"

namespace hts::bench {

struct ChartSettings {
    std::size_t points;         ///< of each regime's sweep
    std::size_t timing_inputs;  ///< drawn for each regime's times
    PlaneGrid grid;             ///< of the maps
    double seconds;             ///< for each time
    std::uint64_t seed;

    /// Within a minute.
    [[nodiscard]] static ChartSettings quick(std::uint64_t seed);
    /// Within ten.
    [[nodiscard]] static ChartSettings full(std::uint64_t seed);
};

/// A method in a regime.
struct AccuracyPoint {
    const ChartMethod* method;
    Regime regime;
    ErrorSummary errors;
    double nanoseconds;
};

/// A method over the (g, t/g) plane.
struct ErrorMap {
    const ChartMethod* method;
    std::vector<double> errors;
};

/// A method at one g, t/g uniform in 0 ... 10.
struct CostPoint {
    const ChartMethod* method;
    double g, nanoseconds;
    bool fails;  ///< has no correct digit at some of a few t
};

struct ChartData {
    ChartSettings settings;
    Machine machine;
    std::vector<AccuracyPoint> accuracy;
    std::vector<ErrorMap> maps;
    std::vector<CostPoint> cost;
};

/// Told what is being done, once per step, of chart_steps in all.
inline constexpr std::size_t chart_steps = 2 * std::size(regimes) + 2;
using ChartProgress = std::function<void(const std::string& step)>;

/// Runs the sweeps on all cores and then the times on one.
[[nodiscard]] ChartData measured_charts(const ChartSettings& settings, const ChartProgress& progress);

}  // namespace hts::bench
