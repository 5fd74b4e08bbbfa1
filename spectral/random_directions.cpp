#include "spectral/random_directions.hpp"

#include <cmath>
#include <numbers>

namespace hts::spectral {

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

Direction random_direction(std::mt19937_64& random, double lowest_cosine) {
    const double cosine = 1 - (1 - lowest_cosine) * uniform(random);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double azimuth = 2 * std::numbers::pi * uniform(random);
    return Direction::from_vector({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
}

}  // namespace hts::spectral
