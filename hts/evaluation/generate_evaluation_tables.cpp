// Writes evaluation_table.cpp and single_table.cpp, the coefficients of the lanes, into a folder: Chebyshev
// interpolants in long double. cmake --build build/release --target hts_evaluation_tables runs it;
// clang-format comes after.
#include "hts/evaluation/evaluation_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
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

/// Rows of two interleaved functions, 1 + W_0 and its reciprocal, seven numbers to a line.
void print_single_lambert() {
    constexpr int pieces = 1 << single_lambert_log2_pieces;
    const Function reciprocal = [](Real v) { return 1 / one_plus_lambert(v); };
    Real error = 0;
    std::size_t count = 0;
    std::printf("alignas(64) const std::array<float, %zu> single_lambert_coefficients{\n",
                single_lambert_coefficients.size());
    for (int i = 0; i < lambert_octaves * pieces; ++i) {
        const Real step = 1 / Real(pieces);
        const Real low = std::ldexp(1 + step * (i % pieces), i / pieces);
        const Real high = low + std::ldexp(step, i / pieces);
        const auto rounded = [&](const Function& f) {
            Polynomial p = through_nodes(f, low, high, single_lambert_row / 2);
            for (Real& coefficient : p) coefficient = static_cast<float>(coefficient);
            error = std::max(error, worst(p, f, low, high));
            return p;
        };
        const Polynomial w = rounded(one_plus_lambert), over_w = rounded(reciprocal);
        for (std::size_t j = 0; j < w.size(); ++j) {
            for (const Real c : {w[j], over_w[j]})
                std::printf("%a,%s", static_cast<double>(c), ++count % 7 == 0 ? "\n" : "");
        }
    }
    std::printf("};  // worst relative error %.1Le\n", error);
}

void begin(const std::string& folder, const char* file) {
    if (std::freopen((folder + '/' + file).c_str(), "w", stdout) == nullptr) std::exit(1);
    std::puts(
        "// Written by generate_evaluation_tables; do not edit.\n#include "
        "\"hts/evaluation/evaluation_table.hpp\"\n");
    std::puts("namespace hts::evaluation_detail {\n");
}
void end() {
    std::puts("\n}  // namespace hts::evaluation_detail");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    begin(argv[1], "evaluation_table.cpp");
    print_array(
        "exp2_coefficients", [](Real f) { return std::exp2(f); }, -0.5L, 0.5L, exp2_coefficients.size());
    constexpr Real first = erfcx_centre / Real{erfcx_centre + erfcx_far};
    print_array("erfcx_coefficients", erfcx_over_y, first, 1, erfcx_coefficients.size());
    print_lambert();
    end();
    begin(argv[1], "single_table.cpp");
    print_array<float>("single_erfcx_coefficients", erfcx_over_y, first, 1, single_erfcx_coefficients.size());
    std::puts("// clang-format off");
    print_single_lambert();
    end();
}
