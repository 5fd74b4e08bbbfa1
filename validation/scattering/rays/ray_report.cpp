#include "validation/scattering/rays/ray_report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"
#include "spectral/output/script.hpp"
#include "validation/report/prose.hpp"
#include "validation/scattering/rays/facet_tracing.hpp"

namespace hts::validation {
namespace {

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
    const spectral::Job job{"", slopes(effort).size() * (1 + lit_deg(effort).size())};
    for (const double slope : slopes(effort)) {
        for (const ShadowingPoint& p : shadowing_points(slope, seen_deg(), settings))
            tables.shadowing.rows.push_back({p.slope, p.theta_deg, p.lit, p.lit_error, p.lit_and_seen,
                                             p.smith, p.he_torrance, p.correlated});
        job.done();
        for (const double theta : lit_deg(effort)) {
            const TracedLight light = traced_light(slope, theta, settings);
            const BouncePoint& b = light.bounces;
            tables.bounces.rows.push_back(
                {b.slope, b.theta_i_deg, b.once, b.once_error, b.more, b.lost, b.he_torrance});
            for (const LobePoint& p : light.lobe)
                tables.lobes.rows.push_back(
                    {p.slope, p.theta_i_deg, p.theta_r_deg, p.traced, p.he_torrance, p.smith});
            job.done();
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
    const auto slopes = different(table, 0);
    std::vector<output::Rows> shares;
    shares.reserve(slopes.size());
    for (const double slope : slopes) shares.push_back(rows_with(table, {slope}));
    return {"ray-shadowing",
            {},
            output::Script{}.set("slope", slopes).data("shares", shares).with("ray-shadowing"),
            "Shadowing of explicit Gaussian surfaces."};
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
    std::vector<output::Rows> lobes;
    for (const double slope : steepness) {
        for (const double theta : angles) lobes.push_back(rows_with(table, {slope, theta}));
    }
    output::Script script;
    script.set("slope", steepness).set("theta_i", angles).data("lobes", lobes);
    return {"ray-lobes", {}, script.with("ray-lobes"), "Single reflection in geometric optics."};
}

Figure bounce_figure(const FigureTable& table) {
    const auto angles = different(table, 1);
    std::vector<output::Rows> shares;
    for (const double angle : angles) {
        shares.emplace_back();
        for (const Row& row : table.rows) {
            if (row[1] == angle) shares.back().push_back({row[0], row[4], 1 - row[6]});
        }
    }
    return {"ray-bounces",
            {},
            output::Script{}.set("theta_i", angles).data("shares", shares).with("ray-bounces"),
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
    return {"ray-tracing", "Rays through explicit surfaces", prose("ray-tracing"), {}, {}, {}, {}, {}};
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
