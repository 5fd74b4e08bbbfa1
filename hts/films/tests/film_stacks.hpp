/// Stacks of films for tests, and what they reflect to 50 digits.
#pragma once

#include <cmath>
#include <complex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_complex.hpp>

#include "comparison.hpp"
#include "hts/films/coated_index.hpp"

namespace hts::testing {

inline const auto one_um = Wavelength::from_micrometres(1);

/// A stack and an angle of incidence.
struct Stack {
    RefractiveIndex substrate;
    std::vector<Film> films;
    double cos_theta;

    [[nodiscard]] CoatedIndex index() const { return {substrate, films, one_um}; }
    /// 1 + the sum of k d |N|.
    [[nodiscard]] double thickness() const {
        double sum = 1;
        for (const Film& film : films)
            sum += one_um.wave_number() * film.thickness * std::hypot(film.index.n(), film.index.k());
        return sum;
    }
    [[nodiscard]] std::string text() const {
        std::ostringstream out;
        out.precision(17);
        out << "substrate " << substrate.n() << " + " << substrate.k() << "i, cosine " << cos_theta;
        for (const Film& film : films)
            out << ", " << film.index.n() << " + " << film.index.k() << "i of " << film.thickness << " um";
        return out.str();
    }
};

namespace films {

using Real = boost::multiprecision::cpp_bin_float_50;
using Complex = boost::multiprecision::cpp_complex_50;

struct Answer {
    Complex s, p;
    Real transmitted;
};

/// A stack to 50 digits, films by N and by k times the thickness.
struct ExactStack {
    Complex substrate;
    std::vector<std::pair<Complex, Real>> films;
    Real cos_theta;

    ExactStack(const Stack& stack)  // NOLINT(google-explicit-constructor): the same stack
        : substrate{stack.substrate.n(), stack.substrate.k()}, cos_theta{stack.cos_theta} {
        for (const Film& film : stack.films)
            films.emplace_back(Complex{film.index.n(), film.index.k()},
                               Real{one_um.wave_number()} * Real{film.thickness});
    }
};

/// The product of the characteristic matrices of all films as textbooks print it, in 50 digits.
inline Answer answer(const ExactStack& stack) {
    const Real& c = stack.cos_theta;
    const auto root = [&](const Complex& n) { return Complex{sqrt(Complex{n * n - (1 - c * c)})}; };
    const Complex i{0, 1};
    const Complex& below = stack.substrate;
    const auto of = [&](bool is_p) {
        const auto admittance = [&](const Complex& n) { return is_p ? Complex{root(n) / (n * n)} : root(n); };
        Complex m11 = 1, m12 = 0, m21 = 0, m22 = 1;
        for (const auto& [n, phase] : stack.films) {
            const Complex y = admittance(n), delta = phase * root(n);
            const Complex cosine = cos(delta), sine = sin(delta);
            const Complex a = cosine, b = -i * sine / y, d = -i * sine * y;
            const Complex n11 = m11 * a + m12 * d, n12 = m11 * b + m12 * a;
            const Complex n21 = m21 * a + m22 * d, n22 = m21 * b + m22 * a;
            m11 = n11, m12 = n12, m21 = n21, m22 = n22;
        }
        const Complex y = admittance(below), field = m11 + m12 * y, other = m21 + m22 * y;
        const Complex sum = c * field + other;
        return std::pair{Complex{(c * field - other) / sum}, Real{4 * c * real(y) / norm(sum)}};
    };
    const auto [s, t_s] = of(false);
    const auto [p, t_p] = of(true);
    return {s, p, (t_s + t_p) / 2};
}

inline double distance(const std::complex<double>& computed, const Complex& expected) {
    return static_cast<double>(abs(Complex{computed.real(), computed.imag()} - expected));
}

}  // namespace films

inline RefractiveIndex random_index(Random& random, bool lossless) {
    const double n = random.logarithmic(0.05, 14);
    return {n, lossless ? 0 : random.one_of({0.0, 1e-3, 0.3, 3.0, 14.0})};
}

inline Stack random_stack(Random& random, bool lossless, double thickest = 20) {
    Stack stack{random_index(random, lossless), {}, random.uniform(1e-4, 1)};
    const int films = static_cast<int>(random.uniform(1, 6));
    for (int i = 0; i < films; ++i)
        stack.films.push_back({random_index(random, lossless), random.logarithmic(1e-4, thickest)});
    return stack;
}

/// How far a root of the stack is from a critical angle.
inline double least_root(const Stack& stack) {
    const double c = stack.cos_theta;
    const std::complex<double> n{stack.substrate.n(), stack.substrate.k()};
    return std::abs(std::sqrt(n * n - (1 - c * c)));
}

}  // namespace hts::testing
