#include "cli/random_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace hts::cli {
namespace {

constexpr std::uint64_t evaluations_per_chunk = 1 << 20;  // bounds the memory, some 10 MB

/// Uniform in [0, 1), the same on every machine.
double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

Direction random_direction(std::mt19937_64& random) {
    const double cosine = 1 - uniform(random);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double azimuth = 2 * std::numbers::pi * uniform(random);
    return Direction::from_vector({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
}

std::vector<spectral::DirectionPair> random_pairs(std::mt19937_64& random, std::uint64_t count) {
    std::vector<spectral::DirectionPair> pairs;
    pairs.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Direction in = random_direction(random);
        pairs.push_back({in, random_direction(random)});
    }
    return pairs;
}

}  // namespace

RandomPairsResult evaluate_random_pairs(const spectral::SpectralReflectance& reflectance, std::uint64_t count,
                                        std::uint64_t seed) {
    std::mt19937_64 random{seed};
    const std::uint64_t per_chunk = std::max<std::uint64_t>(1, evaluations_per_chunk / reflectance.size());
    std::vector<double> values;
    Stopwatch watch;
    double sum = 0;
    for (std::uint64_t done = 0; done < count; done += per_chunk) {
        const auto pairs = random_pairs(random, std::min(per_chunk, count - done));
        values.resize(pairs.size() * reflectance.size());
        watch.start();
        reflectance.brdf(pairs, values);
        watch.stop();
        sum = std::accumulate(values.begin(), values.end(), sum);
    }
    const double evaluations = static_cast<double>(count) * static_cast<double>(reflectance.size());
    return {{count, reflectance.size(), watch.seconds()}, sum / evaluations};
}

}  // namespace hts::cli
