// Derivatives of the amplitudes of films against differences at 50 digits.

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include <catch2/catch.hpp>

#include "comparison.hpp"
#include "film_stacks.hpp"
#include "hts/films/coated_index.hpp"

namespace hts {
namespace {

using testing::least_root;
using testing::one_um;
using testing::Random;
using testing::random_stack;
using testing::Stack;
using testing::WorstCase;
using testing::films::answer;
using testing::films::Complex;
using testing::films::ExactStack;
using testing::films::Real;

using Change = std::function<void(ExactStack&, const Real&)>;

/// Of s and p, by a number that `change` moves.
struct Derivative {
    Complex s, p;
};
Derivative derivative(const Stack& stack, const Change& change) {
    const Real step{"1e-16"};
    const auto moved = [&](const Real& by) {
        ExactStack other{stack};
        change(other, by);
        return answer(other);
    };
    const auto above = moved(step), below = moved(-step);
    return {(above.s - below.s) / (2 * step), (above.p - below.p) / (2 * step)};
}

double error(const std::complex<double>& found, const Complex& expected) {
    const auto off = abs(Complex{found.real(), found.imag()} - expected);
    return static_cast<double>(Real{off / (1 + abs(expected))});
}

}  // namespace

TEST_CASE("Films: derivatives by angle, substrate, index and thickness against 50 digits") {
    WorstCase worst{"derivatives of amplitudes of films", accuracy::films_gradient};
    WorstCase sum{"(F_s + F_p)/sin^2 under films", accuracy::films_gradient};
    Random random{11};
    for (int i = 0; i < 400; ++i) {
        Stack stack = random_stack(random, i % 3 == 0, i % 2 == 0 ? 20 : 0.3);
        if (i % 5 == 0) stack.cos_theta = 1 - random.logarithmic(1e-12, 1e-2);
        const CoatedIndex index = stack.index();
        std::vector<FilmGradient> films(index.film_count());
        const FresnelGradient found = index.gradient(stack.cos_theta, films);
        const double scale = stack.thickness() / std::min(1.0, std::pow(least_root(stack), 2));
        const auto note = [&](const char* what, const FresnelAmplitudes& of, const Change& change) {
            const auto [s, p] = derivative(stack, change);
            worst.note(std::max(error(of.s, s), error(of.p, p)) / scale,
                       [&] { return std::string{what} + ": " + stack.text(); });
        };
        note("cosine", found.by_cos_theta, [](ExactStack& of, const Real& by) { of.cos_theta += by; });
        note("substrate", found.by_n, [](ExactStack& of, const Real& by) { of.substrate += by; });
        for (std::size_t j = 0; j < films.size(); ++j) {
            note("n", films[j].by_n, [j](ExactStack& of, const Real& by) { of.films[j].first += by; });
            note("k", films[j].by_k(), [j](ExactStack& of, const Real& by) {
                of.films[j].first += Complex{0, by};
            });
            note("phase", films[j].by_phase,
                 [j](ExactStack& of, const Real& by) { of.films[j].second += by; });
        }
        const auto exact = answer(stack);
        const Real c{stack.cos_theta};
        sum.note(error(found.sum_over_sine_squared, Complex{(exact.s + exact.p) / (1 - c * c)}) / scale,
                 [&] { return stack.text(); });
        CHECK(found.value.s == index.amplitudes(stack.cos_theta).s);
        CHECK(found.value.p == index.amplitudes(stack.cos_theta).p);
    }
    worst.check();
    sum.check();
}

TEST_CASE("Films: derivatives without a film, and of films thinner than any, are Fresnel's") {
    Random random{12};
    for (int i = 0; i < 100; ++i) {
        const RefractiveIndex substrate{random.uniform(0.2, 4), random.uniform(0, 4)};
        const double c = random.uniform(0.01, 1);
        const FresnelGradient bare = fresnel_gradient(c, substrate);
        const FresnelGradient none = CoatedIndex{substrate}.gradient(c, {});
        CHECK(none.by_cos_theta.p == bare.by_cos_theta.p);
        CHECK(none.by_n.s == bare.by_n.s);
        const std::vector<Film> films{{{1.8, 0.1}, 1e-13}};
        const FresnelGradient thin = CoatedIndex{substrate, films, one_um}.gradient(c, {});
        const auto close = [](const std::complex<double>& a, const std::complex<double>& b) {
            return std::abs(a - b) < 1e-10 * (1 + std::abs(b));
        };
        CHECK(close(thin.by_cos_theta.s, bare.by_cos_theta.s));
        CHECK(close(thin.by_cos_theta.p, bare.by_cos_theta.p));
        CHECK(close(thin.by_n.s, bare.by_n.s));
        CHECK(close(thin.by_n.p, bare.by_n.p));
        CHECK(close(thin.sum_over_sine_squared, bare.sum_over_sine_squared));
    }
    const std::vector<Film> films{{{1.8, 0}, 0}};
    CHECK((CoatedIndex{{1.5, 0}, films, one_um}.film_count()) == 0);
}

}  // namespace hts
