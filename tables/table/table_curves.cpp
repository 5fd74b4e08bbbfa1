#include "tables/table/table_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "tables/table/spline.hpp"

namespace hts::tables {
namespace {

using Values = std::vector<double>;
using Function = std::function<Values(double)>;

double curve_value(const Curve& curve, double x, std::size_t i, std::size_t width) {
    const SplinePlace place = spline_place(x, curve.nodes);
    double value = 0;
    for (std::size_t k = 0; k < 4; ++k)
        value += place.weights[k] * curve.coefficients[(place.first + k) * width + i];
    return value;
}

std::vector<Values> values_at(const Function& f, std::size_t count, double from, double step) {
    std::vector<Values> values(count);
    spectral::parallel_for(count,
                           [&](std::size_t i) { values[i] = f(from + step * static_cast<double>(i)); });
    return values;
}

/// Twice as many pieces until no middle of a piece is off by more than `tolerance`
/// times its value plus `scale`.
Curve fitted(const Function& f, SplineStart start, double tolerance, double scale, const std::string& what) {
    constexpr std::size_t most_nodes = 8193;
    for (std::size_t nodes = 9; nodes <= most_nodes; nodes = 2 * nodes - 1) {
        const double step = 1 / static_cast<double>(nodes - 1);
        const auto at_nodes = values_at(f, nodes, 0, step), between = values_at(f, nodes - 1, step / 2, step);
        const std::size_t width = at_nodes[0].size();
        Curve curve{nodes, Values((nodes + spline_ghosts) * width)};
        for (std::size_t i = 0; i < nodes; ++i) {
            std::ranges::copy(at_nodes[i],
                              curve.coefficients.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
        }
        to_spline_coefficients(curve.coefficients, nodes, width, start);
        double worst = 0;
        for (std::size_t i = 0; i + 1 < nodes; ++i) {
            const double x = (static_cast<double>(i) + 0.5) * step;
            for (std::size_t w = 0; w < width; ++w) {
                const double exact = between[i][w];
                worst = std::max(
                    worst, std::abs(curve_value(curve, x, w, width) - exact) / (std::abs(exact) + scale));
            }
        }
        if (worst <= tolerance) return curve;
    }
    throw Error{what + ": is not smooth over the polar angle: a table must be of a surface for which it is"};
}

constexpr double share = 0.5, peak_share = 1e-3;

struct Node {
    double place, weight;
};

/// Nodes of 8-point Gauss-Legendre panels between the given edges.
std::vector<Node> panels(const std::vector<double>& edges) {
    constexpr std::array<Node, 4> half{{{0.1834346424956498, 0.3626837833783620},
                                        {0.5255324099163290, 0.3137066458778873},
                                        {0.7966664774136267, 0.2223810344533745},
                                        {0.9602898564975363, 0.1012285362903763}}};
    std::vector<Node> nodes;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const double middle = (edges[i] + edges[i + 1]) / 2, reach = (edges[i + 1] - edges[i]) / 2;
        for (const Node& node : half) {
            nodes.push_back({middle - reach * node.place, reach * node.weight});
            nodes.push_back({middle + reach * node.place, reach * node.weight});
        }
    }
    return nodes;
}

std::vector<double> polar_edges(double theta_in) {
    constexpr double right_angle = std::numbers::pi / 2;
    std::vector<double> edges{0, right_angle};
    for (const double degrees : {0.0, 1.0, 3.0, 8.0, 18.0, 38.0}) {
        for (const double sign : {-1.0, 1.0}) {
            const double edge = theta_in + sign * degrees * right_angle / 90;
            if (edge > 1e-3 && edge < right_angle - 1e-3) edges.push_back(edge);
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Angles from the mirror plane and their weights for the whole circle of an even integrand.
std::vector<Node> azimuths(double density) {
    const double end = std::asinh(density * std::numbers::pi);
    std::vector<Node> nodes = panels({0, end / 4, end / 2, 3 * end / 4, end});
    for (Node& node : nodes) {
        node.weight *= 2 * std::cosh(node.place) / density;
        node.place = std::sinh(node.place) / density;
    }
    return nodes;
}

}  // namespace

void lobe_albedo(const spectral::Reflectance& exact, const Direction& in, std::span<double> values) {
    std::ranges::fill(values, 0.0);
    Values lobe(values.size());
    for (const Node& polar : panels(polar_edges(std::atan2(in.sin_theta(), in.cos_theta())))) {
        const double cosine = std::cos(polar.place), sine = std::sin(polar.place);
        const double density = 1 + 6 * std::sqrt(in.sin_theta() * sine) / (in.cos_theta() + cosine);
        for (const Node& azimuth : azimuths(density)) {
            const double c = -std::cos(azimuth.place), s = std::sin(azimuth.place);
            const DirectionPair pair{Direction::from_unit_vector({in.sin_theta(), 0, in.cos_theta()}),
                                     Direction::from_unit_vector({sine * c, sine * s, cosine})};
            exact.directional_diffuse(pair, lobe);
            const double weight = polar.weight * azimuth.weight * sine * cosine;
            for (std::size_t w = 0; w < values.size(); ++w) values[w] += weight * lobe[w];
        }
    }
}

Curve specular_curve(const spectral::Reflectance& exact, const CoordinateMap& map, double tolerance) {
    return fitted(
        [&](double grazing) {
            Values values(exact.wavelengths().size());
            exact.specular_reflectance(map.direction(grazing), values);
            return values;
        },
        SplineStart::even, share * tolerance, peak_share, exact.name() + ": specular reflectance");
}

Curve albedo_curve(const spectral::Reflectance& exact, const CoordinateMap& map, double tolerance) {
    return fitted(
        [&](double grazing) {
            Values values(exact.wavelengths().size());
            lobe_albedo(exact, map.direction(grazing), values);
            return values;
        },
        SplineStart::even, std::max(share * tolerance, accuracy::lobe_albedo), 1,
        exact.name() + ": albedo of the lobe");
}

Curve polarisation_curve(const spectral::Reflectance& exact, double tolerance) {
    const std::size_t width = exact.wavelengths().size();
    Values uniform(width);
    exact.uniform_diffuse(uniform);
    const double lowest = std::cos(steepest_theta);
    return fitted(
        [&](double cosine) {
            const double c = std::max(cosine, lowest), s = std::sqrt((1 - c) * (1 + c));
            std::vector<Mueller> matrices(width);
            exact.mueller({Direction::from_unit_vector({s, 0, c}), Direction::from_unit_vector({-s, 0, c})},
                          matrices);
            Values values(2 * width);
            for (std::size_t w = 0; w < width; ++w) {
                const Mueller& m = matrices[w];
                const double of_s = m(0, 0) - uniform[w] + m(0, 1);
                values[w] = m(2, 2) / of_s;
                values[width + w] = -m(2, 3) / of_s;
            }
            return values;
        },
        SplineStart::free, share * tolerance / 2, 1, exact.name() + ": polarisation");
}

}  // namespace hts::tables
