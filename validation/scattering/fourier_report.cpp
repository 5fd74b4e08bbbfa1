#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "hts/error.hpp"
#include "validation/scattering/fourier_integral.hpp"

namespace hts::validation {
namespace {

constexpr std::array colours{"#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#aa4499"};

std::vector<FourierCase> cases(Effort effort) {
    if (effort == Effort::quick) return {{1, 1, 0}, {5, 2, 30}};
    return {{0.1, 1, 30}, {1, 1, 0}, {1, 2, 60}, {5, 2, 30}, {20, 3, 30}, {5, 3, 70}};
}

double degrees_theta(const Direction& direction) {
    return std::acos(direction.cos_theta()) * 180 / std::numbers::pi;
}

double degrees_phi(const Direction& direction) {
    return std::atan2(direction.sin_phi(), direction.cos_phi()) * 180 / std::numbers::pi;
}

FigureTable table_of(const std::vector<FourierResult>& results, int realisations) {
    FigureTable table{
        "fourier-integral",
        {"phase_variance", "tau_over_lambda", "theta_i_deg", "sigma0_over_lambda", "realisations",
         "theta_r_deg", "phi_r_deg", "computed_brdf", "standard_error", "closed_form_brdf", "deviation"},
        {}};
    for (const FourierResult& result : results) {
        for (const FourierPoint& point : result.points)
            table.rows.push_back({result.of.phase_variance, result.of.correlation_length,
                                  degrees_theta(point.in), result.surface.rms_roughness,
                                  static_cast<double>(realisations), degrees_theta(point.out),
                                  degrees_phi(point.out), point.computed, point.standard_error,
                                  point.closed_form, point.deviation()});
    }
    return table;
}

/// Rows of one surface and incidence after the other.
std::vector<std::vector<std::vector<double>>> groups(const FigureTable& table) {
    std::vector<std::vector<std::vector<double>>> all;
    for (const auto& row : table.rows) {
        if (all.empty() || !std::equal(row.begin(), row.begin() + 3, all.back()[0].begin()))
            all.emplace_back();
        all.back().push_back(row);
    }
    return all;
}

std::string case_text(const std::vector<double>& row) {
    return "g = " + shortest(row[0]) + ", τ = " + shortest(row[1]) + " λ, " + rounded(row[2], 0) + "°";
}

std::vector<Check> checks(const FigureTable& table) {
    const std::size_t deviation = column_of(table, "deviation");
    std::vector<Check> found;
    double within = 0, squares = 0;
    for (const auto& row : table.rows) {
        within += std::fabs(row[deviation]) <= 3 ? 1 : 0;
        squares += row[deviation] * row[deviation];
    }
    const auto count = static_cast<double>(table.rows.size());
    std::string remark;
    for (const auto& group : groups(table)) {
        const auto inside = std::count_if(group.begin(), group.end(),
                                          [&](const auto& row) { return std::fabs(row[deviation]) <= 3; });
        remark.append(remark.empty() ? "" : "; ").append(case_text(group[0]));
        remark.append(": ")
            .append(std::to_string(inside))
            .append(" of ")
            .append(std::to_string(group.size()));
    }
    found.push_back(
        {"directional-diffuse term before shadowing within 3 standard errors of the Fourier integral in at "
         "least 95 % of directions",
         rounded(100 * within / count, 1) + " % of " + std::to_string(table.rows.size()),
         within >= 0.95 * count, remark});
    const double rms = std::sqrt(squares / count);
    found.push_back({"the deviations are those of chance: rms 0.8 to 1.2 standard errors", rounded(rms, 2),
                     rms > 0.8 && rms < 1.2});
    return found;
}

Figure figure(const FigureTable& table, const std::string& provenance) {
    const auto all = groups(table);
    std::ostringstream out;
    out << "set terminal svg size 1000,560 font 'Helvetica,14' background '#ffffff'\nset output picture\n"
        << figure_style
        << page_label("The Fourier integral of explicit surfaces against the closed form", 0.015, 0.96, 19)
        << page_label("Before shadowing. Each point is a direction; bars are standard errors of the mean.",
                      0.015, 0.915, 13);
    std::vector<double> deviations;
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::vector<std::vector<double>> numbers;
        for (const auto& row : all[i]) {
            numbers.push_back({row[9], row[7] / row[9], row[8] / row[9]});
            deviations.push_back(row[10]);
        }
        out << data_block("case" + std::to_string(i), numbers);
    }
    std::sort(deviations.begin(), deviations.end());
    std::vector<std::vector<double>> steps;
    for (std::size_t i = 0; i < deviations.size(); ++i)
        steps.push_back(
            {deviations[i], (static_cast<double>(i) + 0.5) / static_cast<double>(deviations.size())});
    out << data_block("deviations", steps)
        << "set multiplot layout 1,2 margins 0.075,0.975,0.12,0.86 spacing 0.08,0.05\n"
        << "set logscale x\nset format x '10^{%L}'\nset xlabel 'closed form [1/sr]'\nset ylabel 'computed / "
           "closed form'\n"
        << "set yrange [0.5:1.6]\nset key inside top left Left reverse vertical maxrows 3 samplen 0.8 font "
           "',11'\n"
        << "set arrow from graph 0, first 1 to graph 1, first 1 nohead lc rgb '#888888'\nplot ";
    for (std::size_t i = 0; i < all.size(); ++i)
        out << (i == 0 ? "" : ", ") << "$case" << i
            << " using 1:2:3 with yerrorbars pt 7 ps 0.4 lw 1 lc rgb '" << colours[i % colours.size()]
            << "' title '" << case_text(all[i][0]) << '\'';
    out << "\nunset label\nunset arrow\nunset logscale\nset format x '%g'\nset key top left Left reverse at "
           "graph 0.03,0.97\n"
        << "set xrange [-4:4]\nset yrange [0:1]\nset xlabel '(computed - closed form) / standard error'\n"
        << "set ylabel 'share of directions below'\n"
        << "plot norm(x) with lines lw 2 lc rgb '#888888' title 'chance', "
        << "$deviations using 1:2 with steps lw 2 lc rgb '#0072b2' title 'found'\nunset multiplot\n";
    return {"fourier-integral", {}, out.str(), "Kirchhoff's integral over explicit surfaces. " + provenance};
}

void add_fourier_results(Section& section, const std::vector<FigureTable>& tables,
                         const std::string& provenance) {
    for (Check& check : checks(tables[0])) section.checks.push_back(std::move(check));
    section.figures.push_back(figure(tables[0], provenance));
}

Section fourier_section() {
    return {"fourier-integral",
            "The Fourier integral of explicit surfaces",
            "Periodic random surfaces are drawn, Kirchhoff's diffraction integral is summed over each with "
            "the surface's own "
            "slopes, and |N|^2 averaged. The result must be the directional-diffuse term with sigma = sigma0 "
            "and S = 1: Phi, G "
            "and the factors between them, none of which the sum knows. Directions are drawn at random among "
            "those with a "
            "BRDF of at least a thousandth of the brightest, up to 85 degrees.",
            {},
            {},
            {},
            {},
            {}};
}

}  // namespace

GroundTruth fourier_study(Effort effort) {
    FourierSettings settings;
    if (effort == Effort::quick) settings.realisations = 100;
    std::vector<FourierResult> results;
    for (const FourierCase& of : cases(effort)) results.push_back(fourier_result(of, settings));
    return ground_truth("Fourier integral of random surfaces 12 tau by 12 tau, periodic: " +
                            std::to_string(settings.realisations) + " realisations, " +
                            std::to_string(settings.directions) + " directions each, seeds from " +
                            std::to_string(settings.study) + regenerating("fourier", effort),
                        {table_of(results, settings.realisations)}, fourier_section(), add_fourier_results);
}

Section fourier_section(Effort effort) {
    return section_of(fourier_study(effort), effort, add_fourier_results);
}

}  // namespace hts::validation
