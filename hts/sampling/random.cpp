#include "hts/sampling/random.hpp"

#include <numbers>

namespace hts {

Direction Random::direction(double lowest_cosine) {
    const double cosine = 1 - (1 - lowest_cosine) * uniform();
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double azimuth = 2 * std::numbers::pi * uniform();
    return Direction::from_vector({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
}

}  // namespace hts
