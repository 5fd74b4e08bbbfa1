#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "hts/error.hpp"
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

std::size_t class_of(double distance) {
    std::size_t i = 0;
    while (distance > classes[i].most) ++i;
    return i;
}

std::size_t place_of(const std::vector<double>& values, double value) {
    return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
}

/// Labelled tics at 0, 1, 2 …
std::string tics(const std::vector<double>& values) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i) {
        text.append(i == 0 ? "('" : ", '").append(shortest(values[i])).append("' ");
        text.append(std::to_string(i));
    }
    return text.append(")");
}

struct ModelRow {
    const char* column;
    const char* title;
};
constexpr std::array model_rows{
    ModelRow{"he_torrance_db", "This model: σ and S of He et al."},
    ModelRow{"kirchhoff_db", "Kirchhoff without shadowing: σ₀, S = 1"},
    ModelRow{"smith_db", "Smith's shadowing, heights correlated: σ₀, 1/(1 + Λ + Λ)"}};

/// Cells and numbers of one model at one angle.
void write_panel(std::ostream& out, const FigureTable& map, const ModelRow& model, double theta) {
    const auto roughnesses = different(map, 0), lengths = different(map, 1);
    const std::size_t column = column_of(map, model.column);
    for (const auto& row : map.rows) {
        if (row[2] != theta) continue;
        const auto x = static_cast<double>(place_of(lengths, row[1]));
        const auto y = static_cast<double>(place_of(roughnesses, row[0]));
        const DistanceClass& each = classes[class_of(row[column])];
        out << "set object rect from " << x - 0.5 << ',' << y - 0.5 << " to " << x + 0.5 << ',' << y + 0.5
            << " fc rgb '" << each.colour << "' fs solid 1 border lc rgb '#ffffff'\nset label '"
            << rounded(row[column], row[column] < 0.095 ? 2 : 1) << "' at " << x << ',' << y
            << " center font ',12' tc rgb '" << each.text << "' front\n";
    }
}

std::string legend() {
    std::string text;
    double x = 0.075;
    for (const DistanceClass& each : classes) {
        text += "set object rect from screen " + shortest(x) + ",0.028 to screen " + shortest(x + 0.022) +
                ",0.05 fc rgb '" + each.colour + "' fs solid border lc rgb '#999999'\n" +
                page_label(each.name, x + 0.028, 0.039, 12);
        x += 0.13;
    }
    return text;
}

struct LobeCurve {
    const char* column;
    const char* style;
};
std::vector<LobeCurve> lobe_curves(bool polarised) {
    std::vector<LobeCurve> curves{{"exact_te", "with points pt 7 ps 0.45 lc rgb '#000000' title 'exact, TE'"},
                                  {"exact_tm", "with points pt 6 ps 0.5 lc rgb '#000000' title 'exact, TM'"}};
    const std::vector<LobeCurve> own{
        {"he_torrance_te", "with lines lw 2.4 lc rgb '#0072b2' title 'this model, TE'"},
        {"he_torrance_tm", "with lines lw 2.4 dt 2 lc rgb '#0072b2' title 'this model, TM'"}};
    const std::vector<LobeCurve> models{
        {"kirchhoff", "with lines lw 2 dt 2 lc rgb '#009e73' title 'Kirchhoff'"},
        {"he_torrance", "with lines lw 2.6 lc rgb '#0072b2' title 'this model'"},
        {"smith", "with lines lw 2 lc rgb '#d55e00' title 'Smith, correlated'"}};
    const auto& lines = polarised ? own : models;
    curves.insert(curves.end(), lines.begin(), lines.end());
    return curves;
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

std::vector<std::vector<double>> lobe_rows(const FigureTable& lobes, const LobePanel& panel,
                                           const std::vector<LobeCurve>& curves) {
    std::vector<std::vector<double>> rows;
    for (const auto& row : lobes.rows) {
        if (row[0] != panel.roughness || row[1] != panel.length || row[2] != panel.theta) continue;
        rows.push_back({row[3]});
        for (const LobeCurve& curve : curves)
            rows.back().push_back(10 * std::log10(std::max(row[column_of(lobes, curve.column)], 1e-9)));
    }
    return rows;
}

std::string page(int width, int height) {
    return "set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
           " font 'Helvetica,14' background '#ffffff'\nset output picture\n" + figure_style;
}

}  // namespace

Figure moment_map_figure(const FigureTable& map) {
    const auto roughnesses = different(map, 0), lengths = different(map, 1), angles = different(map, 2);
    std::ostringstream out;
    out << page(1150, 900) << page_label("Distance of models from exact scattering, dB", 0.015, 0.972, 19)
        << page_label(
               "Random profiles, perfectly conducting, unpolarised light; rms over the scattering angles, "
               "weighted with the exact energy. Blank: σ₀/τ above 1/2.",
               0.015, 0.942, 13)
        << legend()
        << "set multiplot\nunset key\nunset grid\nset border 15 lc rgb '#999999'\nset tics scale 0\n"
        << "set xrange [-0.5:" << static_cast<double>(lengths.size()) - 0.5
        << "]\nset yrange [-0.5:" << static_cast<double>(roughnesses.size()) - 0.5 << "]\n";
    for (std::size_t m = 0; m < model_rows.size(); ++m) {
        const double top = 0.915 - 0.283 * static_cast<double>(m);
        out << page_label(model_rows[m].title, 0.075, top, 14) << "set xlabel '"
            << (m + 1 == model_rows.size() ? "τ/λ" : "") << "' offset 0,0.9\n";
        for (std::size_t a = 0; a < angles.size(); ++a) {
            const double left = 0.075 + 0.23 * static_cast<double>(a);
            out << "set lmargin at screen " << left << "\nset rmargin at screen " << left + 0.205
                << "\nset tmargin at screen " << top - 0.04 << "\nset bmargin at screen " << top - 0.225
                << '\n'
                << "set ytics " << (a == 0 ? tics(roughnesses) : "('' 0)") << "\nset ylabel '"
                << (a == 0 ? "σ_0/λ" : "") << "' offset 1,0\nset xtics " << tics(lengths) << " offset 0,0.4\n"
                << "set title 'θ_i = " << angles[a] << "°' font ',13' offset 0,-0.8\n";
            write_panel(out, map, model_rows[m], angles[a]);
            out << "plot NaN\nunset object\nunset label\n";
        }
    }
    out << "unset multiplot\n";
    return {"moment-method-map",
            {},
            out.str(),
            "Distance of this model and of two others from the exact solution (method of moments), in dB."};
}

Figure moment_lobe_figure(const FigureTable& lobes, const LobePanels& wanted) {
    const auto panels = panels_of(wanted, lobes);
    const auto curves = lobe_curves(wanted.polarised);
    const std::size_t columns = 2, rows = (panels.size() + 1) / columns;
    const int height = 220 + 218 * static_cast<int>(rows);
    const auto down = [height](int pixels) { return 1 - pixels / static_cast<double>(height); };
    const std::string key =
        "set key at screen 0.97," + shortest(down(90)) + " right bottom horizontal samplen 1.6 font ',12'\n";
    std::ostringstream out;
    out << page(1000, height)
        << page_label("Light scattered by random profiles, " + wanted.what + ": exact and closed forms",
                      0.015, down(27), 19)
        << page_label(
               "Incoherent power per angle [dB re 1/rad], averages over 5°; negative angles: the side of the "
               "source.",
               0.015, down(54), 13)
        << "set multiplot layout " << rows << ',' << columns << " margins 0.07,0.97," << 1 - down(82) << ','
        << down(136) << " spacing 0.07," << 60.0 / height
        << "\nset xrange [-90:90]\nset xtics 30\nset key off\n";
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const auto numbers = lobe_rows(lobes, panels[i], curves);
        double brightest = -90;
        for (const auto& row : numbers) brightest = std::max(brightest, row[1]);
        const double top = 5 * std::ceil(brightest / 5) + 5;
        out << data_block("lobe" + std::to_string(i), numbers) << "set yrange [" << top - 40 << ':' << top
            << "]\nset ytics 10\nset title 'σ_0 = " << panels[i].roughness << " λ, τ = " << panels[i].length
            << " λ, θ_i = " << panels[i].theta << "°' font ',13' offset 0,-0.8\n"
            << (i + columns >= panels.size() ? "set xlabel 'angle of scattering [°]' offset 0,0.5\n" : "")
            << (i == 0 ? key : "set key off\n") << "plot ";
        for (std::size_t c = 0; c < curves.size(); ++c)
            out << (c == 0 ? "" : ", ") << "$lobe" << i << " using 1:" << c + 2 << ' ' << curves[c].style;
        out << '\n' << (i == 0 ? "unset label\n" : "");
    }
    out << "unset multiplot\n";
    return {lobes.stem,
            {},
            out.str(),
            "Exact bistatic scattering (dots), averaged over realisations, and closed forms."};
}

}  // namespace hts::validation
