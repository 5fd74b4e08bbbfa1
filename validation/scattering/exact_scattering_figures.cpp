#include <algorithm>
#include <array>
#include <cmath>

#include "spectral/output/script.hpp"
#include "validation/scattering/distance_map.hpp"
#include "validation/scattering/exact_scattering.hpp"

namespace hts::validation {
namespace {

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
    DistanceMap figure;
    figure.title = "Distance of models from exact scattering, dB";
    figure.subtitle =
        "Random profiles, perfectly conducting, unpolarised light; rms over the scattering angles, weighted "
        "with the exact energy. Blank: σ₀/τ above 1/2.";
    figure.x_label = "τ/λ";
    figure.y_label = "σ_0/λ";
    for (const double angle : angles) figure.columns.push_back("θ_i = " + shortest(angle) + "°");
    for (const double length : lengths) figure.x.push_back(shortest(length));
    for (const double roughness : roughnesses) figure.y.push_back(shortest(roughness));
    for (const ModelRow& model : model_rows) {
        const std::size_t column = column_of(map, model.column);
        for (const auto& row : map.rows)
            figure.cells.push_back({figure.rows.size(), place_of(angles, row[2]), place_of(lengths, row[1]),
                                    place_of(roughnesses, row[0]), row[column]});
        figure.rows.emplace_back(model.title);
    }
    return {"moment-method-map",
            {},
            figure.script(),
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
