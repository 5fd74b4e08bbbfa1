// The regimes of accuracy_sweep.hpp and their random inputs.

#include <array>
#include <cmath>

#include "bench/phi/accuracy_sweep.hpp"
#include "hts/sampling/random.hpp"
#include "hts/terms.hpp"

namespace hts::bench {
namespace {

struct Input {
    double g, t, weight;
};

/// t where the lobe of a given g has its energy; every g weighs the same, since the integral of Phi over t is
/// 1 - exp(-g).
Input in_the_lobe(Random& random, double least_g, double most_g) {
    const double g = random.logarithmic(least_g, most_g);
    const double most_t = std::fmin(10 * std::fmax(g, 1), most_ratio * g);
    return {g, random.uniform(0, most_t), most_t / -std::expm1(-g)};
}

Input in_the_tail(Random& random) {
    const double g = random.logarithmic(1e-3, 1e6);
    return {g, g * random.uniform(50, most_ratio), g / -std::expm1(-g)};
}

/// A pair of grazing directions with its g and t; the weight is what stands before Phi in the lobe, without
/// shadowing.
Input at_grazing(Random& random) {
    for (;;) {
        const double sigma = random.logarithmic(0.05, 2);
        const Surface surface{sigma, sigma * random.logarithmic(3, 30)};
        const auto in = Direction::from_degrees(random.uniform(80, 89.9), 0);
        const auto out = Direction::from_degrees(random.uniform(80, 89.9), random.uniform(90, 270));
        const PairFactors pair{surface, view(surface, in), view(surface, out)};
        const Wavelength wavelength = Wavelength::from_micrometres(random.uniform(0.4, 0.8));
        const double g = pair.phase_variance(wavelength);
        const double t = pair.lobe_argument(wavelength);
        const double scale = surface.correlation_length() / wavelength.micrometres();
        if (t <= most_ratio * g) return {g, t, scale * scale};
    }
}

Input input(Regime regime, Random& random) {
    switch (regime) {
        case Regime::smooth:
            return in_the_lobe(random, 1e-3, 1);
        case Regime::moderate:
            return in_the_lobe(random, 1, 20);
        case Regime::rough:
            return in_the_lobe(random, 20, 200);
        case Regime::very_rough:
            return in_the_lobe(random, 200, 1e6);
        case Regime::grazing:
            return at_grazing(random);
        case Regime::far_tail:
            return in_the_tail(random);
    }
    return {};
}

}  // namespace

const char* key(Regime regime) noexcept {
    constexpr std::array names{"g-below-1", "g-1-to-20", "g-20-to-200", "g-above-200", "grazing", "far-tail"};
    return names[static_cast<std::size_t>(regime)];
}

const char* title(Regime regime) noexcept {
    constexpr std::array names{"g < 1  (smooth)",          "g = 1 … 20",          "g = 20 … 200",
                               "g > 200  (rough; to 10⁶)", "grazing, 80 … 89.9°", "far tail, t/g = 50 … 700"};
    return names[static_cast<std::size_t>(regime)];
}

PhiInputs random_inputs(Regime regime, std::size_t count, std::uint64_t seed) {
    Random random{seed * 1000003 + static_cast<std::uint64_t>(regime)};
    PhiInputs inputs;
    while (inputs.size() < count) {
        const Input next = input(regime, random);
        inputs.g.push_back(next.g);
        inputs.t.push_back(next.t);
        inputs.weights.push_back(next.weight);
    }
    return inputs;
}

}  // namespace hts::bench
