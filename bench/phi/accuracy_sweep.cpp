#include "bench/phi/accuracy_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"

namespace hts::bench {
namespace {

/// A method's values, its work shared by all cores in blocks.
std::vector<double> values(const ChartMethod& method, const PhiInputs& inputs) {
    std::vector<double> result(inputs.size());
    spectral::parallel_blocks(inputs.size(), 16, [&](std::size_t first, std::size_t count) {
        method.values(std::span{inputs.g}.subspan(first, count), std::span{inputs.t}.subspan(first, count),
                      std::span{result}.subspan(first, count));
    });
    return result;
}

std::vector<PhiReference> references(const PhiInputs& inputs) {
    std::vector<PhiReference> result(inputs.size());
    const auto refer = [&](std::size_t i) { result[i] = phi_reference(inputs.g[i], inputs.t[i]); };
    spectral::parallel_for(inputs.size(), refer, 16);
    return result;
}

}  // namespace

ReferencePoints with_reference(const PhiInputs& inputs) {
    const auto phi = references(inputs);
    ReferencePoints result;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (phi[i].value == 0) continue;
        result.inputs.g.push_back(inputs.g[i]);
        result.inputs.t.push_back(inputs.t[i]);
        result.inputs.weights.push_back(inputs.weights[i]);
        result.phi.push_back(phi[i]);
    }
    return result;
}

ErrorSummary errors(const ChartMethod& method, const ReferencePoints& points) {
    const std::vector<double> computed = values(method, points.inputs);
    ErrorSummary summary{.points = computed.size()};
    std::vector<double> all;
    double energy = 0, energy_wrong = 0;
    for (std::size_t i = 0; i < computed.size(); ++i) {
        const double error = points.phi[i].relative_error(computed[i]);
        const double share = points.inputs.weights[i] * points.phi[i].value;
        all.push_back(error);
        energy += share;
        energy_wrong += share * (std::isfinite(error) ? error : 1);
        if (error >= 1) ++summary.failures;
        if (i > 0 && !(error > summary.worst)) continue;
        summary.worst = error;
        summary.worst_g = points.inputs.g[i];
        summary.worst_t = points.inputs.t[i];
    }
    if (all.empty()) return summary;
    summary.quantile = spectral::in_order(std::move(all), computed.size() * 999 / 1000);
    summary.energy = energy_wrong / energy;
    return summary;
}

double PlaneGrid::g(std::size_t column) const noexcept {
    const double place = (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
    return least_g * std::pow(most_g / least_g, place);
}

double PlaneGrid::ratio(std::size_t row) const noexcept {
    const double place = (static_cast<double>(row) + 0.5) / static_cast<double>(rows);
    return least_ratio * std::pow(greatest_ratio / least_ratio, place);
}

PlaneReference plane_reference(const PlaneGrid& grid) {
    PlaneReference plane{grid, {}, {}};
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            plane.inputs.g.push_back(grid.g(column));
            plane.inputs.t.push_back(grid.g(column) * grid.ratio(row));
        }
    }
    plane.phi = references(plane.inputs);
    return plane;
}

std::vector<double> plane_errors(const ChartMethod& method, const PlaneReference& plane) {
    std::vector<double> cells = values(method, plane.inputs);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const PhiReference& phi = plane.phi[i];
        cells[i] = phi.value == 0 ? std::numeric_limits<double>::quiet_NaN() : phi.relative_error(cells[i]);
    }
    return cells;
}

}  // namespace hts::bench
