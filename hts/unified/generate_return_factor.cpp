// Writes return_factor_table.cpp to standard output, a minute or two: cmake --build build/release --target
// hts_return_factor. The equation of return_factor.hpp at Chebyshev's nodes in y, for each of Chebyshev's
// nodes in the slope. The integral is over the slopes of facets, alpha rho (cos psi, sin psi), out to where
// the reflected ray meets the horizon; there the integrand is smooth. psi = pi/2 -+ cos theta sinh(x) follows
// the way to the horizon at grazing incidence.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

#include "hts/unified/return_factor_table.hpp"

namespace {

constexpr std::size_t nodes = 32;  // in y: more than the table's terms
constexpr double farthest = 6.5;   // in rho: the Gaussian is 4e-19 there
constexpr double pi = std::numbers::pi;

using Row = std::array<double, nodes>;

double node(std::size_t i, std::size_t count) {
    return std::cos(pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
}

/// c Lambda
double masked(double c) {
    return (std::exp(-c * c) / std::sqrt(pi) - c * std::erfc(c)) / 2;
}

/// f(x, weight) at Gauss's nodes of panels that share 0 ... 1.
template <class Function>
void for_gauss_nodes(int panels, Function&& f) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    for (int panel = 0; panel < panels; ++panel) {
        for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
            for (const int sign : {-1, 1})
                f((panel + 0.5 * (1 + sign * Rule::abscissa()[i])) / panels,
                  0.5 * Rule::weights()[i] / panels);
        }
    }
}

/// Values at y of the polynomials that are 1 at one node and 0 at the others.
Row lagrange(double y) {
    Row weights;
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) {
        const double angle = pi * (static_cast<double>(j) + 0.5) / nodes;
        double distance = 2 * y - 1 - node(j, nodes);
        if (std::abs(distance) < 1e-15) distance = 1e-15;
        weights[j] = (j % 2 == 0 ? 1 : -1) * std::sin(angle) / distance;
        sum += weights[j];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// Coefficients of the interpolant of values at Chebyshev's nodes.
template <class Values>
std::vector<double> interpolant(const Values& values, std::size_t size) {
    std::vector<double> result(size, 0.0);
    for (std::size_t k = 0; k < size; ++k) {
        for (std::size_t j = 0; j < values.size(); ++j)
            result[k] += values[j] * std::cos(static_cast<double>(k) * pi * (static_cast<double>(j) + 0.5) /
                                              static_cast<double>(values.size()));
        result[k] *= (k == 0 ? 1.0 : 2.0) / static_cast<double>(values.size());
    }
    return result;
}

/// The kernel for one incident direction: the integral of kernel times m is the sum of
/// row times m at the nodes.
Row kernel_row(double slope, double y) {
    const double alpha = 2 * slope, c = 1 / y - 1;
    const double cosine = alpha * c / std::hypot(alpha * c, 1.0), sine = 1 / std::hypot(alpha * c, 1.0);
    const double range = std::asinh(pi / 2 / cosine);
    Row row{};
    for (const int side : {1, -1}) {
        for_gauss_nodes(3, [&](double x, double x_weight) {
            const double turn = cosine * std::sinh(range * x);
            const double psi = pi / 2 - side * turn, psi_by_x = range * std::hypot(cosine, turn);
            const double along = sine * std::cos(psi), root = std::hypot(along, cosine);
            const double to_horizon = along > 0 ? (along + root) / cosine : cosine / (root - along);
            const double last = std::min(to_horizon / alpha, farthest);
            for_gauss_nodes(3, [&](double u, double u_weight) {
                const double rho = last * u, a = rho * std::cos(psi);
                const double up = std::max(
                    2 * (sine * alpha * a + cosine) / (1 + alpha * alpha * rho * rho) - cosine, 1e-300);
                const double c_out = up / std::sqrt(std::max((1 - up) * (1 + up), 1e-300)) / alpha;
                const double share = 2 * std::exp(-rho * rho) / pi * rho * (c + a) * c_out /
                                     ((c + masked(c)) * c_out + c * masked(c_out)) * last * u_weight *
                                     x_weight * psi_by_x;
                const Row at = lagrange(1 / (1 + c_out));
                for (std::size_t j = 0; j < nodes; ++j) row[j] += share * at[j];
            });
        });
    }
    return row;
}

struct Solution {
    Row m, single;  // m, and what a single reflection returns, at the nodes
};

Solution solution(double slope) {
    std::array<Row, nodes> kernel;
    Solution result{};
    for (std::size_t i = 0; i < nodes; ++i) {
        kernel[i] = kernel_row(slope, (1 + node(i, nodes)) / 2);
        for (const double share : kernel[i]) result.single[i] += share;
    }
    result.m.fill(1);
    for (int step = 0; step < 1000; ++step) {
        Row next = result.m;
        double change = 0;
        for (std::size_t i = 0; i < nodes; ++i) {
            double returned = 0;
            for (std::size_t j = 0; j < nodes; ++j) returned += kernel[i][j] * result.m[j];
            returned *= result.m[i];
            next[i] /= std::sqrt(returned);
            change = std::max(change, std::abs(returned - 1));
        }
        result.m = next;
        if (change < 1e-13) break;
    }
    return result;
}

/// 2 times the integral of E c dc.
double of_uniform_light(double slope, const Row& single) {
    const auto e = interpolant(single, nodes);
    double sum = 0;
    for_gauss_nodes(8, [&](double cosine, double weight) {
        const double width_sine = 2 * slope * std::sqrt((1 - cosine) * (1 + cosine));
        const double x = std::acos(2 * width_sine / (width_sine + cosine) - 1);
        double value = 0;
        for (std::size_t k = 0; k < nodes; ++k) value += e[k] * std::cos(static_cast<double>(k) * x);
        sum += 2 * cosine * value * weight;
    });
    return sum;
}

}  // namespace

int main() {
    constexpr std::size_t slopes = hts::return_factor_slopes;
    std::array<std::array<double, slopes>, nodes> by_term{};
    std::array<double, slopes> single{};
    for (std::size_t i = 0; i < slopes; ++i) {
        const double slope = (1 + node(i, slopes)) / 2;
        const Solution solved = solution(slope);
        const auto m = interpolant(solved.m, nodes);
        for (std::size_t j = 0; j < nodes; ++j) by_term[j][i] = m[j];
        single[i] = of_uniform_light(slope, solved.single);
    }
    std::array<std::vector<double>, nodes> columns;
    for (std::size_t j = 0; j < nodes; ++j) columns[j] = interpolant(by_term[j], slopes);
    std::puts(
        "// Written by generate_return_factor; do not edit.\n// clang-format off\n"
        "#include \"hts/unified/return_factor_table.hpp\"\n\nnamespace hts {\n\n"
        "const std::array<std::array<double, ReturnFactor::terms>, return_factor_slopes> "
        "return_factor_table{{");
    for (std::size_t i = 0; i < slopes; ++i) {
        std::printf("{{");
        for (std::size_t j = 0; j < hts::ReturnFactor::terms; ++j)
            std::printf("%.9f,%s", columns[j][i], (j + 1) % 7 == 0 ? "\n" : " ");
        std::puts("}},");
    }
    std::puts("}};\n\nconst std::array<double, return_factor_slopes> single_reflection_table{");
    for (const double value : interpolant(single, slopes)) std::printf("%.9f,\n", value);
    std::puts("};\n\n}  // namespace hts");
}
