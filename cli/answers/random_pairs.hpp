/// The library's batch call on random directions: how fast it is.
#pragma once

#include <cstdint>

#include "cli/io/summary.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::cli {

/// What it took in all, drawing too, and the mean of its values, by which runs can be compared.
struct RandomPairsResult {
    Summary summary;
    double mean_brdf;  ///< [1/sr]
};

/// BRDF spectra of `count` pairs, both directions uniform in solid angle over the hemisphere.
///   seed   the same pairs, and the same mean, on every machine and for any number of threads
[[nodiscard]] RandomPairsResult evaluate_random_pairs(const spectral::Reflectance& reflectance,
                                                      std::uint64_t count, std::uint64_t seed);

}  // namespace hts::cli
