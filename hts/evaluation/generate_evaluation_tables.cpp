// Writes evaluation_table.cpp, the coefficients of the lanes, to standard output: Chebyshev interpolants in
// long double. cmake --build build/release --target hts_evaluation_tables runs it.
#include "hts/evaluation/evaluation_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include <boost/math/special_functions/lambert_w.hpp>

#include "hts/phi/tables/chebyshev.hpp"

namespace {

using namespace hts::evaluation_detail;
using Real = long double;
using Function = std::function<Real(Real)>;
using Polynomial = std::vector<Real>;  // ascending powers

/// Interpolant of f on [low, high] at Chebyshev's nodes, in powers of x from -1/2 to 1/2.
Polynomial through_nodes(const Function& f, Real low, Real high, std::size_t size) {
    std::vector<Real> values;
    for (const Real node : hts::phi_detail::chebyshev_nodes<Real>(static_cast<int>(size))) {
        values.push_back(f((low + high) / 2 + (high - low) / 2 * node));
    }
    return hts::phi_detail::interpolant(values);
}

Real value(const Polynomial& p, Real x) {
    Real sum = 0;
    for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
    return sum;
}

/// Worst relative error of an interpolant.
Real worst(const Polynomial& p, const Function& f, Real low, Real high) {
    Real error = 0;
    for (int i = 0; i <= 1000; ++i) {
        const Real x = i / 1000.0L - 0.5L;
        error = std::max(error, std::abs(value(p, x) / f((low + high) / 2 + (high - low) * x) - 1));
    }
    return error;
}

void print(const Polynomial& p) {
    for (const Real c : p) std::printf("%a, ", static_cast<double>(c));
}

template <class Number = double>
void print_array(const char* name, const Function& f, Real low, Real high, std::size_t size) {
    Polynomial p = through_nodes(f, low, high, size);
    for (Real& coefficient : p) coefficient = static_cast<Number>(coefficient);
    std::printf("// worst relative error %.1Le\nconst std::array<%s, %zu> %s{", worst(p, f, low, high),
                sizeof(Number) == sizeof(float) ? "float" : "double", size, name);
    print(p);
    std::puts("};\n");
}

/// exp(c^2) erfc(c) / y, y = erfcx_centre / (erfcx_centre + c)
Real erfcx_over_y(Real y) {
    const Real c = erfcx_centre / y - erfcx_centre;
    return std::exp(c * c) * std::erfc(c) / y;
}

Real one_plus_lambert(Real v) {
    return 1 + boost::math::lambert_w0((v - 1) / std::numbers::e_v<Real>);
}

void print_lambert() {
    Real error = 0;
    std::printf("alignas(64) const std::array<double, %zu> lambert_coefficients{\n",
                lambert_coefficients.size());
    constexpr int pieces = 1 << lambert_log2_pieces;
    for (int i = 0; i < lambert_octaves * pieces; ++i) {
        const Real step = 1 / Real(pieces);
        const Real low = std::ldexp(1 + step * (i % pieces), i / pieces);
        const Real high = low + std::ldexp(step, i / pieces);
        const Polynomial p = through_nodes(one_plus_lambert, low, high, lambert_coefficients_per_piece);
        error = std::max(error, worst(p, one_plus_lambert, low, high));
        print(p);
        std::puts("");
    }
    std::printf("};  // worst relative error %.1Le\n", error);
}

/// Two functions over one piece, interleaved. Their worst relative error.
Real print_row(const Function& first, const Function& second, Real low, Real high) {
    const auto rounded = [&](const Function& f) {
        Polynomial p = through_nodes(f, low, high, single_lambert_row / 2);
        for (Real& coefficient : p) coefficient = static_cast<float>(coefficient);
        return p;
    };
    const Polynomial a = rounded(first), b = rounded(second);
    for (std::size_t j = 0; j < single_lambert_row / 2; ++j) print({a[j], b[j]});
    std::puts("");
    return std::max(worst(a, first, low, high), worst(b, second, low, high));
}

void print_single_lambert() {
    constexpr int pieces = 1 << single_lambert_log2_pieces;
    Real error = 0;
    std::printf("alignas(64) const std::array<float, %zu> single_lambert_coefficients{\n",
                single_lambert_coefficients.size());
    for (int i = 0; i < lambert_octaves * pieces; ++i) {
        const Real step = 1 / Real(pieces);
        const Real low = std::ldexp(1 + step * (i % pieces), i / pieces);
        error = std::max(error, print_row(
                                    one_plus_lambert, [](Real v) { return 1 / one_plus_lambert(v); }, low,
                                    low + std::ldexp(step, i / pieces)));
    }
    std::printf("};  // worst relative error %.1Le\n\n", error);
}

}  // namespace

int main() {
    std::puts(
        "// Written by generate_evaluation_tables; do not edit.\n#include "
        "\"hts/evaluation/evaluation_table.hpp\"\n");
    std::puts("namespace hts::evaluation_detail {\n");
    print_array(
        "exp2_coefficients", [](Real f) { return std::exp2(f); }, -0.5L, 0.5L, exp2_coefficients.size());
    print_array("erfcx_coefficients", erfcx_over_y, erfcx_centre / Real{erfcx_centre + erfcx_far}, 1,
                erfcx_coefficients.size());
    print_lambert();
    print_array<float>("single_erfcx_coefficients", erfcx_over_y,
                       erfcx_centre / Real{erfcx_centre + erfcx_far}, 1, single_erfcx_coefficients.size());
    print_single_lambert();
    std::puts("\n}  // namespace hts::evaluation_detail");
}
