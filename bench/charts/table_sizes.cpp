#include "bench/charts/table_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "spectral/jobs/progress.hpp"
#include "spectral/output/script.hpp"
#include "spectral/parallel.hpp"
#include "tables/table/spline.hpp"
#include "tables/table/table_coordinates.hpp"
#include "tables/table/table_lobe.hpp"
#include "tables/table/table_probes.hpp"

namespace hts::bench {
namespace {

using tables::Coordinates;
constexpr double right_angle = std::numbers::pi / 2;

/// Coordinates of a pair, each 0 ... 1, and a pair for coordinates; the latter may lie below the horizon.
struct Chart {
    std::function<Coordinates(const DirectionPair&)> coordinates;
    std::function<std::array<Vector3, 2>(const Coordinates&)> vectors;
};

Vector3 vector(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

double angle(double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

Chart plain_angles() {
    const double steepest = tables::steepest_theta;
    return {[=](const DirectionPair& pair) {
                const double cosine =
                    pair.in.cos_phi() * pair.out.cos_phi() + pair.in.sin_phi() * pair.out.sin_phi();
                return Coordinates{angle(pair.in.cos_theta()) / steepest,
                                   angle(pair.out.cos_theta()) / steepest, angle(cosine) / std::numbers::pi};
            },
            [=](const Coordinates& at) {
                return std::array{vector(at[0] * steepest, 0),
                                  vector(at[1] * steepest, at[2] * std::numbers::pi)};
            }};
}

/// theta_h by its square root, theta_d, phi_d: Rusinkiewicz's angles as MERL spaces them.
Chart half_vector_angles() {
    return {[](const DirectionPair& pair) {
                const Vector3 in = pair.in.vector(), sum = in + pair.out.vector();
                const double length = std::sqrt(dot(sum, sum));
                const Vector3 half = (1 / length) * sum;
                const double sine = std::sqrt(half.x * half.x + half.y * half.y);
                const double cosine_d = std::min(1.0, length / 2);
                const Vector3 along = sine > 0 ? Vector3{half.x / sine, half.y / sine, 0} : Vector3{1, 0, 0};
                const Vector3 across{-along.y, along.x, 0}, up = cross(half, across);
                const double phi = std::atan2(std::abs(dot(in, across)), std::abs(dot(in, up)));
                return Coordinates{std::sqrt(angle(half.z) / right_angle), angle(cosine_d) / right_angle,
                                   phi / right_angle};
            },
            [](const Coordinates& at) {
                const double theta_h = at[0] * at[0] * right_angle;
                const Vector3 half = vector(theta_h, 0), across{0, 1, 0}, up = cross(half, across);
                const Vector3 turned = vector(at[1] * right_angle, at[2] * right_angle);
                // Of the two signs of phi_d the one that keeps the pair above the horizon for longer.
                const Vector3 in = turned.z * half + turned.x * (-up) + turned.y * across;
                return std::array{in, 2 * dot(in, half) * half - in};
            }};
}

Chart own_coordinates() {
    const tables::CoordinateMap map{tables::TableSpacing{}};
    return {[map](const DirectionPair& pair) { return map(pair); },
            [map](const Coordinates& at) {
                const DirectionPair pair = map.pair(at);
                return std::array{pair.in.vector(), pair.out.vector()};
            }};
}

/// Random pairs with their exact values at some wavelengths.
struct Exact {
    std::vector<DirectionPair> pairs;
    std::vector<std::size_t> wavelengths;
    std::vector<double> lobe, scale, floor;
};

Exact exact_values(const spectral::Reflectance& exact, std::size_t pairs, std::uint64_t seed) {
    const std::size_t width = exact.wavelengths().size();
    Exact result{tables::RandomPairs{seed}.next(pairs), {}, {}, {}, {}};
    constexpr std::size_t most = 5;
    const std::size_t count = std::min(width, most);
    for (std::size_t i = 0; i < count; ++i)
        result.wavelengths.push_back(count == 1 ? 0 : i * (width - 1) / (count - 1));
    const tables::LobePeaks peaks{exact};
    for (const std::size_t w : result.wavelengths) result.floor.push_back(1e-12 * peaks.least(w));
    std::vector<double> values(width);
    for (const DirectionPair& pair : result.pairs) {
        exact.directional_diffuse(pair, values);
        for (const std::size_t w : result.wavelengths) {
            result.lobe.push_back(values[w]);
            result.scale.push_back(tables::error_scale(values[w], peaks(pair.in, w)));
        }
    }
    return result;
}

Direction above_horizon(Vector3 v) {
    v.z = std::max(v.z, 0.0);
    return Direction::from_vector(v);
}

/// Values at the nodes of an n^3 grid, where a pair lies below the horizon those of the nearest on it.
std::vector<double> node_values(const spectral::Reflectance& exact, const Exact& probes, const Chart& chart,
                                std::size_t n, bool logarithm) {
    const std::size_t width = probes.wavelengths.size(), padded = n + tables::spline_ghosts;
    std::vector<double> block(padded * padded * padded * width);
    spectral::parallel_for(n, [&](std::size_t i) {
        std::vector<double> values(exact.wavelengths().size());
        const auto last = static_cast<double>(n - 1);
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t k = 0; k < n; ++k) {
                const auto [in, out] =
                    chart.vectors({static_cast<double>(i) / last, static_cast<double>(j) / last,
                                   static_cast<double>(k) / last});
                exact.directional_diffuse({above_horizon(in), above_horizon(out)}, values);
                for (std::size_t w = 0; w < width; ++w) {
                    const double value = values[probes.wavelengths[w]];
                    block[(((i + 1) * padded + j + 1) * padded + k + 1) * width + w] =
                        logarithm ? std::log(value + probes.floor[w]) : value;
                }
            }
        }
    });
    return block;
}

/// Weights of the two neighbours, as of a spline's four.
tables::SplinePlace linear_place(double x, std::size_t nodes) {
    const double scaled = std::clamp(x, 0.0, 1.0) * static_cast<double>(nodes - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(scaled), nodes - 2);
    const double f = scaled - static_cast<double>(first);
    return {first, {0, 1 - f, f, 0}};
}

void to_spline(std::vector<double>& block, std::size_t n, std::size_t width) {
    const std::size_t padded = n + tables::spline_ghosts, row = padded * width, plane = padded * row;
    for (std::size_t i = 1; i <= n; ++i) {
        const std::span own = std::span{block}.subspan(i * plane, plane);
        tables::to_spline_coefficients(own.subspan(row, n * row), n, width, tables::SplineStart::free);
        tables::to_spline_coefficients(own, n, row, tables::SplineStart::free);
    }
    tables::to_spline_coefficients(block, n, plane, tables::SplineStart::free);
}

/// The largest error of an n^3 grid: linear in f, or cubic in its logarithm.
double grid_error(const spectral::Reflectance& exact, const Exact& probes, const Chart& chart, std::size_t n,
                  bool cubic) {
    const std::size_t width = probes.wavelengths.size(), padded = n + tables::spline_ghosts;
    std::vector<double> block = node_values(exact, probes, chart, n, cubic);
    if (cubic) to_spline(block, n, width);
    double worst = 0;
    for (std::size_t p = 0; p < probes.pairs.size(); ++p) {
        const Coordinates at = chart.coordinates(probes.pairs[p]);
        std::array<tables::SplinePlace, 3> place;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] = cubic ? tables::spline_place(at[axis], n) : linear_place(at[axis], n);
        }
        for (std::size_t w = 0; w < width; ++w) {
            double sum = 0;
            for (std::size_t node = 0; node < 64; ++node) {
                const std::size_t i = node / 16, j = node / 4 % 4, k = node % 4;
                const double weight = place[0].weights[i] * place[1].weights[j] * place[2].weights[k];
                if (weight == 0) continue;
                sum += weight * block[(((place[0].first + i) * padded + place[1].first + j) * padded +
                                       place[2].first + k) *
                                          width +
                                      w];
            }
            const double value = cubic ? std::exp(sum) - probes.floor[w] : sum;
            const std::size_t own = p * width + w;
            worst = std::max(worst, std::abs(value - probes.lobe[own]) / probes.scale[own]);
        }
    }
    return worst;
}

}  // namespace

std::vector<TableSize> table_sizes(const spectral::Reflectance& exact, std::size_t pairs,
                                   std::uint64_t seed) {
    const Exact probes = exact_values(exact, pairs, seed);
    const auto wavelengths = static_cast<double>(exact.wavelengths().size());
    struct Way {
        const char* name;
        Chart chart;
        bool cubic;
    };
    const std::array<Way, 4> ways{{{"plain angles (θi, θr, Δφ): f, linear", plain_angles(), false},
                                   {"half-vector angles as in MERL: f, linear", half_vector_angles(), false},
                                   {"plain angles (θi, θr, Δφ): ln f, cubic", plain_angles(), true},
                                   {"folded coordinates: ln f, cubic", own_coordinates(), true}}};
    std::vector<TableSize> sizes;
    const spectral::Job job{"", 6 * (std::size(ways) + 1)};
    for (const Way& way : ways) {
        for (const int nodes : {8, 12, 18, 27, 40, 60}) {
            const auto n = static_cast<std::size_t>(nodes);
            const double bytes = sizeof(float) * wavelengths * std::pow(static_cast<double>(n), 3);
            sizes.push_back({way.name, bytes, grid_error(exact, probes, way.chart, n, way.cubic)});
            job.done();
        }
    }
    for (const double tolerance : {0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4}) {
        const tables::Table table =
            tables::build_table(exact, {exact.name(), "", ""}, {.tolerance = tolerance});
        const auto error = tables::table_error(table.reflectance(), exact, pairs, seed);
        sizes.push_back({"hts table build: the same, few spectra, nodes by need",
                         static_cast<double>(table.bytes()), error.largest});
        job.done();
    }
    return sizes;
}

std::string table_sizes_script(const std::vector<TableSize>& sizes, const std::string& surface) {
    std::vector<std::string> ways;
    std::vector<output::Rows> lines;
    for (const TableSize& size : sizes) {
        if (ways.empty() || ways.back() != size.way) {
            ways.push_back(size.way);
            lines.emplace_back();
        }
        lines.back().push_back({size.bytes, size.error});
    }
    output::Script script;
    script.set("title", surface + ": size of a table against its largest error").set("way", ways);
    return script.data("sizes", lines).with("table-sizes");
}

}  // namespace hts::bench
