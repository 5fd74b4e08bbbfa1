#include "validation/scattering/exact_scattering.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "hts/error.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

std::vector<double> incidence_deg() {
    return {0, 30, 60, 70};
}

struct MapEntry {
    const MomentResult &te, &tm, &unpolarised;
};

/// Whether the surfaces are K-correlated: then nu ends each row.
bool k_correlated(const std::vector<MomentResult>& results) {
    return results.front().of.surface.nu.has_value();
}

/// Three results, one per polarisation, make a row.
std::vector<MapEntry> entries(const std::vector<MomentResult>& results) {
    std::vector<MapEntry> all;
    for (std::size_t i = 0; i + 2 < results.size(); i += 3)
        all.push_back({results[i], results[i + 1], results[i + 2]});
    return all;
}

std::vector<double> row_head(const MomentCase& of) {
    return {of.surface.rms_roughness, of.surface.correlation_length, of.theta_i_deg};
}

std::vector<double> map_row(const MapEntry& entry) {
    const MomentCase& of = entry.te.of;
    std::vector<double> row = row_head(of);
    const double theta = of.theta_i_deg * std::numbers::pi / 180;
    row.insert(row.end(), {static_cast<double>(entry.te.realisations), entry.te.energy, entry.tm.energy,
                           entry.te.past_ends, entry.tm.past_ends, entry.te.transmitted, entry.tm.transmitted,
                           entry.te.mirror, entry.tm.mirror});
    const ProfileHeights heights{of.surface};
    for (const ProfileModel model : {ProfileModel::kirchhoff, ProfileModel::he_torrance})
        row.push_back(facet_reflectance(entry.unpolarised.of, theta) * profile_mirror(model, heights, theta));
    for (const ProfileModel model : profile_models) {
        const Distance unpolarised = distance(entry.unpolarised, model);
        row.insert(row.end(), {distance(entry.te, model).rms, distance(entry.tm, model).rms, unpolarised.rms,
                               unpolarised.median, unpolarised.bias});
    }
    row.insert(row.end(), {chance(entry.unpolarised), kirchhoff_distance(entry.te).rms});
    if (of.surface.nu) row.push_back(*of.surface.nu);
    return row;
}

/// Rows of a map within limits.
struct Region {
    double least_tau, most_tau, least_slope, most_slope, least_theta, most_theta;
};

/// Greatest and least of a column in a region.
struct Extremes {
    double least = 1e300, most = -1e300;
    std::vector<double> where{};  // the row of the greatest
    std::size_t count = 0;
};

bool within(const Region& region, const std::vector<double>& row) {
    const double slope = row[0] / row[1];
    return row[1] >= region.least_tau && row[1] <= region.most_tau && slope >= region.least_slope &&
           slope <= region.most_slope && row[2] >= region.least_theta && row[2] <= region.most_theta;
}

Extremes extremes(const FigureTable& map, std::string_view column, const Region& region) {
    const std::size_t c = column_of(map, column);
    Extremes found;
    for (const auto& row : map.rows) {
        if (!within(region, row)) continue;
        ++found.count;
        found.least = std::min(found.least, row[c]);
        if (row[c] > found.most) {
            found.most = row[c];
            found.where = row;
        }
    }
    return found;
}

constexpr double any = 1e9;

std::string place(const std::vector<double>& row) {
    return "sigma0 = " + shortest(row[0]) + " lambda, tau = " + shortest(row[1]) + " lambda, " +
           shortest(row[2]) + " deg";
}

std::string decibel_text(double value) {
    return rounded(value, 2) + " dB";
}

Check energy_check(const FigureTable& map, const std::string& suffix, const char* what) {
    const std::size_t c = column_of(map, "energy_" + suffix),
                      past_column = column_of(map, "past_ends_" + suffix);
    const auto off = [c](const std::vector<double>& row) { return std::fabs(row[c] - 1); };
    const auto worst = std::max_element(map.rows.begin(), map.rows.end(),
                                        [&](const auto& a, const auto& b) { return off(a) < off(b); });
    const auto beyond =
        std::count_if(map.rows.begin(), map.rows.end(), [&](const auto& row) { return off(row) > 0.01; });
    std::string remark = "at " + place(*worst);
    if (beyond > 0)
        remark.append("; ")
            .append(std::to_string(beyond))
            .append(" of ")
            .append(std::to_string(map.rows.size())) += " beyond 1 %";
    const auto past = std::max_element(map.rows.begin(), map.rows.end(), [&](const auto& a, const auto& b) {
        return a[past_column] < b[past_column];
    });
    remark.append("; what passes the ends of the profile below the horizon is at most ")
        .append(rounded(100 * (*past)[past_column], 2))
        .append(" % (")
        .append(place(*past)) += ")";
    return {std::string{
                "what is scattered, passes the ends and enters the ground is all that falls in, to 1 %, "} +
                what,
            rounded(100 * off(*worst), 2) + " % at worst", beyond == 0, remark};
}

/// Smith's shadowing of correlated heights does better than the model's where slopes are large.
Check steep_check(const FigureTable& map) {
    const Region steep{0.5, any, 0.25, any, 60, 60};
    const Extremes model = extremes(map, "he_torrance_db", steep), smith = extremes(map, "smith_db", steep);
    return {
        "at 60 deg and sigma0/tau >= 1/4, tau > lambda/2, Smith with correlated heights and sigma0 is nearer "
        "to exact than this model",
        "model " + decibel_text(model.least) + " to " + decibel_text(model.most) + ", Smith " +
            decibel_text(smith.least) + " to " + decibel_text(smith.most),
        smith.most < model.least};
}

/// How often one column is below another.
struct Count {
    std::ptrdiff_t nearer = 0, total = 0;

    [[nodiscard]] std::string text() const { return std::to_string(nearer) + " of " + std::to_string(total); }
};

Count nearer_count(const FigureTable& map, std::string_view one, std::string_view other,
                   const Region& region) {
    const std::size_t a = column_of(map, one), b = column_of(map, other);
    Count count;
    for (const auto& row : map.rows) {
        if (!within(region, row)) continue;
        ++count.total;
        if (row[a] < row[b]) ++count.nearer;
    }
    return count;
}

/// rms distance of a model [dB] over the lobe of a row of the map, weighted with the exact energy, up to an
/// angle of scattering.
double lobe_distance(const FigureTable& lobes, const std::vector<double>& map_row, const std::string& model,
                     double most_theta_r) {
    const std::size_t te = column_of(lobes, "exact_te"), tm = column_of(lobes, "exact_tm"),
                      currents = column_of(lobes, "kirchhoff_currents"),
                      closed = column_of(lobes, "kirchhoff"), own = column_of(lobes, model);
    double weight = 0, squares = 0;
    for (const auto& row : lobes.rows) {
        const double exact = (row[te] + row[tm]) / 2;
        if (!std::equal(row.begin(), row.begin() + 3, map_row.begin()) || std::fabs(row[3]) > most_theta_r ||
            !(exact > 0) || !(row[currents] > 0))
            continue;
        const double difference = 10 * std::log10(row[own] / row[closed] * row[currents] / exact);
        weight += exact;
        squares += exact * difference * difference;
    }
    if (!(weight > 0)) throw Error{lobes.stem + ": no light in the lobe of " + place(map_row)};
    return std::sqrt(squares / weight);
}

/// Light in TM that passes the ends of the profile, of what is scattered within 10 degrees of the horizon.
double past_ends_share(const FigureTable& map, const FigureTable& lobes, const std::vector<double>& map_row) {
    const std::size_t tm = column_of(lobes, "exact_tm");
    double low = 0;
    for (const auto& row : lobes.rows) {
        if (std::equal(row.begin(), row.begin() + 3, map_row.begin()) && std::fabs(row[3]) > 80)
            low += row[tm] * bin_width_deg * std::numbers::pi / 180;
    }
    return map_row[column_of(map, "past_ends_tm")] / low;
}

/// How far the angles near the horizon make up a distance, and how sure they are.
std::string horizon_remark(const std::vector<FigureTable>& tables, const std::vector<double>& map_row,
                           const std::string& model) {
    const double share = past_ends_share(tables[0], tables[1], map_row);
    return "; " + decibel_text(lobe_distance(tables[1], map_row, model, 80)) +
           " without the last 10 deg above the horizon; there the exact TM lobe is up to " +
           decibel_text(10 * std::log10(1 + share)) + " low: " + rounded(100 * share, 1) +
           " % of the light in it passes the ends of the profile besides, and an infinite one would keep it";
}

Section exact_section() {
    return {"exact-scattering",
            "Exact scattering: the method of moments",
            prose("exact-scattering"),
            {},
            {},
            {},
            {},
            {"measured bistatic scattering of a machined random profile"}};
}

void add_exact_results(Section& section, const std::vector<FigureTable>& tables,
                       const std::string& provenance) {
    for (Check& check : moment_checks(tables)) section.checks.push_back(std::move(check));
    const LobePanels panels{"perfectly conducting", {{0.1, 2}, {0.5, 2}, {0.25, 1}, {0.1, 0.35}}, {30, 60}};
    for (Figure figure : {moment_map_figure(tables[0]), moment_lobe_figure(tables[1], panels)}) {
        figure.caption += " " + provenance;
        section.figures.push_back(std::move(figure));
    }
}

}  // namespace

std::vector<RoughnessStatistics> moment_grid(Effort effort) {
    if (effort == Effort::quick) return {{0.1, 2}, {0.25, 1}, {0.1, 0.35}};
    std::vector<RoughnessStatistics> grid;
    for (const double length : {0.35, 0.7, 1.0, 2.0, 4.0}) {
        for (const double roughness : {0.05, 0.1, 0.25, 0.5, 1.0}) {
            if (roughness <= length / 2) grid.push_back({roughness, length});
        }
    }
    return grid;
}

FigureTable moment_map_table(const std::vector<MomentResult>& results, std::string stem) {
    FigureTable table{std::move(stem),
                      {"sigma0_over_lambda", "tau_over_lambda", "theta_i_deg", "realisations", "energy_te",
                       "energy_tm", "past_ends_te", "past_ends_tm", "transmitted_te", "transmitted_tm",
                       "mirror_te", "mirror_tm", "mirror_kirchhoff", "mirror_he_torrance"},
                      {}};
    for (const ProfileModel model : profile_models) {
        for (const char* what : {"_te_db", "_tm_db", "_db", "_median_db", "_bias_db"})
            table.columns.push_back(std::string{name(model)} + what);
    }
    table.columns.insert(table.columns.end(), {"chance_db", "kirchhoff_against_closed_form_db"});
    if (k_correlated(results)) table.columns.emplace_back("nu");
    for (const MapEntry& entry : entries(results)) table.rows.push_back(map_row(entry));
    return table;
}

FigureTable moment_lobe_table(const std::vector<MomentResult>& results, std::string stem) {
    FigureTable table{
        std::move(stem),
        {"sigma0_over_lambda", "tau_over_lambda", "theta_i_deg", "theta_r_deg", "exact_te", "exact_tm",
         "kirchhoff_currents", "kirchhoff", "he_torrance", "smith", "ratio_error_db"},
        {}};
    const bool ground = results.front().of.index.has_value();
    if (ground) table.columns.insert(table.columns.end(), {"he_torrance_te", "he_torrance_tm"});
    table.columns.insert(table.columns.end(), {"kirchhoff_currents_te", "kirchhoff_currents_tm"});
    if (k_correlated(results)) table.columns.emplace_back("nu");
    constexpr auto own = static_cast<std::size_t>(ProfileModel::he_torrance);
    for (const MapEntry& entry : entries(results)) {
        for (std::size_t i = 0; i < entry.te.bins.size(); ++i) {
            const AngularBin &te = entry.te.bins[i], &tm = entry.tm.bins[i],
                             &both = entry.unpolarised.bins[i];
            std::vector<double> row = row_head(entry.te.of);
            row.insert(row.end(), {te.theta_r_deg, te.exact, tm.exact, both.kirchhoff});
            row.insert(row.end(), both.model.begin(), both.model.end());
            row.push_back(both.ratio_error_db);
            if (ground) row.insert(row.end(), {te.model[own], tm.model[own]});
            row.insert(row.end(), {te.kirchhoff, tm.kirchhoff});
            if (entry.te.of.surface.nu) row.push_back(*entry.te.of.surface.nu);
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

std::vector<Check> energy_checks(const FigureTable& map) {
    return {energy_check(map, "te", "TE"), energy_check(map, "tm", "TM")};
}

Check trend_check(const std::vector<FigureTable>& tables, const Trend& of) {
    const FigureTable &map = tables[0], &lobes = tables[1];
    const double most_slope = std::tan(of.most_slope_deg * std::numbers::pi / 180) / std::numbers::sqrt2;
    const Region region{2, any, 0, most_slope, 0, 60};
    double most = -1;
    std::vector<double> where;
    for (const auto& row : map.rows) {
        if (!within(region, row)) continue;
        const double distance = lobe_distance(lobes, row, of.model, of.most_theta_r);
        if (distance <= most) continue;
        most = distance;
        where = row;
    }
    std::string claim = std::string{of.title} +
                        ": within 0.6 dB of exact for tau >= 2 lambda, rms slope below " +
                        shortest(of.most_slope_deg) + " deg, up to 60 deg (unpolarised)";
    if (of.most_theta_r < 90)
        claim += ", scattered " + shortest(90 - of.most_theta_r) + " deg or more above the horizon";
    if (where.empty()) return {claim, "no surface in this region", false};
    std::string remark =
        "at " + place(where) + ", where chance is " + decibel_text(where[column_of(map, "chance_db")]);
    if (of.most_theta_r >= 90) remark += horizon_remark(tables, where, of.model);
    return {claim, decibel_text(most) + " at worst", most <= 0.6, remark};
}

Check nearer_check(const FigureTable& map, const std::string& title, const std::string& remark) {
    const Region all{0, any, 0, any, 0, any}, gentle{1, any, 0, 0.25, 0, 60};
    const Count nearer = nearer_count(map, "he_torrance_db", "kirchhoff_db", all);
    return {
        title + " is nearer to exact than Kirchhoff without shadowing (unpolarised)",
        "in " + nearer.text() + " cases", nearer.total > 0 && nearer.nearer == nearer.total,
        "in " + nearer_count(map, "he_torrance_db", "kirchhoff_db", gentle).text() +
            " for tau >= lambda, sigma0/tau <= 1/4, up to 60 deg; Smith with correlated heights is nearer "
            "than this model in " +
            nearer_count(map, "smith_db", "he_torrance_db", all).text() + "; " + remark};
}

std::vector<Check> moment_checks(const std::vector<FigureTable>& tables) {
    const FigureTable& map = tables[0];
    std::vector<Check> checks = energy_checks(map);
    for (Trend trend :
         {Trend{"this model", "he_torrance"}, Trend{"Kirchhoff without shadowing", "kirchhoff"}}) {
        checks.push_back(trend_check(tables, trend));
        trend.most_theta_r = 80;
        checks.push_back(trend_check(tables, trend));
        trend.most_theta_r = 90;
        trend.most_slope_deg = 19;
        checks.push_back(trend_check(tables, trend));
    }
    checks.push_back(trend_check(tables, {"Smith with correlated heights and sigma0", "smith"}));
    checks.push_back(steep_check(map));
    checks.push_back(nearer_check(map, "this model",
                                  "light that meets a conductor a second time comes back, and the model "
                                  "shadows it"));
    const Extremes closed = extremes(map, "kirchhoff_against_closed_form_db", {0, any, 0, any, 0, 60});
    checks.push_back(
        {"Kirchhoff's currents on the same profiles give the closed form, within 0.7 dB a bin of 5 deg",
         decibel_text(closed.most) + " at worst", closed.most <= 0.7,
         "up to 60 deg; " + place(closed.where)});
    return checks;
}

std::string moment_provenance(const std::string& what, const MomentSettings& settings) {
    return "Exact scattering by random profiles, " + what + ": method of moments, " +
           std::to_string(settings.realisations) + " realisations, " + shortest(settings.length) +
           " wavelengths long, " + std::to_string(settings.points_per_wavelength) +
           " points per wavelength, tapered beam g = length/4, seeds from " + std::to_string(settings.study);
}

GroundTruth exact_scattering_study(Effort effort, const std::string& unfinished) {
    MomentSettings settings;
    if (effort == Effort::quick) settings.realisations = 40;
    std::vector<LitSurface> lit;
    for (const RoughnessStatistics& surface : moment_grid(effort)) lit.push_back({surface, incidence_deg()});
    const auto results = moment_results(lit, settings, unfinished);
    return ground_truth(
        moment_provenance("perfectly conducting", settings) + regenerating("moments", effort),
        {moment_map_table(results, "moment-method-map"), moment_lobe_table(results, "moment-method-lobes")},
        exact_section(), add_exact_results);
}

Section exact_scattering_section(Effort effort) {
    return section_of(exact_scattering_study(effort), effort, add_exact_results);
}

}  // namespace hts::validation
