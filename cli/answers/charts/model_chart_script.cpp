#include <algorithm>
#include <array>

#include "cli/answers/charts/model_chart.hpp"
#include "spectral/output/script.hpp"

namespace hts::cli {
namespace {

/// How a model is drawn; those of one kind share a colour.
struct Mark {
    const char* model;
    const char* colour;
    int shape;  // gnuplot's point type
};
constexpr std::array marks{Mark{"He-Torrance, 1e-6", "#0072b2", 7},
                           Mark{"He-Torrance, 1e-3", "#0072b2", 6},
                           Mark{"first order", "#0072b2", 9},
                           Mark{"rough limit", "#0072b2", 5},
                           Mark{"table, 1e-2", "#e69f00", 12},
                           Mark{"table, 1e-4", "#e69f00", 13},
                           Mark{"Walter, Beckmann", "#d55e00", 5},
                           Mark{"Walter, GGX", "#d55e00", 7},
                           Mark{"GGX as pbrt is built", "#000000", 8},
                           Mark{"GGX of pbrt without errno", "#000000", 9},
                           Mark{"Ashikhmin, Gaussian", "#d55e00", 11},
                           Mark{"Cook-Torrance", "#d55e00", 9},
                           Mark{"Kurt", "#009e73", 7},
                           Mark{"Ward", "#009e73", 5},
                           Mark{"Ward-Duer", "#009e73", 4},
                           Mark{"Blinn-Phong", "#cc79a7", 9},
                           Mark{"Ashikhmin-Shirley", "#cc79a7", 11},
                           Mark{"Lafortune", "#cc79a7", 13},
                           Mark{"Oren-Nayar", "#666666", 5},
                           Mark{"Lambert", "#666666", 7}};

validation::FigureTable table_of(const ModelChart& chart, const std::string& surface, std::size_t number) {
    validation::FigureTable table{
        "models-" + std::to_string(number), {"mark", "nanoseconds", "median_error", "error_99", "bytes"}, {}};
    for (const ModelPoint& point : chart.points) {
        if (point.surface != surface) continue;
        const auto mark = std::find_if(marks.begin(), marks.end(),
                                       [&](const Mark& each) { return point.model == each.model; });
        table.rows.push_back({static_cast<double>(mark - marks.begin()), point.nanoseconds, point.median,
                              point.high, static_cast<double>(point.bytes)});
    }
    return table;
}

}  // namespace

validation::Figure model_figure(const ModelChart& chart) {
    std::vector<std::string> surfaces, models, colours;
    for (const ModelPoint& point : chart.points) {
        if (surfaces.empty() || surfaces.back() != point.surface) surfaces.push_back(point.surface);
    }
    std::vector<int> shapes;
    for (const Mark& mark : marks) {
        models.emplace_back(mark.model);
        colours.emplace_back(mark.colour);
        shapes.push_back(mark.shape);
    }
    validation::Figure figure{"models", {}, {}, "Every model, fitted to He-Torrance"};
    std::vector<std::size_t> counts;
    std::vector<double> of_rows;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        figure.tables.push_back(table_of(chart, surfaces[i], i + 1));
        counts.push_back(figure.tables.back().rows.size());
        for (const auto& row : figure.tables.back().rows) of_rows.push_back(row[0] + 1);
    }
    output::Script script;
    script.set("machine", chart.machine + ", seed " + std::to_string(chart.seed));
    script.set("surface", surfaces).set("count", counts).set("mark", of_rows);
    script.set("model", models).set("colour", colours).set("shape", shapes);
    figure.script = script.with("models");
    return figure;
}

}  // namespace hts::cli
