#include "validation/scattering/rays/ray_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>

#include "hts/error.hpp"
#include "validation/scattering/rays/facet_tracing.hpp"

namespace hts::validation {
namespace {

constexpr std::array colours{"#0072b2", "#009e73", "#e69f00", "#d55e00", "#aa4499"};
std::vector<double> seen_deg() {
    return {30, 45, 60, 65, 70, 75, 80, 85};
}

std::vector<double> slopes(Effort effort) {
    if (effort == Effort::quick) return {0.1, 0.25};
    return {0.05, 0.1, 0.175, 0.25, 0.5, 1};
}

std::vector<double> lit_deg(Effort effort) {
    if (effort == Effort::quick) return {0, 60};
    return {0, 30, 60, 75};
}

struct Tables {
    FigureTable shadowing{"ray-shadowing",
                          {"sigma0_over_tau", "theta_deg", "lit", "standard_error", "lit_and_seen", "smith",
                           "he_torrance", "smith_correlated"},
                          {}};
    FigureTable bounces{
        "ray-bounces",
        {"sigma0_over_tau", "theta_i_deg", "once", "standard_error", "more", "lost", "he_torrance"},
        {}};
    FigureTable lobes{
        "ray-lobes",
        {"sigma0_over_tau", "theta_i_deg", "theta_r_deg", "traced", "he_torrance", "smith_correlated"},
        {}};
};

Tables traced(Effort effort, const TracingSettings& settings) {
    Tables tables;
    for (const double slope : slopes(effort)) {
        for (const ShadowingPoint& p : shadowing_points(slope, seen_deg(), settings))
            tables.shadowing.rows.push_back({p.slope, p.theta_deg, p.lit, p.lit_error, p.lit_and_seen,
                                             p.smith, p.he_torrance, p.correlated});
        for (const double theta : lit_deg(effort)) {
            const TracedLight light = traced_light(slope, theta, settings);
            const BouncePoint& b = light.bounces;
            tables.bounces.rows.push_back(
                {b.slope, b.theta_i_deg, b.once, b.once_error, b.more, b.lost, b.he_torrance});
            for (const LobePoint& p : light.lobe)
                tables.lobes.rows.push_back(
                    {p.slope, p.theta_i_deg, p.theta_r_deg, p.traced, p.he_torrance, p.smith});
        }
    }
    return tables;
}

using Row = std::vector<double>;

/// The row with the greatest value among some.
const Row* worst_of(const FigureTable& table, const std::function<bool(const Row&)>& wanted,
                    const std::function<double(const Row&)>& value) {
    const Row* worst = nullptr;
    for (const Row& row : table.rows) {
        if (wanted(row) && (worst == nullptr || value(row) > value(*worst))) worst = &row;
    }
    if (worst == nullptr) throw Error{table.stem + ": no row in question"};
    return worst;
}

std::string place(const Row& row) {
    return "sigma0/tau = " + shortest(row[0]) + ", " + shortest(row[1]) + " deg";
}

Check shadowing_check(const FigureTable& table, double most_theta) {
    const auto off = [](const Row& row) { return std::fabs(row[2] - row[5]); };
    const Row& worst = *worst_of(
        table, [&](const Row& row) { return row[0] <= 0.25 && row[1] <= most_theta; }, off);
    return {
        "Smith's S_1 within 0.02 of the share of an explicit surface that is lit, sigma0/tau <= 0.25, up "
        "to " +
            shortest(most_theta) + " deg",
        rounded(off(worst), 4) + " at worst", off(worst) <= 0.02,
        place(worst) + ": " + rounded(worst[2], 4) + " +- " + rounded(worst[3], 4) + ", Smith " +
            rounded(worst[5], 4) +
            (off(worst) <= 0.02
                 ? ""
                 : ". Smith takes heights along the ray for independent of each other; of Gaussian "
                   "heights with their correlation less is lit")};
}

std::vector<Check> checks(const std::vector<FigureTable>& tables) {
    std::vector<Check> found{shadowing_check(tables[0], 60), shadowing_check(tables[0], 85)};
    const FigureTable& bounces = tables[1];
    const auto everywhere = [](const Row&) { return true; };
    const Row& lost = *worst_of(bounces, everywhere, [](const Row& row) { return row[5]; });
    found.push_back(
        {"every ray leaves the surface", rounded(100 * lost[5], 3) + " % lost at most", lost[5] == 0});
    const auto too_much = [](const Row& row) { return row[6] - row[2]; };
    const Row& most = *worst_of(bounces, everywhere, too_much);
    const Row& least = *worst_of(
        bounces, [](const Row& row) { return row[0] <= 0.25; },
        [&](const Row& row) { return -too_much(row); });
    found.push_back(
        {"the model's lobe returns no more than what is reflected once, to 0.5 % of the light",
         rounded(100 * std::max(0.0, too_much(most)), 2) + " % too much at worst", too_much(most) <= 0.005,
         "what is missing, a(lambda) must make up for; for sigma0/tau <= 0.25 up to " +
             rounded(-100 * too_much(least), 1) + " % more than is reflected more than once (" +
             place(least) + ": once " + rounded(least[2], 3) + ", model " + rounded(least[6], 3) + ")"});
    return found;
}

std::string head(const std::string& title, const std::string& subtitle, int width, int height) {
    return "set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
           " font 'Helvetica,14' background '#ffffff'\nset output picture\n" + figure_style +
           page_label(title, 0.015, 0.965, 19) + page_label(subtitle, 0.015, 0.93, 13);
}

/// Rows of a table with given first numbers, without those.
std::vector<Row> rows_with(const FigureTable& table, const Row& first) {
    std::vector<Row> rows;
    for (const Row& row : table.rows) {
        if (std::equal(first.begin(), first.end(), row.begin()))
            rows.emplace_back(row.begin() + static_cast<std::ptrdiff_t>(first.size()), row.end());
    }
    return rows;
}

Figure shadowing_figure(const FigureTable& table) {
    const auto all = different(table, 0);
    std::ostringstream out;
    out << head("How much of a rough surface is lit, and lit and seen",
                "Rays on explicit surfaces (dots) against Smith's functions (lines); seen from the mirror "
                "direction.",
                1000, 720)
        << "set multiplot layout 2,3 margins 0.06,0.98,0.08,0.86 spacing 0.05,0.1\n"
        << "set xrange [28:88]\nset xtics 15\n"
        << "set yrange [0:1.05]\nset ytics 0.25\n"
        << "set key at graph 0.03,0.04 left bottom Left reverse samplen 2 font ',13'\n";
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string name = "$s" + std::to_string(i);
        out << data_block(name.substr(1), rows_with(table, {all[i]})) << "set title 'σ_0/τ = " << all[i]
            << "' font ',14' offset 0,-0.7\n"
            << (i + 3 >= all.size() ? "set xlabel 'angle [°]' offset 0,0.5\n" : "") << "plot " << name
            << " using 1:5 with lines lw 2.2 lc rgb '#0072b2' title 'Smith S_1', " << name
            << " using 1:6 with lines lw 2.2 lc rgb '#e69f00' title 'S of He et al.', " << name
            << " using 1:7 with lines lw 2.2 dt 2 lc rgb '#d55e00' title 'heights correlated', " << name
            << " using 1:2:3 with yerrorbars pt 7 ps 0.6 lc rgb '#000000' title 'lit', " << name
            << " using 1:4 with points pt 6 ps 0.7 lc rgb '#000000' title 'lit and seen'\nset key off\nunset "
               "label\n";
    }
    out << "unset multiplot\n";
    return {"ray-shadowing", {}, out.str(), "Shadowing of explicit Gaussian surfaces."};
}

/// Angles of incidence of which the lobes are drawn.
std::vector<double> drawn_angles(const FigureTable& table) {
    auto angles = different(table, 1);
    std::erase_if(angles, [](double theta) { return theta == 0; });
    return angles;
}

Figure lobe_figure(const FigureTable& table) {
    auto steepness = different(table, 0);
    std::erase_if(steepness, [](double slope) { return slope != 0.1 && slope != 0.25 && slope != 0.5; });
    const auto angles = drawn_angles(table);
    std::ostringstream out;
    out << head("Light reflected once by explicit surfaces of perfect mirrors",
                "BRDF x cos θr [1/sr] within 15° of the plane of incidence; negative angles: the side of "
                "the source.",
                1000, 120 + 240 * static_cast<int>(steepness.size()))
        << "set multiplot layout " << steepness.size() << ',' << angles.size()
        << " margins 0.06,0.98,0.09,0.87 spacing 0.06,0.1\nset xrange [-90:90]\nset xtics 30\nset yrange "
           "[0:*]\n"
        << "set key at screen 0.985,0.985 right top vertical samplen 2 font ',12'\n";
    std::size_t number = 0;
    for (const double slope : steepness) {
        for (const double theta : angles) {
            const std::string name = "$l" + std::to_string(number++);
            out << data_block(name.substr(1), rows_with(table, {slope, theta}))
                << "set title 'σ_0/τ = " << slope << ", θ_i = " << theta << "°' font ',13' offset 0,-0.8\n"
                << (slope == steepness.back() ? "set xlabel 'angle of reflection [°]' offset 0,0.5\n" : "")
                << "plot " << name << " using 1:2 with points pt 7 ps 0.45 lc rgb '#000000' title 'traced', "
                << name << " using 1:3 with lines lw 2.4 lc rgb '#0072b2' title 'this model, rough limit', "
                << name
                << " using 1:4 with lines lw 2 dt 2 lc rgb '#d55e00' title 'Beckmann facets of σ_0, heights "
                   "correlated'\n"
                << "set key off\nunset label\n";
        }
    }
    out << "unset multiplot\n";
    return {"ray-lobes", {}, out.str(), "Single reflection in geometric optics."};
}

Figure bounce_figure(const FigureTable& table) {
    const auto angles = different(table, 1);
    std::ostringstream out;
    out << head("Light reflected more than once, and what the model leaves out",
                "Perfect mirrors, rough limit. Dots: rays that leave after two or more reflections. Lines: 1 "
                "- the model's lobe.",
                900, 560)
        << "set margins 9,3,4,5\nset xrange [0:1.05]\nset yrange [0:1]\nset xlabel 'σ_0/τ'\n"
        << "set ylabel 'share of the light'\nset key bottom right Left reverse samplen 2\n";
    std::string plots;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        std::vector<Row> rows;
        for (const Row& row : table.rows) {
            if (row[1] == angles[i]) rows.push_back({row[0], row[4], 1 - row[6]});
        }
        const std::string name = "$b" + std::to_string(i), colour = colours[i % colours.size()];
        out << data_block(name.substr(1), rows);
        plots.append(i == 0 ? "plot " : ", ")
            .append(name)
            .append(" using 1:2 with points pt 7 ps 0.9 lc rgb '");
        plots.append(colour)
            .append("' title 'θ_i = ")
            .append(shortest(angles[i]))
            .append("°', ")
            .append(name);
        plots.append(" using 1:3 with lines lw 2 lc rgb '").append(colour).append("' notitle");
    }
    out << plots << '\n';
    return {"ray-bounces",
            {},
            out.str(),
            "Multiple reflection: the energy that the model leaves to a(lambda), and what its shadowing "
            "loses besides."};
}

void add_results(Section& section, const std::vector<FigureTable>& tables, const std::string& provenance) {
    for (Check& check : checks(tables)) section.checks.push_back(std::move(check));
    for (Figure figure : {shadowing_figure(tables[0]), bounce_figure(tables[1]), lobe_figure(tables[2])}) {
        figure.caption += " " + provenance;
        section.figures.push_back(std::move(figure));
    }
}

Section section() {
    return {"ray-tracing",
            "Rays through explicit surfaces",
            "Gaussian height fields of perfect mirrors, triangulated at 16 samples per correlation length, "
            "are lit by parallel "
            "rays that are followed until they leave. Where geometric optics holds this is exact: shadowing "
            "with the "
            "correlation of heights, the lobe of a single reflection, and all that is reflected more often, "
            "which the model "
            "neglects and leaves to a(lambda).",
            {},
            {},
            {},
            {},
            {}};
}

}  // namespace

GroundTruth rays_study(Effort effort) {
    TracingSettings settings;
    if (effort == Effort::quick) settings = {4, 12, 4000, 5000};
    Tables tables = traced(effort, settings);
    return ground_truth(
        "Rays through random surfaces of 24 tau by 24 tau: " + std::to_string(settings.surfaces) +
            " surfaces, " + std::to_string(settings.samples_per_tau) + " samples per tau, " +
            std::to_string(settings.points) + " points and " + std::to_string(settings.rays) +
            " rays each, seeds from " + std::to_string(settings.study) + regenerating("rays", effort),
        {tables.shadowing, tables.bounces, tables.lobes}, section(), add_results);
}

Section rays_section(Effort effort) {
    return section_of(rays_study(effort), effort, add_results);
}

}  // namespace hts::validation
