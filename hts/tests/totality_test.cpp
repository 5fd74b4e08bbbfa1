// Every valid input has a finite answer: random and edge inputs over the whole domain.
// HTS_EXHAUSTIVE=1 takes 10^7 of them, otherwise 10^6.

#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/terms.hpp"

using hts::Direction;
using hts::Surface;
using hts::Wavelength;
using hts::testing::Random;

namespace {

/// One time in four an edge of the range, otherwise spread logarithmically or, for angles, evenly.
double length(Random& random) {
    return random.uniform(0, 4) < 1 ? random.one_of({1e-24, 1e-12, 1e-3, 0.5, 1, 1e6, 1e24})
                                    : random.logarithmic(1e-24, 1e24);
}

double roughness(Random& random) {
    return random.uniform(0, 8) < 1 ? 0 : length(random);
}

Direction direction(Random& random) {
    const double pick = random.uniform(0, 4);
    if (pick < 1) {
        return Direction::from_degrees(
            random.one_of({0, 5e-324, 1e-12, 45, 89.99, std::nextafter(90.0, 0.0), 90}),
            random.one_of({0, 90, 180, 270, 1e-12}));
    }
    if (pick < 2) {
        return Direction::from_vector(
            {random.uniform(-1, 1), random.logarithmic(1e-300, 1), random.logarithmic(1e-300, 1)});
    }
    return Direction::from_degrees(random.uniform(0, 90), random.uniform(0, 360));
}

double part_of_index(Random& random, double lowest) {
    return random.uniform(0, 4) < 1 ? random.one_of({lowest, 1, 1 + 1e-15, 1e24})
                                    : random.logarithmic(1e-24, 1e24);
}

/// A point of ordinary size or anywhere in the domain, with the view now and then the mirror or exact
/// backscatter.
bool finite_everywhere(Random& random) {
    const bool ordinary = random.uniform(0, 2) < 1;
    const double wavelength = ordinary ? random.logarithmic(0.3, 13) : length(random);
    const double sigma = ordinary ? random.logarithmic(1e-3, 16) : roughness(random);
    const double tau = ordinary ? sigma / random.logarithmic(3e-3, 5) : length(random);
    const Surface surface{sigma, tau};
    const hts::RefractiveIndex index{part_of_index(random, 1e-24), part_of_index(random, 0)};
    const Direction incident = direction(random);
    const double pick = random.uniform(0, 8);
    const Direction outgoing = pick < 1 ? incident : pick < 2 ? incident.mirror() : direction(random);

    const auto lambda = Wavelength::from_micrometres(wavelength);
    const auto in = view(surface, incident);
    const hts::PairFactors pair{surface, in, view(surface, outgoing)};
    const auto term = hts::directional_diffuse(pair, lambda, index);
    bool fine = std::isfinite(term.brdf) && term.brdf >= 0;
    const auto specular = hts::specular_reflectance(surface, in, lambda, index).value();
    fine = fine && specular >= 0 && specular <= 1 + 1e-12;
    for (const auto& matrix : {hts::directional_diffuse_mueller(incident, outgoing, term),
                               hts::specular_mueller(surface, in, lambda, index)}) {
        for (const double element : matrix.elements()) fine = fine && std::isfinite(element);
    }
    if (!fine) {
        std::cout << "not finite: lambda " << wavelength << ", sigma_0 " << sigma << ", tau " << tau << ", n "
                  << index.n() << ", k " << index.k() << ", cos theta_i " << incident.cos_theta()
                  << ", cos theta_r " << outgoing.cos_theta() << ", f " << term.brdf << ", g "
                  << term.phase_variance << ", t " << term.lobe_argument << ", rho_s " << specular << '\n';
    }
    return fine;
}

}  // namespace

TEST_CASE("every valid input has a finite answer") {
    const std::int64_t blocks = hts::testing::exhaustive() ? 1000 : 100;
    std::int64_t failures = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : failures)
    for (std::int64_t block = 0; block < blocks; ++block) {
        Random random{static_cast<std::uint64_t>(block)};
        for (int i = 0; i < 10000; ++i) failures += finite_everywhere(random) ? 0 : 1;
    }
    CHECK(failures == 0);
}
