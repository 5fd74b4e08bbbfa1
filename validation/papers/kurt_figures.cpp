#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "hts/error.hpp"
#include "hts/microfacet/albedo.hpp"
#include "hts/microfacet/kurt.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"
#include "validation/papers/microfacet_figures.hpp"

namespace hts::validation {
namespace {

/// Okabe and Ito's colours, for all kinds of colour vision.
constexpr std::array colours{"#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#aa4499"};

constexpr auto albedo_axes = R"(set xlabel 'angle of incidence [°]'
set xrange [0:90]
set xtics 15
set yrange [0:1.5]
set ytics 0.25
)";

double albedo(const KurtLobe& lobe, double degrees) {
    return directional_albedo(Kurt{0, {{1, lobe}}}, Direction::from_degrees(degrees, 0));
}

/// Of (9), a BRDF of its own.
double symmetric_albedo(double m, double degrees) {
    const GaussianSlopes slopes{m, m};
    const Direction in = Direction::from_degrees(degrees, 0);
    return directional_albedo(
        [&](const Direction& out) {
            const HalfDirection half = half_direction(in, out);
            return slopes.density(half) / (4 * half.cos_theta_d * std::max(in.cos_theta(), out.cos_theta()));
        },
        in);
}

/// A column of angles, 0 ... 89 deg, and one per curve.
FigureTable albedo_table(const std::string& stem, const std::vector<std::string>& curves,
                         const std::function<double(std::size_t curve, double degrees)>& value) {
    FigureTable table{stem, {"theta_i_deg"}, {}};
    table.columns.insert(table.columns.end(), curves.begin(), curves.end());
    for (double degrees = 0; degrees < 90; degrees += degrees < 87 ? 3 : 1) {
        table.rows.emplace_back(1, degrees);
        table.rows.back().resize(curves.size() + 1);
    }
    spectral::parallel_for(
        table.rows.size() * curves.size(),
        [&](std::size_t i) {
            auto& row = table.rows[i / curves.size()];
            row[i % curves.size() + 1] = value(i % curves.size(), row.front());
        },
        1);
    return table;
}

/// Title and caption above the picture.
std::string heading(const std::string& title, const std::string& caption) {
    return page_label(title, 0.02, 0.955, 18) + page_label(caption, 0.02, 0.905, 13);
}

/// A line for the reflectance that no passive surface exceeds.
constexpr auto unit_line =
    "set arrow from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb '#888888'\n";

/// One curve per column after the first, titled.
std::string plot(const FigureTable& table, const std::vector<std::string>& titles) {
    std::string script = "plot ";
    for (std::size_t i = 0; i < titles.size(); ++i) {
        script += spectral::gnuplot_string(table.stem + ".csv") + " using 1:" + std::to_string(i + 2) +
                  " every ::1 with lines lw 2.4 lc rgb '" + colours[i] + "' title " +
                  spectral::gnuplot_string(titles[i]) + (i + 1 < titles.size() ? ", \\\n     " : "\n");
    }
    return script;
}

std::vector<std::string> texts(const std::string& before, const std::vector<double>& values,
                               const std::string& after = {}) {
    std::vector<std::string> result;
    for (const double value : values) result.push_back(before + shortest(value) + after);
    return result;
}

Figure figure_2() {
    const std::vector<double> widths{0.05, 0.1, 0.2, 0.3, 0.5, 1};
    Figure figure{
        "figure-2",
        {albedo_table("figure-2", texts("m_", widths),
                      [&](std::size_t i, double degrees) { return symmetric_albedo(widths[i], degrees); })},
        {}};
    figure.script =
        std::string{figure_style} + "set margins 9,17,4,5\n" +
        heading("Albedo of the symmetric form (9), after Fig. 2 of Kurt et al. 2010",
                "F = 1. A curve per width m of the slopes.") +
        albedo_axes +
        "set yrange [0:1.1]\nset ylabel 'albedo'\nset key at graph 1.02,0.95 left top reverse Left\n" +
        unit_line + plot(figure.tables[0], texts("m = ", widths));
    return figure;
}

Figure figure_3() {
    const std::vector<double> widths{0.05, 0.2, 0.5}, alphas{0, 0.1, 0.25, 0.5, 0.75, 1};
    Figure figure{"figure-3", {}, {}};
    figure.script =
        std::string{figure_style} +
        "set multiplot layout 1,3 margins 0.085,0.98,0.2,0.82 spacing 0.04,0.1\n" +
        heading("Albedo of the form with the exponent α, after Fig. 3 of Kurt et al. 2010",
                "F = 1. Every curve with α > 0 grows without bound at last, like (cos θ)^-α.") +
        albedo_axes +
        "set key at graph 0.04,0.46 left top reverse Left samplen 1.5\nset ylabel 'albedo' offset 2,0\n" +
        unit_line;
    for (std::size_t k = 0; k < widths.size(); ++k) {
        const double m = widths[k];
        const std::string stem = "figure-3-m-" + shortest(m);
        figure.tables.push_back(
            albedo_table(stem, texts("alpha_", alphas), [&](std::size_t i, double degrees) {
                return albedo({1, m, m, alphas[i]}, degrees);
            }));
        if (k == 1) figure.script += "unset key\nunset label\nunset ylabel\nset format y ''\n";
        figure.script += "set label 9 'm = " + shortest(m) + "' at graph 0.05,0.94 font ',15'\n" +
                         plot(figure.tables.back(), texts("α = ", alphas));
    }
    figure.script += "unset multiplot\n";
    return figure;
}

constexpr std::array map_angles{0.0, 20.0, 40.0, 60.0, 67.5, 75.0, 80.0, 85.0, 87.0, 89.0};
constexpr std::array map_limits{60.0, 75.0, 85.0, 89.0};
constexpr double map_top = 1.5;

/// The exponent with which the albedo at one angle is 1, at most map_top; it grows with the exponent, its
/// logarithm nearly in proportion, so secants soon meet it.
double largest_alpha(double m, double degrees) {
    const auto excess = [&](double alpha) { return std::log(albedo({1, m, m, alpha}, degrees)); };
    double before = 0, alpha = 0.5;
    double excess_before = excess(before);
    for (int step = 0; step < 12; ++step) {
        const double now = excess(alpha);
        if (std::abs(now) < 1e-5 || now == excess_before) break;
        const double next = std::clamp(alpha - now * (alpha - before) / (now - excess_before), 0.0, map_top);
        before = alpha;
        excess_before = now;
        alpha = next;
    }
    return alpha;
}

/// m, and per limit the largest exponent with which the albedo is at most 1 at every angle up to the limit.
FigureTable plausibility_table() {
    FigureTable table{"plausible-alpha", {"m"}, {}};
    for (const double limit : map_limits) table.columns.push_back("alpha_to_" + shortest(limit) + "_deg");
    constexpr int widths = 21;
    for (int i = 0; i < widths; ++i) {
        table.rows.emplace_back(1, 0.02 * std::pow(100, i / (widths - 1.0)));
        table.rows.back().resize(map_limits.size() + 1, map_top);
    }
    spectral::parallel_for(
        table.rows.size(),
        [&](std::size_t i) {
            auto& row = table.rows[i];
            for (const double angle : map_angles) {
                const double alpha = largest_alpha(row[0], angle);
                for (std::size_t k = 0; k < map_limits.size(); ++k) {
                    if (angle <= map_limits[k]) row[k + 1] = std::min(row[k + 1], alpha);
                }
            }
        },
        1);
    return table;
}

Figure plausibility_map() {
    Figure figure{"plausible-alpha", {plausibility_table()}, {}};
    figure.script =
        std::string{figure_style} + "set margins 9,17,4,5\n" +
        heading("Where the model of Kurt et al. 2010 conserves energy",
                "F = 1. Below a curve the albedo is at most 1 up to that angle of incidence.") +
        "set logscale x\nset xrange [0.02:2]\nset yrange [0:1]\nset xlabel 'width m of the slopes'\n"
        "set ylabel 'exponent α'\nset key at graph 1.02,0.95 left top reverse Left\n"
        "set xtics (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2)\n";
    std::string curves =
        plot(figure.tables[0], texts("to θ = ", {map_limits.begin(), map_limits.end()}, "°"));
    curves.replace(0, 5,
                   "plot 'plausible-alpha.csv' using 1:4 every ::1 with filledcurves x1 fs solid 0.12 "
                   "noborder lc rgb '#009e73' notitle, \\\n     ");
    figure.script += curves;
    return figure;
}

}  // namespace

std::vector<Figure> kurt_figures() {
    return {figure_2(), figure_3(), plausibility_map()};
}

}  // namespace hts::validation
