#include <algorithm>
#include <array>
#include <cmath>

#include "spectral/output/script.hpp"
#include "validation/scattering/exact_scattering.hpp"

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
    std::size_t i = 0;
    while (distance > classes[i].most) ++i;
    return classes[i];
}

std::size_t place_of(const std::vector<double>& values, double value) {
    return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
}

struct ModelRow {
    const char* column;
    const char* title;
};
constexpr std::array model_rows{
    ModelRow{"he_torrance_db", "This model: σ and S of He et al."},
    ModelRow{"kirchhoff_db", "Kirchhoff without shadowing: σ₀, S = 1"},
    ModelRow{"smith_db", "Smith's shadowing, heights correlated: σ₀, 1/(1 + Λ + Λ)"}};

/// Columns of the curves, the exact ones first.
std::vector<const char*> lobe_columns(bool polarised) {
    if (polarised) return {"exact_te", "exact_tm", "he_torrance_te", "he_torrance_tm"};
    return {"exact_te", "exact_tm", "kirchhoff", "he_torrance", "smith"};
}

/// A surface and an angle whose lobe is drawn.
struct LobePanel {
    double roughness, length, theta;
};

std::vector<LobePanel> panels_of(const LobePanels& wanted, const FigureTable& lobes) {
    std::vector<LobePanel> panels;
    for (const RoughnessStatistics& surface : wanted.surfaces) {
        for (const double theta : wanted.theta_i_deg)
            panels.push_back({surface.rms_roughness, surface.correlation_length, theta});
    }
    std::erase_if(panels, [&](const LobePanel& panel) {
        return std::none_of(lobes.rows.begin(), lobes.rows.end(), [&](const auto& row) {
            return row[0] == panel.roughness && row[1] == panel.length && row[2] == panel.theta;
        });
    });
    return panels;
}

output::Rows lobe_rows(const FigureTable& lobes, const LobePanel& panel, bool polarised) {
    output::Rows rows;
    for (const auto& row : lobes.rows) {
        if (row[0] != panel.roughness || row[1] != panel.length || row[2] != panel.theta) continue;
        rows.push_back({row[3]});
        for (const char* column : lobe_columns(polarised))
            rows.back().push_back(10 * std::log10(std::max(row[column_of(lobes, column)], 1e-9)));
    }
    return rows;
}

/// The end of a panel's axis [dB]: some 5 dB above the exact curve.
double top_of(const output::Rows& lobe) {
    double brightest = -90;
    for (const auto& row : lobe) brightest = std::max(brightest, row[1]);
    return 5 * std::ceil(brightest / 5) + 5;
}

}  // namespace

Figure moment_map_figure(const FigureTable& map) {
    const auto roughnesses = different(map, 0), lengths = different(map, 1), angles = different(map, 2);
    std::vector<std::string> models, names, colours, cell_colours, numbers, inks;
    std::vector<std::size_t> panels, x, y;
    for (const DistanceClass& each : classes) {
        names.emplace_back(each.name);
        colours.emplace_back(each.colour);
    }
    for (const ModelRow& model : model_rows) {
        const std::size_t column = column_of(map, model.column);
        for (const auto& row : map.rows) {
            const double distance = row[column];
            panels.push_back(models.size() * angles.size() + place_of(angles, row[2]));
            x.push_back(place_of(lengths, row[1]));
            y.push_back(place_of(roughnesses, row[0]));
            cell_colours.emplace_back(class_of(distance).colour);
            inks.emplace_back(class_of(distance).text);
            numbers.push_back(rounded(distance, distance < 0.095 ? 2 : 1));
        }
        models.emplace_back(model.title);
    }
    output::Script script;
    script.set("model", models).set("theta_i", angles).set("roughness", roughnesses).set("length", lengths);
    script.set("class_name", names).set("class_colour", colours);
    script.set("panel", panels).set("x", x).set("y", y);
    script.set("colour", cell_colours).set("number", numbers).set("ink", inks);
    return {"moment-method-map",
            {},
            script.with("moment-map"),
            "Distance of this model and of two others from the exact solution (method of moments), in dB."};
}

Figure moment_lobe_figure(const FigureTable& lobes, const LobePanels& wanted) {
    std::vector<double> roughnesses, lengths, angles, tops;
    std::vector<output::Rows> curves;
    for (const LobePanel& panel : panels_of(wanted, lobes)) {
        roughnesses.push_back(panel.roughness);
        lengths.push_back(panel.length);
        angles.push_back(panel.theta);
        curves.push_back(lobe_rows(lobes, panel, wanted.polarised));
        tops.push_back(top_of(curves.back()));
    }
    output::Script script;
    script.set("title", "Light scattered by random profiles, " + wanted.what + ": exact and closed forms");
    script.set("roughness", roughnesses).set("length", lengths).set("theta_i", angles).set("top", tops);
    script.set("polarised", static_cast<int>(wanted.polarised)).data("lobes", curves);
    return {lobes.stem,
            {},
            script.with("moment-lobes"),
            "Exact bistatic scattering (dots), averaged over realisations, and closed forms."};
}

}  // namespace hts::validation
