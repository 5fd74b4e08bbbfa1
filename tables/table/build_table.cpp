#include "tables/table/build_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "tables/table/lobe_nodes.hpp"
#include "tables/table/spline.hpp"
#include "tables/table/table_contents.hpp"
#include "tables/table/table_curves.hpp"
#include "tables/table/table_probes.hpp"

namespace hts::tables {
namespace {

LobeNodes lobe_nodes(const TablePlan& plan) {
    return {plan.nodes.grazing, plan.nodes.ratio, plan.nodes.turn};
}

/// As many more nodes as the error of a cubic spline says, which falls with the fourth
/// power of their distance.
TablePlan refined(TablePlan plan, const TableError& error, const std::string& name) {
    constexpr std::size_t most_refinements = 3;
    constexpr double margin = 1.05, most_growth = 2;
    const TableRequest& request = plan.request;
    if (plan.refinements == most_refinements) {
        throw Error{name + ": measured error " + shortest(error.largest) +
                    " of the finished table, refined " + std::to_string(most_refinements) +
                    " times: must be at most the tolerance " + shortest(request.tolerance) +
                    "; give a larger --tolerance"};
    }
    const double growth = std::min(margin * std::pow(error.largest / request.tolerance, 0.25), most_growth);
    const std::size_t node_bytes =
        plan.basis.size() / plan.floor.size() * (needs_double(request) ? sizeof(double) : sizeof(float));
    auto bytes = static_cast<double>(node_bytes);
    for (std::size_t* axis : {&plan.nodes.grazing, &plan.nodes.ratio, &plan.nodes.turn}) {
        *axis = static_cast<std::size_t>(std::ceil(static_cast<double>(*axis) * growth));
        bytes *= static_cast<double>(*axis + spline_ghosts);
    }
    if (bytes > static_cast<double>(request.largest_bytes)) {
        throw Error{name + ": measured error " + shortest(error.largest) + ": the tolerance " +
                    shortest(request.tolerance) + " must be one that " +
                    std::to_string(request.largest_bytes) + " bytes can meet"};
    }
    ++plan.refinements;
    return plan;
}

}  // namespace

std::vector<double> table_slice(const spectral::Reflectance& exact, const TablePlan& plan,
                                std::size_t slice) {
    return slice_values(exact, plan.spacing, lobe_nodes(plan), slice, plan.floor, plan.basis);
}

MeasuredTable measured_table(const spectral::Reflectance& exact, const TableSource& source,
                             const TablePlan& plan, std::vector<std::vector<double>> slices) {
    const TableRequest& request = plan.request;
    const CoordinateMap map{plan.spacing};
    const std::size_t width = plan.floor.size();
    OwnedNumbers numbers{plan.floor, std::vector<double>(width), {}, {}, {}, plan.basis, {}};
    exact.uniform_diffuse(numbers.uniform_diffuse);
    numbers.lobe = lobe_coefficients(slices, lobe_nodes(plan), plan.basis.size() / width);
    slices.clear();
    Curve specular = specular_curve(exact, map, request.tolerance);
    Curve albedo = albedo_curve(exact, map, request.tolerance);
    Curve polarisation = request.polarised ? polarisation_curve(exact, request.tolerance) : Curve{0, {}};
    TableNodes nodes = plan.nodes;
    nodes.specular = specular.nodes;
    nodes.albedo = albedo.nodes;
    nodes.polarisation = polarisation.nodes;
    numbers.specular = std::move(specular.coefficients);
    numbers.albedo = std::move(albedo.coefficients);
    numbers.polarisation = std::move(polarisation.coefficients);
    TableInfo info{source,
                   exact.wavelengths(),
                   request.tolerance,
                   {},
                   plan.spacing,
                   nodes,
                   plan.basis.size() / width,
                   needs_double(request),
                   library_version()};
    const Table unmeasured = Table::from_bytes(table_bytes(info, numbers), source.name);
    info.error = table_error(unmeasured.reflectance(), exact, measured_pairs, measured_seed(request.seed));
    return {table_bytes(info, numbers), info.error};
}

SliceSource computed_slices(const spectral::Reflectance& exact) {
    return [&exact](const TablePlan& plan) {
        std::vector<std::vector<double>> slices(plan.slices());
        spectral::parallel_for(slices.size(),
                               [&](std::size_t i) { slices[i] = table_slice(exact, plan, i); });
        return slices;
    };
}

std::string finished_table(const spectral::Reflectance& exact, const TableSource& source, TablePlan plan,
                           const SliceSource& slices) {
    for (;;) {
        MeasuredTable table = measured_table(exact, source, plan, slices(plan));
        if (table.error.largest <= plan.request.tolerance) {
            // with its header and the curves beside the lobe, which the plan does not count
            if (table.bytes.size() <= plan.request.largest_bytes) return std::move(table.bytes);
            throw Error{source.name + ": table of " + std::to_string(table.bytes.size()) +
                        " bytes: must be at most " + std::to_string(plan.request.largest_bytes) +
                        " bytes, the largest asked for"};
        }
        plan = refined(std::move(plan), table.error, source.name);
    }
}

Table build_table(const spectral::Reflectance& exact, const TableSource& source, const TableRequest& request,
                  const TableProgress& progress) {
    return Table::from_bytes(
        finished_table(exact, source, plan_table(exact, request, progress), computed_slices(exact)),
        source.name);
}

}  // namespace hts::tables
