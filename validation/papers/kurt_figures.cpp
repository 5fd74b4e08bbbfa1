#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "hts/error.hpp"
#include "hts/microfacet/albedo.hpp"
#include "hts/microfacet/kurt.hpp"
#include "spectral/output/script.hpp"
#include "spectral/parallel.hpp"
#include "validation/papers/microfacet_figures.hpp"

namespace hts::validation {
namespace {

double albedo(const KurtLobe& lobe, double degrees) {
    return directional_albedo(Kurt{0, {{1, lobe}}}, Direction::from_degrees(degrees, 0));
}

/// Of (9), a BRDF of its own.
double symmetric_albedo(double m, double degrees) {
    const GaussianSlopes slopes{m, m};
    const Direction in = Direction::from_degrees(degrees, 0);
    return directional_albedo(
        [&](const Direction& out) {
            const HalfDirection half = half_direction(in, out);
            return slopes.density(half) / (4 * half.cos_theta_d * std::max(in.cos_theta(), out.cos_theta()));
        },
        in);
}

/// A column of angles, 0 ... 89 deg, and one per curve.
FigureTable albedo_table(const std::string& stem, const std::vector<std::string>& curves,
                         const std::function<double(std::size_t curve, double degrees)>& value) {
    FigureTable table{stem, {"theta_i_deg"}, {}};
    table.columns.insert(table.columns.end(), curves.begin(), curves.end());
    for (double degrees = 0; degrees < 90; degrees += degrees < 87 ? 3 : 1) {
        table.rows.emplace_back(1, degrees);
        table.rows.back().resize(curves.size() + 1);
    }
    spectral::parallel_for(
        table.rows.size() * curves.size(),
        [&](std::size_t i) {
            auto& row = table.rows[i / curves.size()];
            row[i % curves.size() + 1] = value(i % curves.size(), row.front());
        },
        1);
    return table;
}

std::vector<std::string> texts(const std::string& before, const std::vector<double>& values,
                               const std::string& after = {}) {
    std::vector<std::string> result;
    result.reserve(values.size());
    for (const double value : values)
        result.push_back(std::string{before}.append(shortest(value)).append(after));
    return result;
}

Figure kurt_figure_2() {
    const std::vector<double> widths{0.05, 0.1, 0.2, 0.3, 0.5, 1};
    Figure figure{
        "figure-2",
        {albedo_table("figure-2", texts("m_", widths),
                      [&](std::size_t i, double degrees) { return symmetric_albedo(widths[i], degrees); })},
        {}};
    figure.script = output::Script{}.set("curve", texts("m = ", widths)).with("kurt-figure-2");
    return figure;
}

Figure kurt_figure_3() {
    const std::vector<double> widths{0.05, 0.2, 0.5}, alphas{0, 0.1, 0.25, 0.5, 0.75, 1};
    Figure figure{"figure-3", {}, {}};
    std::vector<std::string> files;
    for (const double m : widths) {
        const std::string stem = "figure-3-m-" + shortest(m);
        figure.tables.push_back(
            albedo_table(stem, texts("alpha_", alphas), [&](std::size_t i, double degrees) {
                return albedo({1, m, m, alphas[i]}, degrees);
            }));
        files.push_back(stem + ".csv");
    }
    output::Script script;
    script.set("width", widths).set("data", files).set("curve", texts("α = ", alphas));
    figure.script = script.with("kurt-figure-3");
    return figure;
}

constexpr std::array map_angles{0.0, 20.0, 40.0, 60.0, 67.5, 75.0, 80.0, 85.0, 87.0, 89.0};
constexpr std::array map_limits{60.0, 75.0, 85.0, 89.0};
constexpr double map_top = 1.5;

/// The exponent with which the albedo at one angle is 1, at most map_top; it grows with the exponent, its
/// logarithm nearly in proportion, so secants soon meet it.
double largest_alpha(double m, double degrees) {
    const auto excess = [&](double alpha) { return std::log(albedo({1, m, m, alpha}, degrees)); };
    double before = 0, alpha = 0.5;
    double excess_before = excess(before);
    for (int step = 0; step < 12; ++step) {
        const double now = excess(alpha);
        if (std::abs(now) < 1e-5 || now == excess_before) break;
        const double next = std::clamp(alpha - now * (alpha - before) / (now - excess_before), 0.0, map_top);
        before = alpha;
        excess_before = now;
        alpha = next;
    }
    return alpha;
}

/// m, and per limit the largest exponent with which the albedo is at most 1 at every angle up to the limit.
FigureTable plausibility_table() {
    FigureTable table{"plausible-alpha", {"m"}, {}};
    for (const double limit : map_limits) table.columns.push_back("alpha_to_" + shortest(limit) + "_deg");
    constexpr int widths = 21;
    for (int i = 0; i < widths; ++i) {
        table.rows.emplace_back(1, 0.02 * std::pow(100, i / (widths - 1.0)));
        table.rows.back().resize(map_limits.size() + 1, map_top);
    }
    spectral::parallel_for(
        table.rows.size(),
        [&](std::size_t i) {
            auto& row = table.rows[i];
            for (const double angle : map_angles) {
                const double alpha = largest_alpha(row[0], angle);
                for (std::size_t k = 0; k < map_limits.size(); ++k) {
                    if (angle <= map_limits[k]) row[k + 1] = std::min(row[k + 1], alpha);
                }
            }
        },
        1);
    return table;
}

Figure plausibility_map() {
    Figure figure{"plausible-alpha", {plausibility_table()}, {}};
    output::Script script;
    script.set("curve", texts("to θ = ", {map_limits.begin(), map_limits.end()}, "°"));
    figure.script = script.with("kurt-plausible-alpha");
    return figure;
}

}  // namespace

std::vector<Figure> kurt_figures() {
    return {kurt_figure_2(), kurt_figure_3(), plausibility_map()};
}

}  // namespace hts::validation
