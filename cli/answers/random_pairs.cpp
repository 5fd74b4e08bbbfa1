#include "cli/answers/random_pairs.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "hts/sampling/random.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/parallel.hpp"

namespace hts::cli {
namespace {

constexpr std::size_t evaluations_per_chunk = 1 << 20, evaluations_at_once = 1 << 13;  // some 10 MB, 64 kB

/// Pairs that are drawn, evaluated and added up together.
struct Chunk {
    std::size_t pairs = 0;
    std::vector<Random> blocks;  ///< as each block's first draw finds it
    std::vector<double> values;  ///< the spectra of all pairs
};

/// Passes over the numbers of `count` pairs.
void prepare(Random& random, std::size_t count, std::size_t block, Chunk& chunk) {
    chunk.pairs = count;
    chunk.blocks.clear();
    for (std::size_t i = 0; i < count; ++i) {
        if (i % block == 0) chunk.blocks.push_back(random);
        for (int each = 0; each < 4; ++each) static_cast<void>(random.bits());
    }
}

void evaluate(const spectral::Reflectance& reflectance, std::size_t block, std::size_t i, Chunk& chunk) {
    Random random = chunk.blocks[i];
    const std::size_t first = i * block, number = std::min(block, chunk.pairs - first);
    std::vector<spectral::DirectionPair> pairs;
    pairs.reserve(number);
    for (std::size_t j = 0; j < number; ++j) {
        const Direction in = random.direction();
        pairs.push_back({in, random.direction()});
    }
    const std::size_t wavelengths = reflectance.size();
    reflectance.brdf(pairs, std::span{chunk.values}.subspan(first * wavelengths, number * wavelengths));
}

}  // namespace

// Pairs are drawn and values added up in one order for any number of threads: one of them adds up the chunk
// before and prepares the next one while the others draw and evaluate.
RandomPairsResult evaluate_random_pairs(const spectral::Reflectance& reflectance, std::uint64_t count,
                                        std::uint64_t seed) {
    Stopwatch watch;
    watch.start();
    const std::size_t wavelengths = reflectance.size();
    const std::uint64_t per_chunk = std::max<std::uint64_t>(1, evaluations_per_chunk / wavelengths);
    const std::size_t block = std::max<std::size_t>(1, evaluations_at_once / wavelengths);
    Random random{seed};
    Chunk before, now, next;
    double sum = 0;
    prepare(random, std::min(per_chunk, count), block, now);
    const spectral::Job job{"", (count + per_chunk - 1) / per_chunk};
    for (std::uint64_t done = 0; done < count; done += now.pairs) {
        if (done > 0) {
            std::swap(before, now);
            std::swap(now, next);
        }
        now.values.resize(now.pairs * wavelengths);
        spectral::parallel_for(1 + now.blocks.size(), [&](std::size_t i) {
            if (i > 0) return evaluate(reflectance, block, i - 1, now);
            sum = std::accumulate(before.values.begin(), before.values.end(), sum);
            prepare(random, std::min(per_chunk, count - done - now.pairs), block, next);
        });
        job.done();
    }
    sum = std::accumulate(now.values.begin(), now.values.end(), sum);
    watch.stop();
    const double evaluations = static_cast<double>(count) * static_cast<double>(wavelengths);
    return {{count, wavelengths, watch.seconds()}, sum / evaluations};
}

}  // namespace hts::cli
