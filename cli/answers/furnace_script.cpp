#include "cli/answers/furnace_script.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "spectral/output/map_cells.hpp"

namespace hts::cli {
namespace {

/// Totals up to a bound, in one colour: blue where light is lost, orange where it is gained.
struct TotalClass {
    double most;
    const char* colour;
    const char* name;
};

constexpr std::array classes{
    TotalClass{0.5, "#08306b", "below 0.5"},    TotalClass{0.7, "#08519c", "0.5 – 0.7"},
    TotalClass{0.9, "#3182bd", "0.7 – 0.9"},    TotalClass{0.97, "#6baed6", "0.9 – 0.97"},
    TotalClass{0.99, "#bdd7e7", "0.97 – 0.99"}, TotalClass{0.999, "#deebf7", "0.99 – 0.999"},
    TotalClass{1.001, "#f4f4f4", "1 ± 0.001"},  TotalClass{1.01, "#fdd0a2", "to 1.01"},
    TotalClass{1.02, "#fd8d3c", "to 1.02"},     TotalClass{HUGE_VAL, "#a63603", "above 1.02"}};

const TotalClass& class_of(double total) {
    std::size_t i = 0;
    while (total >= classes[i].most) ++i;
    return classes[i];
}

/// The name of the class of all totals, "" if they are of several.
const char* only_class(std::span<const double> totals) {
    const TotalClass& first = class_of(totals.front());
    const auto is_first = [&](double total) { return &class_of(total) == &first; };
    return std::ranges::all_of(totals, is_first) ? first.name : "";
}

std::vector<double> edges(const std::vector<double>& middles) {
    const double half = (middles[1] - middles[0]) / 2;
    std::vector<double> result;
    result.reserve(middles.size() + 1);
    for (const double middle : middles) result.push_back(middle - half);
    result.push_back(middles.back() + half);
    return result;
}

}  // namespace

std::string furnace_script(const FurnaceGrid& grid, const std::vector<double>& totals,
                           const std::string& title, const std::string& subtitle) {
    std::vector<std::string> names, colours;
    for (const TotalClass& each : classes) {
        names.emplace_back(each.name);
        colours.emplace_back(each.colour);
    }
    std::vector<double> powers;
    for (const double roughness : grid.roughnesses) powers.push_back(std::log10(roughness));
    const auto across = edges(grid.degrees), upwards = edges(powers);
    std::vector<output::Rows> panels;
    std::vector<std::string> everywhere;
    const std::size_t size = grid.roughnesses.size() * grid.degrees.size();
    for (std::size_t i = 0; i < grid.slopes.size(); ++i) {
        everywhere.emplace_back(only_class(std::span{totals}.subspan(i * size, size)));
        panels.push_back(output::map_cells(across, upwards, [&](std::size_t row, std::size_t column) {
            const std::size_t curve = i * grid.roughnesses.size() + row;
            return class_of(totals[curve * grid.degrees.size() + column]).colour;
        }));
    }
    output::Script script;
    script.set("title", title).set("subtitle", subtitle).set("slope", grid.slopes);
    script.set("degrees_from", across.front()).set("degrees_to", across.back());
    script.set("powers_from", upwards.front()).set("powers_to", upwards.back());
    script.set("class_name", names)
        .set("class_colour", colours)
        .set("everywhere", everywhere)
        .data("cells", panels);
    return script.with("furnace");
}

}  // namespace hts::cli
