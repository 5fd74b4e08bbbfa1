/// Random inputs of the models; those where arithmetic is delicate come more often than chance would bring
/// them.
#pragma once

#include <sstream>
#include <string>

#include "comparison.hpp"
#include "hts/he_torrance_spectrum.hpp"

namespace hts::testing {

/// Even polar angles, now and then the normal, the horizon and what is close to them.
inline Direction any_direction(Random& random) {
    const double phi = random.uniform(-180, 180);
    const double pick = random.uniform(0, 8);
    if (pick < 1) return Direction::from_degrees(random.one_of({0, 1e-9, 45, 89.99, 89.9999, 90}), phi);
    if (pick < 2) return Direction::from_degrees(90 - random.logarithmic(1e-6, 10), phi);
    return Direction::from_degrees(random.uniform(0, 90), phi);
}

/// Any two directions, now and then the mirror's, backscatter's, or close to the mirror's.
inline DirectionPair any_pair(Random& random) {
    const Direction in = any_direction(random);
    const double pick = random.uniform(0, 8);
    if (pick < 1) return {in, in.mirror()};
    if (pick < 2) return {in, in};
    if (pick < 3) {
        const Vector3 near = in.mirror().vector();
        const double step = random.logarithmic(1e-12, 0.1);
        return {in, Direction::from_vector({near.x + step, near.y - step / 3, near.z + step / 2})};
    }
    return {in, any_direction(random)};
}

inline RefractiveIndex any_index(Random& random) {
    const double pick = random.uniform(0, 4);
    if (pick < 1) return {1 + random.one_of({0, 1e-12, 1e-6, -1e-6}), random.one_of({0, 1e-12, 1e-6})};
    if (pick < 2) return {random.uniform(0.3, 3), 0};  // below 1: total reflection
    return {random.logarithmic(0.02, 20), random.logarithmic(1e-3, 50)};
}

/// For WorstCase: where it was.
inline std::string described(const DirectionPair& p, const Surface& s, const SpectralSample& sample) {
    std::ostringstream text;
    text.precision(17);
    text << "cos " << p.in.cos_theta() << ", " << p.out.cos_theta() << ", sigma0 " << s.rms_roughness()
         << ", tau " << s.correlation_length() << ", lambda " << sample.wavelength.micrometres() << ", N "
         << sample.index.substrate().n() << " + " << sample.index.substrate().k() << 'i';
    return text.str();
}

}  // namespace hts::testing
