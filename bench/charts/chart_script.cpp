#include "bench/charts/chart_script.hpp"

#include <algorithm>
#include <cmath>

namespace hts::bench {

output::Script begun(const ChartData& data, const std::string& title, const std::string& subtitle) {
    output::Script script;
    script.set("title", title).set("subtitle", subtitle);
    script.set("machine", data.machine.text() + ", seed " + std::to_string(data.settings.seed));
    return script;
}

double marker_size(const ChartMethod& method) {
    return 0.8 * std::sqrt(1 + static_cast<double>(method.bytes) / 200e3);
}

std::vector<std::string> families() {
    std::vector<std::string> result;
    for (const ChartMethod& method : chart_methods()) {
        if (std::find(result.begin(), result.end(), method.style.family) == result.end()) {
            result.push_back(method.style.family);
        }
    }
    return result;
}

LegendPlace Legend::add(const std::string& family, LegendPlace at, double line) {
    const auto add = [&](const std::string& text, double indent, const std::string& colour, int marker,
                         double size) {
        texts_.push_back(text);
        x_.push_back(at.x + indent);
        y_.push_back(at.y);
        colours_.push_back(colour);
        markers_.push_back(marker);
        sizes_.push_back(size);
    };
    add(family, 0, "", 0, 0);
    for (const ChartMethod& method : chart_methods()) {
        if (method.style.family != family) continue;
        at.y -= line;
        add(method.style.label, 0.018, method.style.colour, method.style.marker, marker_size(method));
    }
    return {at.x, at.y - 1.5 * line};
}

void Legend::set(output::Script& script) const {
    script.set("legend", texts_).set("legend_x", x_).set("legend_y", y_);
    script.set("legend_marker", markers_).set("legend_size", sizes_).set("legend_colour", colours_);
}

}  // namespace hts::bench
