// Derivatives of surfaces whose correlation is not Gaussian, and of films on them, against differences.

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "hts/error.hpp"
#include "hts/he_torrance_gradient.hpp"

namespace hts {
namespace {

using testing::Random;
using testing::WorstCase;

const auto green = Wavelength::from_micrometres(0.5);

/// A film's index and thickness.
struct Layer {
    double n, k, thickness;
};

/// What the lobe is a function of.
struct At {
    double rms_roughness, along, across, azimuth, n, k, theta_i, theta_r, phi;
    std::vector<Layer> films{};

    [[nodiscard]] Surface surface(const Correlation& shape) const {
        return Surface::anisotropic(rms_roughness, {along, across}, Direction::from_angles(1.5, azimuth))
            .correlated(shape);
    }
    [[nodiscard]] CoatedIndex index() const {
        std::vector<Film> all;
        for (const Layer& film : films) all.push_back({{film.n, film.k}, film.thickness});
        return {{n, k}, all, green};
    }
    [[nodiscard]] Direction in() const { return Direction::from_angles(theta_i, 0.2); }
    [[nodiscard]] Direction out() const { return Direction::from_angles(theta_r, 0.2 + phi); }
};

At random_at(Random& random, bool isotropic, int films) {
    At at{};
    at.rms_roughness = 0.5 * random.logarithmic(0.02, 0.5);
    at.along = at.rms_roughness / random.logarithmic(0.05, 0.5);
    at.across = isotropic ? at.along : at.along * random.logarithmic(0.3, 3);
    at.azimuth = isotropic ? 0 : random.uniform(-1, 1);
    at.n = random.uniform(0.5, 3);
    at.k = random.uniform(0.3, 6);
    at.theta_i = random.uniform(0.1, 1.3);
    at.theta_r = random.uniform(0.1, 1.3);
    at.phi = random.uniform(2, 4);
    for (int i = 0; i < films; ++i)
        at.films.push_back({random.uniform(1.2, 2.5), random.one_of({0.0, 0.02}), random.uniform(0.02, 0.4)});
    return at;
}

/// Central difference of fourth order.
double difference(At at, const std::function<double&(At&)>& of, double step,
                  const std::function<double(const At&)>& value) {
    double& moved = of(at);
    const double middle = moved;
    const auto f = [&](double offset) {
        moved = middle + offset * step;
        return value(at);
    };
    return (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * step);
}

struct Parameter {
    const char* name;
    double At::*at;
    double Gradient<>::*by;
};
constexpr std::array<Parameter, 9> parameters{
    {{"rms_roughness", &At::rms_roughness, &Gradient<>::rms_roughness},
     {"along", &At::along, &Gradient<>::correlation_length_x},
     {"across", &At::across, &Gradient<>::correlation_length_y},
     {"azimuth", &At::azimuth, &Gradient<>::azimuth},
     {"n", &At::n, &Gradient<>::n},
     {"k", &At::k, &Gradient<>::k},
     {"theta_i", &At::theta_i, &Gradient<>::theta_i},
     {"theta_r", &At::theta_r, &Gradient<>::theta_r},
     {"phi", &At::phi, &Gradient<>::phi}}};

double brdf(const At& at, const Correlation& shape) {
    const Surface surface = at.surface(shape), seen = surface.seen_by(green);
    const PairFactors pair{surface, view(seen, at.in()), view(seen, at.out())};
    return directional_diffuse(pair, green, at.index()).brdf;
}

double mirror(const At& at, const Correlation& shape) {
    const Surface seen = at.surface(shape).seen_by(green);
    return specular_reflectance(seen, view(seen, at.in()), green, at.index()).value();
}

}  // namespace

TEST_CASE("derivatives of other correlations and of films are those of the table's values") {
    const std::vector<Correlation::Part> two{{0.8, Correlation::gaussian(), 1},
                                             {0.2, Correlation::exponential(), 0.1}};
    for (const auto& each : {std::pair{"exponential", Correlation::exponential()},
                             {"matern 3/2", Correlation::matern(1.5)},
                             {"two scales", Correlation::sum(two)},
                             {"fractal", Correlation::fractal(2.4, 1000).shape}}) {
        const char* const name = each.first;
        const Correlation& shape = each.second;
        // the value is a spline's, whose difference over a step is its own derivative
        WorstCase lobe{std::string{"derivatives of the lobe, "} + name, 1e-7};
        WorstCase specular{std::string{"derivatives of the mirror term, "} + name, 2e-7};
        Random random{21};
        for (int i = 0; i < 60; ++i) {
            const bool isotropic = i % 2 == 0;
            const At at = random_at(random, isotropic, i % 3);
            const Surface surface = at.surface(shape);
            std::vector<ByFilm<>> films(at.films.size()), mirror_films(at.films.size());
            const PairGradient pair{surface, at.in(), at.out(), green};
            const auto f = directional_diffuse_gradient(pair, green, at.index(), DiffuseLobe::full, films);
            const auto m = specular_reflectance_gradient(surface, view_gradient(surface, at.in(), green),
                                                         green, at.index(), mirror_films);
            CHECK(f.value == Approx(brdf(at, shape)).epsilon(1e-13));
            CHECK(m.value.value() == Approx(mirror(at, shape)).epsilon(1e-13));
            const auto check = [&](const char* what, const std::function<double&(At&)>& of, double of_lobe,
                                   double of_mirror) {
                At copy = at;
                const double scale = std::max(std::abs(of(copy)), 0.1), step = 1e-4 * scale;
                const auto where = [&] { return std::string{what} + " of case " + std::to_string(i); };
                const double expected = difference(at, of, step, [&](const At& p) { return brdf(p, shape); });
                lobe.note(scale * std::abs(of_lobe - expected) / (scale * std::abs(expected) + f.value),
                          where);
                const double expected_mirror =
                    difference(at, of, step, [&](const At& p) { return mirror(p, shape); });
                if (m.value.value() > 1e-250)
                    specular.note(scale * std::abs(of_mirror - expected_mirror) /
                                      (scale * std::abs(expected_mirror) + m.value.value()),
                                  where);
            };
            for (const Parameter& p : parameters) {
                if (isotropic && (p.at == &At::along || p.at == &At::across || p.at == &At::azimuth))
                    continue;
                check(
                    p.name, [&p](At& of) -> double& { return of.*p.at; }, f.by.*p.by, m.by.*p.by);
            }
            if (isotropic) {
                const auto both = [&shape](const At& p) {
                    At equal = p;
                    equal.across = p.along;
                    return brdf(equal, shape);
                };
                const double step = 1e-4 * at.along;
                const double expected = difference(
                    at, [](At& of) -> double& { return of.along; }, step, both);
                lobe.note(at.along * std::abs(f.by.correlation_length - expected) /
                              (at.along * std::abs(expected) + f.value),
                          [&] { return "length of case " + std::to_string(i); });
            }
            for (std::size_t j = 0; j < films.size(); ++j) {
                check(
                    "film's n", [j](At& of) -> double& { return of.films[j].n; }, films[j].n,
                    mirror_films[j].n);
                if (at.films[j].k > 0)
                    check(
                        "film's k", [j](At& of) -> double& { return of.films[j].k; }, films[j].k,
                        mirror_films[j].k);
                check(
                    "film's thickness", [j](At& of) -> double& { return of.films[j].thickness; },
                    films[j].thickness, mirror_films[j].thickness);
            }
        }
        lobe.check();
        specular.check();
    }
}

TEST_CASE("Mueller matrices of films: all derivatives by differences") {
    WorstCase worst{"derivatives of Mueller elements under films", 5e-9};
    Random random{22};
    for (int i = 0; i < 40; ++i) {
        const At at = random_at(random, true, 1 + i % 2);
        const Correlation shape = Correlation::matern(1.5);
        const auto matrix = [&](const At& p) {
            const Surface surface = p.surface(shape), seen = surface.seen_by(green);
            const PairFactors pair{surface, view(seen, p.in()), view(seen, p.out())};
            return directional_diffuse_mueller(p.in(), p.out(), directional_diffuse(pair, green, p.index()));
        };
        std::vector<ByFilm<Mueller>> films(at.films.size());
        const auto f = directional_diffuse_mueller_gradient({at.surface(shape), at.in(), at.out(), green},
                                                            green, at.index(), DiffuseLobe::full, films);
        const auto check = [&](const char* what, const std::function<double&(At&)>& of,
                               const Mueller& found) {
            At copy = at;
            const double scale = std::max(std::abs(of(copy)), 0.1);
            for (std::size_t e = 0; e < 16; ++e) {
                const double expected =
                    difference(at, of, 1e-4 * scale, [&](const At& p) { return matrix(p).elements()[e]; });
                worst.note(scale * std::abs(found.elements()[e] - expected) /
                               (scale * std::abs(expected) + f.value(0, 0)),
                           [&] { return std::string{what} + ", element " + std::to_string(e); });
            }
        };
        check(
            "rms", [](At& of) -> double& { return of.rms_roughness; }, f.by.rms_roughness);
        check(
            "k", [](At& of) -> double& { return of.k; }, f.by.k);
        check(
            "theta_i", [](At& of) -> double& { return of.theta_i; }, f.by.theta_i);
        check(
            "phi", [](At& of) -> double& { return of.phi; }, f.by.phi);
        check(
            "film's n", [](At& of) -> double& { return of.films[0].n; }, films[0].n);
        check(
            "film's thickness", [](At& of) -> double& { return of.films[0].thickness; }, films[0].thickness);
    }
    worst.check();
}

TEST_CASE("Correlation: derivatives of the exponential's lobe are those of its series") {
    using Real = boost::multiprecision::cpp_bin_float_50;
    const Correlation shape = Correlation::exponential();
    WorstCase by_g{"d ln D/d ln g", accuracy::correlation_slopes},
        by_t{"t d ln D/dt", accuracy::correlation_slopes};
    Random random{9};
    for (int i = 0; i < 400; ++i) {
        const double g = random.logarithmic(1e-5, 500), q = (1 + g) * random.logarithmic(1e-5, 30);
        Real term = exp(Real{-g}), value = 0, of_g = 0, of_t = 0, peak = 0;
        for (int m = 1; m <= static_cast<int>(g + 20 * std::sqrt(g) + 60); ++m) {
            term *= Real{g} / m;
            const Real s = Real{m} * m + Real{q} * q, w = term * m / (s * sqrt(s));
            value += w;
            of_g += w * (m - Real{g});                 // g d/dg of e^-g g^m
            of_t += w * Real{-1.5} * Real{q} * q / s;  // t d/dt, t = q^2/4
            peak += term / (Real{m} * m);
        }
        if (value < peak * 1e-3) continue;
        const auto [log_g, log_t] = shape.lobe_slopes(g, q * q / 4);
        const double exact_g = static_cast<double>(of_g / value), exact_t = static_cast<double>(of_t / value);
        by_g.note(std::abs(log_g - exact_g) / (1 + std::abs(exact_g)),
                  [&] { return "g = " + shortest(g) + ", q = " + shortest(q); });
        by_t.note(std::abs(log_t * q * q / 4 - exact_t) / (1 + std::abs(exact_t)),
                  [&] { return "g = " + shortest(g) + ", q = " + shortest(q); });
    }
    by_g.check();
    by_t.check();
}

}  // namespace hts
