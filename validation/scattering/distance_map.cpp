#include "validation/scattering/distance_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectral/output/script.hpp"
#include "validation/scattering/ground_truth.hpp"

namespace hts::validation {
namespace {

/// Distances up to a bound, in one colour.
struct DistanceClass {
    double most;
    const char* colour;
    const char* text;  ///< colour of the number in the cell
    const char* name;
};
constexpr std::array classes{DistanceClass{0.3, "#d6e6f4", "#222222", "to 0.3 dB"},
                             DistanceClass{0.6, "#92bfdd", "#222222", "0.3 – 0.6"},
                             DistanceClass{1, "#fee6ce", "#222222", "0.6 – 1"},
                             DistanceClass{2, "#fdae6b", "#222222", "1 – 2"},
                             DistanceClass{4, "#e6550d", "#ffffff", "2 – 4"},
                             DistanceClass{HUGE_VAL, "#7f2704", "#ffffff", "above 4 dB"}};

const DistanceClass& class_of(double distance) {
    return *std::ranges::find_if(classes, [distance](const DistanceClass& c) { return distance <= c.most; });
}

}  // namespace

std::string DistanceMap::script() const {
    std::vector<std::string> names, colours, cell_colours, numbers, inks;
    std::vector<std::size_t> panels, across, up;
    for (const DistanceClass& each : classes) {
        names.emplace_back(each.name);
        colours.emplace_back(each.colour);
    }
    for (const Cell& cell : cells) {
        panels.push_back(cell.row * columns.size() + cell.column);
        across.push_back(cell.x);
        up.push_back(cell.y);
        cell_colours.emplace_back(class_of(cell.decibels).colour);
        inks.emplace_back(class_of(cell.decibels).text);
        numbers.push_back(rounded(cell.decibels, cell.decibels < 0.095 ? 2 : 1));
    }
    output::Script script;
    script.set("title", title).set("subtitle", subtitle).set("x_label", x_label).set("y_label", y_label);
    script.set("row", rows).set("column", columns).set("y_name", y).set("x_name", x);
    script.set("class_name", names).set("class_colour", colours);
    script.set("panel", panels).set("x", across).set("y", up);
    script.set("colour", cell_colours).set("number", numbers).set("ink", inks);
    return script.with("distance-map");
}

}  // namespace hts::validation
