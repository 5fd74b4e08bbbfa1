// Chart (b): maps of the error over the (g, t/g) plane.

#include <array>
#include <cmath>

#include "bench/charts/chart_script.hpp"
#include "spectral/output/map_cells.hpp"

namespace hts::bench {
namespace {

/// Errors up to a bound, in one colour of viridis.
struct ErrorClass {
    double most;
    const char* colour;
    const char* name;
};

constexpr std::array classes{ErrorClass{1e-14, "#440154", "≤ 1e-14"}, ErrorClass{1e-12, "#46327e", "1e-12"},
                             ErrorClass{1e-9, "#365c8d", "1e-9"},     ErrorClass{1e-6, "#277f8e", "1e-6"},
                             ErrorClass{1e-4, "#1fa187", "1e-4"},     ErrorClass{1e-3, "#4ac16d", "1e-3"},
                             ErrorClass{1e-2, "#a0da39", "1e-2"},     ErrorClass{1, "#fde725", "< 1"}};
constexpr ErrorClass failure{HUGE_VAL, "#d55e00", "no digit, 0, inf, NaN"};
constexpr ErrorClass nothing{HUGE_VAL, "#dddddd", "Φ < 1e-300"};

const ErrorClass& class_of(double error) {
    if (std::isnan(error)) return nothing;
    for (const ErrorClass& each : classes) {
        if (error < each.most || (each.most < 1 && error == each.most)) return each;
    }
    return failure;
}

/// Edges of equal cells along a logarithmic axis, as powers of ten.
std::vector<double> edges(double low, double high, std::size_t count) {
    std::vector<double> result;
    for (std::size_t i = 0; i <= count; ++i) {
        result.push_back(std::log10(low) +
                         std::log10(high / low) * static_cast<double>(i) / static_cast<double>(count));
    }
    return result;
}

output::Rows cells(const ErrorMap& map, const PlaneGrid& grid) {
    return output::map_cells(edges(PlaneGrid::least_g, PlaneGrid::most_g, grid.columns),
                             edges(PlaneGrid::least_ratio, PlaneGrid::greatest_ratio, grid.rows),
                             [&](std::size_t row, std::size_t column) {
                                 return class_of(map.errors[row * grid.columns + column]).colour;
                             });
}

}  // namespace

std::string error_map_script(const ChartData& data) {
    std::vector<std::string> methods, names, colours;
    std::vector<output::Rows> maps;
    for (const ErrorMap& map : data.maps) {
        methods.push_back(map.method->title());
        maps.push_back(cells(map, data.settings.grid));
    }
    const auto add = [&](const ErrorClass& each) {
        names.emplace_back(each.name);
        colours.emplace_back(each.colour);
    };
    for (const ErrorClass& each : classes) add(each);
    add(failure);
    add(nothing);
    auto script = begun(data, "Where each way to compute Φ(g, t) breaks",
                        "Relative error against 50 digits over phase variance g and lobe argument t/g, "
                        "the squared slope of the facet seen, in units of the surface's.");
    script.set("method", methods).set("powers_to", std::log10(PlaneGrid::greatest_ratio));
    script.set("class_name", names).set("class_colour", colours).data("cells", maps);
    return script.with("error-maps");
}

}  // namespace hts::bench
