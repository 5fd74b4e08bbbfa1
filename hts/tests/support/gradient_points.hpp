/// What the tests of the model's derivatives share: a point of the model, its parameters by name, finite
/// differences.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "hts/he_torrance_gradient.hpp"

namespace hts::testing {

/// What the model is a function of; angles in radians.
struct Point {
    double rms_roughness, correlation_length, n, k, theta_i, theta_r, phi;
    double wavelength = 0.5;

    [[nodiscard]] Surface surface() const { return {rms_roughness, correlation_length}; }
    [[nodiscard]] RefractiveIndex index() const { return {n, k}; }
    [[nodiscard]] Wavelength lambda() const { return Wavelength::from_micrometres(wavelength); }
    [[nodiscard]] Direction in() const { return Direction::from_angles(theta_i, 0); }
    [[nodiscard]] Direction out() const { return Direction::from_angles(theta_r, phi); }
    [[nodiscard]] PairGradient pair() const { return {surface(), in(), out()}; }

    [[nodiscard]] double brdf(DiffuseLobe lobe = DiffuseLobe::full) const {
        return directional_diffuse({surface(), in(), out()}, lambda(), index(), lobe).brdf;
    }
    [[nodiscard]] BrdfGradient gradient(DiffuseLobe lobe = DiffuseLobe::full) const {
        return directional_diffuse_gradient(pair(), lambda(), index(), lobe);
    }
    [[nodiscard]] double specular() const {
        return specular_reflectance(surface(), view(surface(), in()), lambda(), index()).value();
    }
    [[nodiscard]] SpecularGradient specular_gradient() const {
        return specular_reflectance_gradient(surface(), view_gradient(surface(), in()), lambda(), index());
    }
    [[nodiscard]] Mueller mueller() const {
        const PairFactors factors{surface(), in(), out()};
        return directional_diffuse_mueller(in(), out(), directional_diffuse(factors, lambda(), index()));
    }
    [[nodiscard]] MuellerGradient mueller_gradient() const {
        return directional_diffuse_mueller_gradient(pair(), lambda(), index());
    }
};

/// A parameter of a point and the member that holds derivatives by it.
template <class Value>
struct Parameter {
    std::string name;
    double Point::*of_point;
    Value Gradient<Value>::*of_gradient;
};

template <class Value>
std::vector<Parameter<Value>> parameters() {
    using G = Gradient<Value>;
    return {{"rms_roughness", &Point::rms_roughness, &G::rms_roughness},
            {"correlation_length", &Point::correlation_length, &G::correlation_length},
            {"n", &Point::n, &G::n},
            {"k", &Point::k, &G::k},
            {"theta_i", &Point::theta_i, &G::theta_i},
            {"theta_r", &Point::theta_r, &G::theta_r},
            {"phi", &Point::phi, &G::phi}};
}

inline Point random_point(Random& random) {
    Point p{};
    p.wavelength = random.logarithmic(0.3, 13);
    p.rms_roughness = p.wavelength * random.logarithmic(3e-3, 1);
    p.correlation_length = p.rms_roughness / random.logarithmic(0.03, 1);
    p.n = random.uniform(0.1, 3);
    p.k = random.uniform(0.1, 8);
    p.theta_i = random.uniform(0.05, 1.45);
    p.theta_r = random.uniform(0.05, 1.45);
    p.phi = random.uniform(0.1, 6.2);
    return p;
}

/// Central difference, of fourth order.
template <class Function>
auto difference(Point p, double Point::*by, double step, const Function& of) {
    const double at = p.*by;
    const auto value = [&](double offset) {
        p.*by = at + offset * step;
        return of(p);
    };
    return (1 / (12 * step)) * ((8 * value(1) + -8 * value(-1)) + (-1 * value(2) + value(-2)));
}

}  // namespace hts::testing
