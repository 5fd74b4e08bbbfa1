#include "bench/charts/chart.hpp"

#include <cmath>

#include "bench/charts/chart_timing.hpp"

namespace hts::bench {
namespace {

std::vector<AccuracyPoint> swept(const ChartSettings& settings, const ChartProgress& progress) {
    std::vector<AccuracyPoint> result;
    for (const Regime regime : regimes) {
        progress(std::string{"errors, "} + title(regime));
        const ReferencePoints points = with_reference(random_inputs(regime, settings.points, settings.seed));
        for (const ChartMethod& method : chart_methods()) {
            result.push_back({&method, regime, errors(method, points), 0});
        }
    }
    return result;
}

std::vector<ErrorMap> mapped(const ChartSettings& settings, const ChartProgress& progress) {
    progress("errors over the (g, t/g) plane");
    const PlaneReference plane = plane_reference(settings.grid);
    std::vector<ErrorMap> maps;
    for (const ChartMethod& method : chart_methods()) {
        if (!method.batch) maps.push_back({&method, plane_errors(method, plane)});
    }
    return maps;
}

/// Fills in the times of the sweep; every regime with inputs of its own.
void time_sweep(std::vector<AccuracyPoint>& points, const ChartSettings& settings,
                const ChartProgress& progress) {
    for (const Regime regime : regimes) {
        progress(std::string{"times, "} + title(regime));
        const PhiInputs inputs = random_inputs(regime, settings.timing_inputs, settings.seed + 1);
        for (AccuracyPoint& point : points) {
            if (point.regime != regime) continue;
            point.nanoseconds = nanoseconds(*point.method, inputs, settings.seconds);
        }
    }
}

/// t/g spread over 0 ... 10.
PhiInputs spread_at(double g, std::size_t count) {
    constexpr double golden = 0.6180339887498949;  // its multiples fill 0 ... 1 evenly, in no order
    PhiInputs inputs;
    for (std::size_t i = 0; i < count; ++i) {
        inputs.g.push_back(g);
        inputs.t.push_back(10 * g * std::fmod(golden * static_cast<double>(i), 1));
        inputs.weights.push_back(1);
    }
    return inputs;
}

struct PhaseVariance {
    double g;
    PhiInputs inputs;
    ReferencePoints points;  ///< a few of the inputs
};

/// Half decades from 1e-3 to 1e8.
std::vector<PhaseVariance> phase_variances() {
    std::vector<PhaseVariance> result;
    for (int half_decade = -6; half_decade <= 16; ++half_decade) {
        const double g = std::pow(10, half_decade / 2.0);
        result.push_back({g, spread_at(g, 1 << 14), with_reference(spread_at(g, 10))});
    }
    return result;
}

/// Each method from small to large g, until a value takes longer than there is for measuring it.
std::vector<CostPoint> timed(const ChartSettings& settings, const ChartProgress& progress) {
    progress("times against g");
    const std::vector<PhaseVariance> variances = phase_variances();
    std::vector<CostPoint> cost;
    for (const ChartMethod& method : chart_methods()) {
        double last = 0;
        for (const PhaseVariance& variance : variances) {
            if (last > 1e9 * settings.seconds) break;
            last = nanoseconds(method, variance.inputs, settings.seconds);
            cost.push_back({&method, variance.g, last, errors(method, variance.points).fails()});
        }
    }
    return cost;
}

}  // namespace

ChartSettings ChartSettings::quick(std::uint64_t seed) {
    return {2000, 1 << 17, {40, 25}, 0.03, seed};
}

ChartSettings ChartSettings::full(std::uint64_t seed) {
    return {20000, 1 << 17, {80, 50}, 0.1, seed};
}

ChartData measured_charts(const ChartSettings& settings, const ChartProgress& progress) {
    ChartData data{settings, machine(), swept(settings, progress), mapped(settings, progress), {}};
    time_sweep(data.accuracy, settings, progress);
    data.cost = timed(settings, progress);
    return data;
}

}  // namespace hts::bench
