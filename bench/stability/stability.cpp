#include "bench/stability/stability.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "bench/stability/stability_rows.hpp"
#include "spectral/jobs/progress.hpp"

namespace hts::bench {

std::vector<StabilityResult> stability_suite() {
    std::vector<StabilityResult> all;
    const std::array rows{series_in_floating_point,
                          series_at_large_g,
                          rough_limit_in_the_tail,
                          root_of_roughness,
                          shadowing_cancellation,
                          factors_at_backscatter,
                          frames_along_the_normal,
                          fresnel_cancellation,
                          extreme_lengths,
                          steep_surfaces,
                          energy_of_the_model,
                          single_precision,
                          bad_input};
    const spectral::Job job{"", rows.size()};
    for (const auto row : rows) {
        const std::vector<StabilityResult> results = row().results();
        all.insert(all.end(), results.begin(), results.end());
        job.done();
    }
    return all;
}

bool engine_passes(const std::vector<StabilityResult>& results) {
    constexpr std::size_t rows = 13;
    std::set<int> with_engine;
    for (const StabilityResult& result : results) {
        if (!result.engine) continue;
        if (is_failure(result.verdict)) return false;
        with_engine.insert(result.row);
    }
    return with_engine.size() == rows;
}

std::size_t rival_failures(const std::vector<StabilityResult>& results) {
    return static_cast<std::size_t>(std::count_if(
        results.begin(), results.end(),
        [](const StabilityResult& result) { return !result.engine && is_failure(result.verdict); }));
}

const char* name(Verdict verdict) noexcept {
    constexpr std::array names{"ok",       "model", "too slow", "wrong", "underflow", "no convergence",
                               "infinity", "NaN",   "silent"};
    return names[static_cast<std::size_t>(verdict)];
}

}  // namespace hts::bench
