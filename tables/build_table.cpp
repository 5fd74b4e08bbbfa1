#include "tables/build_table.hpp"

#include <algorithm>
#include <utility>

#include "hts/error.hpp"
#include "tables/lobe_nodes.hpp"
#include "tables/table_contents.hpp"
#include "tables/table_curves.hpp"
#include "tables/table_probes.hpp"

namespace hts::tables {
namespace {

LobeNodes lobe_nodes(const TablePlan& plan) {
    return {plan.nodes.grazing, plan.nodes.ratio, plan.nodes.turn};
}

}  // namespace

std::vector<double> table_slice(const SpectralBrdf& exact, const TablePlan& plan, std::size_t slice) {
    return slice_values(exact, plan.spacing, lobe_nodes(plan), slice, plan.floor, plan.basis);
}

std::string finished_table(const SpectralBrdf& exact, const TableSource& source, const TablePlan& plan,
                           std::vector<std::vector<double>> slices) {
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
    info.error = table_error(unmeasured, exact, measured_pairs, measured_seed(request.seed));
    if (info.error.largest > request.tolerance) {
        throw Error{source.name + ": measured error " + shortest(info.error.largest) +
                    " of the finished table: must be at most the tolerance " + shortest(request.tolerance) +
                    "; give a slightly smaller --tolerance"};
    }
    return table_bytes(info, numbers);
}

Table build_table(const SpectralBrdf& exact, const TableSource& source, const TableRequest& request,
                  const TableProgress& progress) {
    const TablePlan plan = plan_table(exact, request, progress);
    std::vector<std::vector<double>> slices(plan.slices());
#pragma omp parallel for schedule(dynamic)
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(slices.size()); ++i) {
        slices[static_cast<std::size_t>(i)] = table_slice(exact, plan, static_cast<std::size_t>(i));
    }
    return Table::from_bytes(finished_table(exact, source, plan, std::move(slices)), source.name);
}

}  // namespace hts::tables
