#include "tables/formats/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/lobe_quadrature.hpp"

namespace hts::tables {

using spectral::brief;

double share_of_views(const spectral::Evaluator& brdf, const Direction& in) {
    constexpr int rings = 32, turns = 64;  // of equal projected solid angle
    int known = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const double theta = std::asin(std::sqrt((ring + 0.5) / rings));
        for (int turn = 0; turn < turns; ++turn) {
            const double phi = 2 * std::numbers::pi * (turn + 0.5) / turns;
            known += brdf.knows({in, Direction::from_angles(theta, phi)}) ? 1 : 0;
        }
    }
    return static_cast<double>(known) / (rings * turns);
}

double share_of_pairs(const spectral::Evaluator& brdf) {
    constexpr int rings = 12, turns = 4;
    double sum = 0;
    for (int i = 0; i < rings * turns; ++i) {
        const int ring = i % rings, turn = i / rings;
        const double theta = std::asin(std::sqrt((ring + 0.5) / rings));
        const double phi = 2 * std::numbers::pi * (turn + 0.3) / turns;
        sum += share_of_views(brdf, Direction::from_angles(theta, phi));
    }
    return sum / (rings * turns);
}

std::string coverage_note(const spectral::Reflectance& brdf) {
    const auto micrometres = brdf.wavelengths().micrometres();
    const spectral::MeasuredDomain domain = brdf.evaluator().domain();
    std::string text = "covers " + brief(micrometres.front(), 6);
    if (micrometres.size() > 1)
        text += " to " + brief(micrometres.back(), 6) + " um (" + std::to_string(micrometres.size()) +
                " values), ";
    else
        text += " um, ";
    text += domain.axes + ": ";
    std::vector<double> angles = domain.theta_i;
    if (angles.size() > 4) angles = {angles.front(), angles[angles.size() / 2], angles.back()};
    std::vector<double> shares;
    shares.reserve(angles.size());
    for (const double theta_i : angles)
        shares.push_back(
            share_of_views(brdf.evaluator(), Direction::from_degrees(std::min(theta_i, 89.9), 0)));
    const auto percent = [](double share) { return brief(100 * share, 3) + " %"; };
    if (std::ranges::all_of(shares, [&](double share) { return share == shares.front(); }))
        return text + percent(shares.front()) + " of the hemisphere of views";
    std::string parts;
    for (std::size_t i = 0; i < shares.size(); ++i)
        parts.append(i == 0 ? "" : ", ").append(percent(shares[i]) + " at " + brief(angles[i], 4) + " deg");
    return text + "of the hemisphere of views " + parts;
}

std::vector<double> measured_albedo(const spectral::Evaluator& brdf, const Direction& in, double slope) {
    const auto views = lobe_quadrature(in, slope, 20'000);
    const std::size_t width = brdf.wavelengths().size();
    constexpr std::size_t block = 512;
    std::vector<std::vector<double>> parts((views.size() + block - 1) / block, std::vector<double>(width));
    spectral::parallel_blocks(views.size(), block, [&](std::size_t first, std::size_t count) {
        std::vector<double> values(width);
        auto& sums = parts[first / block];
        for (std::size_t i = first; i < first + count; ++i) {
            brdf.brdf({in, views[i].out}, values);
            const double weight = views[i].weight * views[i].out.cos_theta();
            for (std::size_t k = 0; k < width; ++k) sums[k] += weight * values[k];
        }
    });
    std::vector<double> sums(width, 0);
    for (const auto& part : parts)
        for (std::size_t k = 0; k < width; ++k) sums[k] += part[k];
    return sums;
}

}  // namespace hts::tables
