#include "validation/papers/microfacet_figures.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "hts/microfacet/walter.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

constexpr auto samples = "set samples 2\n";

constexpr auto two_panels = "set multiplot layout 1,2 margins 0.08,0.975,0.13,0.82 spacing 0.095,0.1\n";

constexpr auto lobe_panel = R"(set xlabel 'transmitted angle θ_o [°]'
set ylabel 'f_t |o·n| [1/sr]'
set xrange [-30:90]
set xtics 30
set yrange [0:*]
)";

/// Title and caption, written once, above the first panel.
std::string heading(const std::string& title, const std::string& caption) {
    return page_label(title, 0.015, 0.955, 18) + page_label(caption, 0.015, 0.9, 13);
}

/// Radiance that the facets send through, times the cosine: what an instrument inside the glass would see.
/// Positive angles lie on the side that light is refracted to.
double transmitted(const WalterBsdf& glass, double theta_i, double theta_o) {
    const SidedDirection in{Side::front, Direction::from_degrees(theta_i, 180)};
    const SidedDirection out{Side::back, Direction::from_degrees(std::abs(theta_o), theta_o < 0 ? 180 : 0)};
    return glass.bsdf(in, out) * out.direction.cos_theta();
}

/// theta_o where Snell's law sends the light [deg].
double snell(double theta_i) {
    constexpr double degree = std::numbers::pi / 180;
    return std::asin(std::sin(theta_i * degree) / measured_glass_index) / degree;
}

constexpr std::array incidences{0.0, 30.0, 60.0, 80.0};
constexpr std::array colours{"#0072b2", "#009e73", "#e69f00", "#d55e00"};

/// theta_o and a column per shape and angle of incidence, scaled as the paper's fits.
FigureTable lobes(const std::string& stem, const MeasuredGlass& glass, bool scaled) {
    FigureTable table{stem, {"theta_o_deg"}, {}};
    const WalterBsdf beckmann = glass.bsdf(FacetShape::beckmann);
    const WalterBsdf ggx = glass.bsdf(FacetShape::ggx);
    for (const double theta_i : incidences) {
        table.columns.push_back("beckmann_" + shortest(theta_i) + "_deg");
        table.columns.push_back("ggx_" + shortest(theta_i) + "_deg");
    }
    const int steps = glass.ggx_alpha < 0.1 ? 20 : 4;  // per degree
    for (int i = -30 * steps; i <= 90 * steps; ++i) {
        const double theta_o = static_cast<double>(i) / steps;
        std::vector<double> row{theta_o};
        for (const double theta_i : incidences) {
            row.push_back((scaled ? glass.beckmann_scale : 1) * transmitted(beckmann, theta_i, theta_o));
            row.push_back((scaled ? glass.ggx_scale : 1) * transmitted(ggx, theta_i, theta_o));
        }
        table.rows.push_back(row);
    }
    return table;
}

/// theta_m and the densities of normals.
FigureTable normals(const std::string& stem, const std::vector<std::string>& names,
                    const std::vector<FacetDistribution>& facets, const std::vector<double>& scales,
                    double end) {
    FigureTable table{stem, {"theta_m_deg"}, {}};
    table.columns.insert(table.columns.end(), names.begin(), names.end());
    for (int i = 0; i <= 360; ++i) {
        const double theta = end * i / 360;
        std::vector<double> row{theta};
        for (std::size_t k = 0; k < facets.size(); ++k) {
            row.push_back(scales[k] * facets[k].density(Direction::from_degrees(theta, 0).vector()));
        }
        table.rows.push_back(row);
    }
    return table;
}

FigureTable shadowing(const std::string& stem) {
    FigureTable table{stem, {"theta_v_deg", "beckmann", "ggx"}, {}};
    for (int i = 0; i <= 360; ++i) {
        const auto v = Direction::from_degrees(0.25 * i, 0);
        table.rows.push_back({0.25 * i, FacetDistribution::beckmann(0.2).shadowing(v),
                              FacetDistribution::ggx(0.2).shadowing(v)});
    }
    return table;
}

constexpr auto beckmann_line = "lw 2 dt 2 lc rgb '#d55e00' title 'Beckmann'";
constexpr auto ggx_line = "lw 2.4 lc rgb '#009e73' title 'GGX'";

/// Column of a table against its first.
std::string curve(const std::string& table, std::size_t column, const std::string& line) {
    return spectral::gnuplot_string(table + ".csv") + " using 1:" + std::to_string(column) +
           " every ::1 with lines " + line;
}

std::string plot(const std::vector<std::string>& curves) {
    std::string command = "plot ";
    for (std::size_t i = 0; i < curves.size(); ++i) command += (i == 0 ? "" : ", \\\n     ") + curves[i];
    return command + "\n";
}

Figure figure_2() {
    std::string arrows;
    std::vector<std::string> curves;
    for (std::size_t k = 0; k < incidences.size(); ++k) {
        const std::string angle = shortest(snell(incidences[k]));
        const std::string colour = std::string{" lc rgb '"} + colours[k] + "' ";
        arrows += "set arrow from " + angle + ", graph 0 to " + angle + ", graph 1 nohead dt 2 lw 1.4" +
                  colour + "\n";
        curves.push_back(curve("figure-2", 2 * k + 3,
                               "lw 2.4" + colour + "title 'θ_i = " + shortest(incidences[k]) + "°'"));
    }
    return {
        "figure-2",
        {lobes("figure-2", measured_glasses[0], false)},
        std::string{figure_style} + samples + "set margins 9,3,4,6\n" +
            heading("Light through ground glass, after Fig. 2 of Walter et al. 2007",
                    "Theory: GGX, α = 0.394, index 1.51. Dashed: where a smooth surface would refract the "
                    "light.") +
            lobe_panel + arrows + plot(curves)};
}

Figure figure_8() {
    const std::vector<FacetDistribution> facets{FacetDistribution::beckmann(0.2),
                                                FacetDistribution::phong(48), FacetDistribution::ggx(0.2)};
    return {
        "figure-8",
        {normals("figure-8-normals", {"beckmann", "phong", "ggx"}, facets, {1, 1, 1}, 40),
         shadowing("figure-8-shadowing")},
        std::string{figure_style} + samples + two_panels +
            heading("Normals and shadowing, after Fig. 8 of Walter et al. 2007",
                    "Beckmann α = 0.2, Phong exponent 48, GGX α = 0.2: Phong is like Beckmann, GGX has "
                    "a narrower peak and longer tails.") +
            "set xlabel 'θ_m [°]'\nset ylabel 'D [1/sr]'\nset xrange [0:40]\nset yrange [0:*]\n" +
            plot({curve("figure-8-normals", 2, beckmann_line),
                  curve("figure-8-normals", 3, "lw 2 dt 3 lc rgb '#0072b2' title 'Phong'"),
                  curve("figure-8-normals", 4, ggx_line)}) +
            "unset label\nset xlabel 'θ_v [°]'\nset ylabel 'G_1'\nset xrange [0:90]\n"
            "set yrange [0:1.05]\nset xtics 15\nset key left bottom\n" +
            plot({curve("figure-8-shadowing", 2, beckmann_line), curve("figure-8-shadowing", 3, ggx_line)})};
}

/// One of Figs 10, 11, 13, 14.
Figure sample_figure(const std::string& number, const MeasuredGlass& glass, double widest_normal) {
    const std::string stem = "figure-" + number;
    const std::vector<FacetDistribution> facets{FacetDistribution::beckmann(glass.beckmann_alpha),
                                                FacetDistribution::ggx(glass.ggx_alpha)};
    const std::string caption =
        "Theory, times the paper's scale. Beckmann: α = " + shortest(glass.beckmann_alpha) + ", scale " +
        shortest(glass.beckmann_scale) + "; GGX: α = " + shortest(glass.ggx_alpha) + ", scale " +
        shortest(glass.ggx_scale) + "; index 1.51; light at 0, 30, 60, 80°.";
    std::vector<std::string> curves;
    for (std::size_t k = 0; k < incidences.size(); ++k) {
        curves.push_back(
            curve(stem + "-lobes", 2 * k + 3, k == 0 ? ggx_line : "lw 2.4 lc rgb '#009e73' notitle"));
        curves.push_back(
            curve(stem + "-lobes", 2 * k + 2, k == 0 ? beckmann_line : "lw 2 dt 2 lc rgb '#d55e00' notitle"));
    }
    return {stem,
            {lobes(stem + "-lobes", glass, true),
             normals(stem + "-normals", {"beckmann", "ggx"}, facets, {glass.beckmann_scale, glass.ggx_scale},
                     widest_normal)},
            std::string{figure_style} + samples + two_panels +
                heading(std::string{"Transmission of "} + glass.name + " glass, after Fig. " + number +
                            " of Walter et al. 2007",
                        caption) +
                lobe_panel + plot(curves) +
                "unset label\nset xlabel 'θ_m [°]'\nset ylabel 'D, scaled [1/sr]'\nset xrange [0:" +
                shortest(widest_normal) + "]\nset xtics autofreq\n" +
                plot({curve(stem + "-normals", 3, ggx_line), curve(stem + "-normals", 2, beckmann_line)})};
}

}  // namespace

std::vector<Figure> walter_figures() {
    return {figure_2(),
            figure_8(),
            sample_figure("10", measured_glasses[0], 60),
            sample_figure("11", measured_glasses[1], 60),
            sample_figure("13", measured_glasses[2], 60),
            sample_figure("14", measured_glasses[3], 6)};
}

}  // namespace hts::validation
