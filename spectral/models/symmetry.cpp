#include "spectral/models/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/sampling/random.hpp"

namespace hts::spectral {
namespace {

Direction turned(const Direction& direction, double cosine, double sine) {
    const Vector3 v = direction.vector();
    return Direction::from_unit_vector({cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z});
}

/// Largest relative change of the BRDF over random pairs when each becomes changed(pair, random angle).
template <class Change>
double largest_change(const Evaluator& brdf, std::size_t pairs, Change&& changed) {
    Random random{1};
    std::vector<double> before(brdf.wavelengths().size()), after(before.size());
    double worst = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const Direction in = random.direction(0.1);
        const DirectionPair pair{in, random.direction(0.1)};
        const double turn = 2 * std::numbers::pi * random.uniform();
        brdf.brdf(pair, before);
        brdf.brdf(changed(pair, turn), after);
        for (std::size_t k = 0; k < before.size(); ++k) {
            const double larger = std::max(before[k], after[k]);
            if (larger > 1e-12) worst = std::max(worst, std::abs(before[k] - after[k]) / larger);
        }
    }
    return worst;
}

}  // namespace

double anisotropy(const Evaluator& brdf, std::size_t pairs) {
    return largest_change(brdf, pairs, [](const DirectionPair& pair, double turn) {
        const double cosine = std::cos(turn), sine = std::sin(turn);
        return DirectionPair{turned(pair.in, cosine, sine), turned(pair.out, cosine, sine)};
    });
}

bool is_isotropic(const Evaluator& brdf) {
    return anisotropy(brdf) < accuracy::isotropy;
}

double irreciprocity(const Evaluator& brdf) {
    return largest_change(brdf, 256, [](const DirectionPair& pair, double /*turn*/) {
        return DirectionPair{pair.out, pair.in};
    });
}

}  // namespace hts::spectral
