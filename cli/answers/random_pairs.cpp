#include "cli/answers/random_pairs.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "hts/sampling/random.hpp"
#include "spectral/jobs/progress.hpp"

namespace hts::cli {
namespace {

constexpr std::uint64_t evaluations_per_chunk = 1 << 20;  // bounds the memory, some 10 MB

std::vector<spectral::DirectionPair> random_pairs(Random& random, std::uint64_t count) {
    std::vector<spectral::DirectionPair> pairs;
    pairs.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Direction in = random.direction();
        pairs.push_back({in, random.direction()});
    }
    return pairs;
}

}  // namespace

RandomPairsResult evaluate_random_pairs(const spectral::Reflectance& reflectance, std::uint64_t count,
                                        std::uint64_t seed) {
    const std::size_t wavelengths = reflectance.size();
    Random random{seed};
    const std::uint64_t per_chunk = std::max<std::uint64_t>(1, evaluations_per_chunk / wavelengths);
    std::vector<double> values;
    Stopwatch watch;
    double sum = 0;
    const spectral::Job job{"", (count + per_chunk - 1) / per_chunk};
    for (std::uint64_t done = 0; done < count; done += per_chunk) {
        const auto pairs = random_pairs(random, std::min(per_chunk, count - done));
        values.resize(pairs.size() * wavelengths);
        watch.start();
        reflectance.brdf(pairs, values);
        watch.stop();
        sum = std::accumulate(values.begin(), values.end(), sum);
        job.done();
    }
    const double evaluations = static_cast<double>(count) * static_cast<double>(wavelengths);
    return {{count, wavelengths, watch.seconds()}, sum / evaluations};
}

}  // namespace hts::cli
