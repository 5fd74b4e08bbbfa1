#include "cli/answers/charts/timed_evaluator.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "spectral/processor_time.hpp"
#include "spectral/statistics.hpp"

namespace hts::cli {

const spectral::WavelengthGrid& chart_wavelengths() {
    static const auto grid = spectral::WavelengthGrid::from_micrometres({0.46, 0.54, 0.62, 0.70});
    return grid;
}

Evaluator evaluator_of(spectral::Reflectance reflectance) {
    return [reflectance = std::move(reflectance)](const DirectionPair& pair, std::span<double> values) {
        reflectance.brdf(pair, values);
    };
}

double nanoseconds(const Evaluator& evaluator, std::span<const DirectionPair> pairs) {
    constexpr std::size_t passes = 15;
    std::array<double, chart_channels> spectrum{};
    double sum = 0;  // keeps the calls alive
    std::array<double, passes> times{};
    for (double& time : times) {
        const double start = spectral::thread_seconds();
        for (const DirectionPair& pair : pairs) {
            evaluator(pair, spectrum);
            sum += spectrum[0];
        }
        time = (spectral::thread_seconds() - start) * 1e9 / static_cast<double>(pairs.size());
    }
    return std::isnan(sum) ? 0 : spectral::median({times.begin(), times.end()});
}

}  // namespace hts::cli
