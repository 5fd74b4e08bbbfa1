#include "validation/papers/microfacet_figures.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "hts/microfacet/walter.hpp"
#include "spectral/output/script.hpp"

namespace hts::validation {
namespace {

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

Figure walter_figure_2() {
    std::vector<double> angles, refracted;
    for (const double theta_i : incidences) {
        angles.push_back(theta_i);
        refracted.push_back(snell(theta_i));
    }
    output::Script script;
    return {"figure-2",
            {lobes("figure-2", measured_glasses[0], false)},
            script.set("theta_i", angles).set("refracted", refracted).with("walter-figure-2")};
}

Figure walter_figure_8() {
    const std::vector<FacetDistribution> facets{FacetDistribution::beckmann(0.2),
                                                FacetDistribution::phong(48), FacetDistribution::ggx(0.2)};
    return {"figure-8",
            {normals("figure-8-normals", {"beckmann", "phong", "ggx"}, facets, {1, 1, 1}, 40),
             shadowing("figure-8-shadowing")},
            output::Script{}.with("walter-figure-8")};
}

/// One of Figs 10, 11, 13, 14.
Figure sample_figure(const std::string& number, const MeasuredGlass& glass, double widest_normal) {
    const std::string stem = "figure-" + number;
    const std::vector<FacetDistribution> facets{FacetDistribution::beckmann(glass.beckmann_alpha),
                                                FacetDistribution::ggx(glass.ggx_alpha)};
    output::Script script;
    script.set("title", std::string{"Transmission of "} + glass.name + " glass, after Fig. " + number +
                            " of Walter et al. 2007");
    script.set("caption", "Theory, times the paper's scale. Beckmann: α = " + shortest(glass.beckmann_alpha) +
                              ", scale " + shortest(glass.beckmann_scale) +
                              "; GGX: α = " + shortest(glass.ggx_alpha) + ", scale " +
                              shortest(glass.ggx_scale) + "; index 1.51; light at 0, 30, 60, 80°.");
    script.set("lobes", stem + "-lobes.csv").set("normals", stem + "-normals.csv");
    script.set("incidences", incidences.size()).set("widest", widest_normal);
    return {stem,
            {lobes(stem + "-lobes", glass, true),
             normals(stem + "-normals", {"beckmann", "ggx"}, facets, {glass.beckmann_scale, glass.ggx_scale},
                     widest_normal)},
            script.with("walter-sample")};
}

}  // namespace

std::vector<Figure> walter_figures() {
    return {walter_figure_2(),
            walter_figure_8(),
            sample_figure("10", measured_glasses[0], 60),
            sample_figure("11", measured_glasses[1], 60),
            sample_figure("13", measured_glasses[2], 60),
            sample_figure("14", measured_glasses[3], 6)};
}

}  // namespace hts::validation
