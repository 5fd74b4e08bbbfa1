#include "validation/scattering/vector/vector_distances.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hts/error.hpp"
#include "spectral/output/script.hpp"
#include "spectral/statistics.hpp"
#include "validation/scattering/distance_map.hpp"

namespace hts::validation {
namespace {

VectorModel other(std::size_t index) {
    return vector_models[index];
}

std::string tau_text(const VectorSurface& surface) {
    if (surface.isotropic()) return shortest(surface.lengths.along);
    return shortest(surface.lengths.along) + " x " + shortest(surface.lengths.across);
}

/// A column of the picture of lobes.
struct LobeColumn {
    const char* title;
    VectorLight light;
    bool out_of_plane;
};
constexpr std::array lobe_columns{LobeColumn{"s into s, in plane", VectorLight::ss, false},
                                  LobeColumn{"p into p, in plane", VectorLight::pp, false},
                                  LobeColumn{"cross, in plane", VectorLight::cross, false},
                                  LobeColumn{"cross, out of plane", VectorLight::cross, true}};

double decibels(double value) {
    return 10 * std::log10(std::max(value, 1e-12));
}

/// Bins of the column in the order of the signed angle: within 21 degrees of the plane of incidence, or
/// about at right angles to it.
output::Rows lobe_rows(const ComparedLobe& lobe, const LobeColumn& column) {
    output::Rows rows;
    for (std::size_t i = 0; i < lobe.exact.size(); ++i) {
        const VectorBin& bin = lobe.exact[i];
        const bool forward = bin.phi_deg == 0, backward = bin.most_phi_deg == 180;
        const bool across = bin.phi_deg < 90 && bin.most_phi_deg > 90;
        if (bin.most_theta_deg > most_compared_theta_deg ||
            (column.out_of_plane ? !across : !forward && !backward))
            continue;
        const double exact = of(bin.exact, column.light), error = error_of(bin, column.light);
        rows.push_back({(backward ? -1 : 1) * (bin.theta_deg + bin.most_theta_deg) / 2, decibels(exact),
                        decibels(exact - error), decibels(exact + error)});
        for (const auto& model : lobe.model) rows.back().push_back(decibels(of(model[i], column.light)));
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

}  // namespace

std::vector<std::string> case_columns() {
    return {"sigma0_over_lambda", "tau_x_over_lambda", "tau_y_over_lambda",
            "azimuth_deg",        "theta_i_deg",       "length_over_lambda"};
}

std::vector<double> case_row(const VectorCase& of, const VectorSettings& settings) {
    const VectorSurface& surface = of.surface;
    return {surface.rms_roughness, surface.lengths.along, surface.lengths.across,
            of.azimuth_deg,        of.theta_i_deg,        settings.length};
}

FigureTable vector_lobe_table(const std::vector<VectorResult>& results, const VectorSettings& settings) {
    FigureTable table{"vector-lobes", case_columns(), {}};
    table.columns.insert(table.columns.end(), {"theta_r_deg", "phi_deg"});
    for (const char* what : {"", "_error"}) {
        for (const Channel c : channels) table.columns.push_back(std::string{name(c)} + what);
    }
    for (const VectorResult& result : results) {
        for (const VectorBin& bin : result.bins) {
            std::vector<double> row = case_row(result.of, settings);
            row.push_back((bin.theta_deg + bin.most_theta_deg) / 2);
            row.push_back((bin.phi_deg + bin.most_phi_deg) / 2);
            row.insert(row.end(), bin.exact.values.begin(), bin.exact.values.end());
            row.insert(row.end(), bin.error.values.begin(), bin.error.values.end());
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

FigureTable vector_distance_table(const std::vector<ComparedLobe>& lobes) {
    FigureTable table{"vector-distances", case_columns(), {}};
    table.columns.pop_back();
    for (const std::string model : {"he", "he_unified"})
        table.columns.insert(table.columns.end(),
                             {model + "_ss_db", model + "_pp_db", model + "_cross_db", model + "_db"});
    for (const ComparedLobe& lobe : lobes) {
        std::vector<double> row = case_row(lobe.of, {});
        row.pop_back();
        for (const VectorModel model : {VectorModel::he, VectorModel::he_unified}) {
            for (const VectorLight light : vector_lights)
                row.push_back(lobe.distance_of(model, light, VectorRegion::all).rms);
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::vector<ComparedLobe> compared(const FigureTable& lobes) {
    const auto bins = vector_bins();
    const std::size_t exact = column_of(lobes, "ss"), error = column_of(lobes, "ss_error");
    std::vector<ComparedLobe> all;
    for (std::size_t first = 0; first + bins.size() <= lobes.rows.size(); first += bins.size()) {
        const auto& head = lobes.rows[first];
        ComparedLobe lobe{{{head[0], {head[1], head[2]}}, head[3], head[4]}, bins, {}};
        VectorSettings settings;
        settings.length = head[case_columns().size() - 1];
        for (std::size_t bin = 0; bin < bins.size(); ++bin) {
            const auto& row = lobes.rows[first + bin];
            for (std::size_t c = 0; c < channels.size(); ++c) {
                lobe.exact[bin].exact.values[c] = row[exact + c];
                lobe.exact[bin].error.values[c] = row[error + c];
            }
        }
        const auto models = binned(ClosedForms{lobe.of.surface.surface()}, lobe.of, settings);
        for (std::size_t m = 0; m < vector_models.size(); ++m) {
            for (const auto& bin : models) lobe.model[m].push_back(bin[m]);
        }
        all.push_back(std::move(lobe));
    }
    return all;
}

ReportTable vector_summary_table(const std::vector<ComparedLobe>& lobes) {
    ReportTable table{
        "vector-summary",
        "Distance from exact scattering by rough conducting surfaces [dB] over " +
            std::to_string(lobes.size()) +
            " cases, a surface and an angle of incidence each: median and greatest. Cross is the light whose "
            "polarisation is exchanged; in plane is within 21 degrees of the plane of incidence. Without the "
            "last 10 degrees above the horizon. Chance: the rms of the standard errors, a median.",
        {"light", "directions"},
        {}};
    for (std::size_t m = 0; m < vector_models.size(); ++m) {
        table.columns.push_back(std::string{name(other(m))} + " median");
        table.columns.emplace_back("max");
    }
    table.columns.emplace_back("chance");
    for (const VectorLight light : vector_lights) {
        for (const VectorRegion region : vector_regions) {
            std::string where = name(region);
            std::replace(where.begin(), where.end(), '_', ' ');
            std::vector<std::string> row{name(light), where};
            std::vector<double> chance;
            for (const VectorModel model : vector_models) {
                std::vector<double> distances;
                for (const ComparedLobe& lobe : lobes) {
                    const VectorDistance d = lobe.distance_of(model, light, region);
                    distances.push_back(d.rms);
                    chance.push_back(d.chance);
                }
                row.push_back(rounded(spectral::median(distances), 2));
                row.push_back(rounded(*std::max_element(distances.begin(), distances.end()), 2));
            }
            row.push_back(rounded(spectral::median(chance), 2));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

ReportTable vector_case_table(const std::vector<ComparedLobe>& lobes) {
    ReportTable table{
        "vector-cases",
        "The same by case, in all directions: rms distance [dB] in s, p, cross-polarised and unpolarised "
        "light. Lengths are in wavelengths; an azimuth of 0 is a plane of incidence along the first "
        "correlation length.",
        {"sigma0", "tau", "azimuth", "theta_i"},
        {}};
    for (const VectorModel model :
         {VectorModel::kirchhoff, VectorModel::smith, VectorModel::he, VectorModel::he_unified}) {
        table.columns.push_back(std::string{name(model)} + " s");
        table.columns.insert(table.columns.end(), {"p", "cross", "unpol"});
    }
    table.columns.emplace_back("chance cross");
    for (const ComparedLobe& lobe : lobes) {
        std::vector<std::string> row{shortest(lobe.of.surface.rms_roughness), tau_text(lobe.of.surface),
                                     shortest(lobe.of.azimuth_deg), shortest(lobe.of.theta_i_deg)};
        for (const VectorModel model : vector_models) {
            for (const VectorLight light : vector_lights)
                row.push_back(rounded(lobe.distance_of(model, light, VectorRegion::all).rms, 2));
        }
        row.push_back(
            rounded(lobe.distance_of(VectorModel::he, VectorLight::cross, VectorRegion::all).chance, 2));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Figure vector_map_figure(const std::vector<ComparedLobe>& lobes) {
    DistanceMap figure;
    figure.title = "Distance of models from exact scattering by rough surfaces, dB";
    figure.subtitle =
        "Perfect conductors, rough in both directions; rms over the hemisphere up to 80°, weighted with the "
        "exact energy. Cross: polarisation exchanged.";
    figure.x_label = "θ_i [degrees]";
    figure.y_label = "σ_0/λ, τ/λ";
    const auto place = [](std::vector<std::string>& names, const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        const auto at = static_cast<std::size_t>(found - names.begin());
        if (found == names.end()) names.push_back(name);
        return at;
    };
    for (const VectorLight light : vector_lights) figure.columns.emplace_back(name(light));
    for (const VectorModel model : vector_models) {
        for (const ComparedLobe& lobe : lobes) {
            const auto x = place(figure.x, shortest(lobe.of.theta_i_deg));
            const auto y =
                place(figure.y, shortest(lobe.of.surface.rms_roughness) + ", " + tau_text(lobe.of.surface) +
                                    (lobe.of.azimuth_deg != 0 ? " across" : ""));
            for (const VectorLight light : vector_lights)
                figure.cells.push_back({figure.rows.size(), static_cast<std::size_t>(light), x, y,
                                        lobe.distance_of(model, light, VectorRegion::all).rms});
        }
        figure.rows.emplace_back(name(model));
    }
    return {"vector-map",
            {},
            figure.script(),
            "The same distances by surface, angle of incidence and polarisation."};
}

Figure vector_lobe_figure(const std::vector<ComparedLobe>& lobes, double theta_i_deg) {
    std::vector<std::string> titles, columns;
    std::vector<double> tops;
    std::vector<int> out_of_plane;
    std::vector<output::Rows> panels;
    for (const LobeColumn& column : lobe_columns) {
        columns.emplace_back(column.title);
        out_of_plane.push_back(column.out_of_plane ? 1 : 0);
    }
    for (const ComparedLobe& lobe : lobes) {
        if (lobe.of.theta_i_deg != theta_i_deg) continue;
        titles.push_back("σ_0 = " + shortest(lobe.of.surface.rms_roughness) + " λ, τ = " +
                         tau_text(lobe.of.surface) + " λ" + (lobe.of.azimuth_deg != 0 ? " across" : ""));
        for (const LobeColumn& column : lobe_columns) {
            panels.push_back(lobe_rows(lobe, column));
            double brightest = -200;
            for (const auto& row : panels.back()) brightest = std::max(brightest, row[1]);
            tops.push_back(5 * std::ceil(brightest / 5) + 5);
        }
    }
    output::Script script;
    script.set("title", "Light scattered by rough conductors, light at " + shortest(theta_i_deg) +
                            "°: exact and closed forms");
    script.set("row_title", titles).set("column_title", columns).set("out_of_plane", out_of_plane);
    script.set("top", tops).data("lobes", panels);
    return {"vector-lobes",
            {},
            script.with("vector-lobes"),
            "Exact scattering by rough conducting surfaces (dots with standard errors), and closed forms as "
            "the beam sees them."};
}

}  // namespace hts::validation
