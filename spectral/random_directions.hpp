/// Random directions that are the same on every machine. Private to the planner, the benches and the command line.
#pragma once

#include <cstdint>
#include <random>

#include "hts/direction.hpp"

namespace hts::spectral {

/// Uniform in [0, 1).
[[nodiscard]] double uniform(std::mt19937_64& random);

/// Uniform in solid angle over the cap about the normal.
///   lowest_cosine   cos theta at its rim, 0 (the hemisphere) ... 1
[[nodiscard]] Direction random_direction(std::mt19937_64& random, double lowest_cosine = 0);

}  // namespace hts::spectral
