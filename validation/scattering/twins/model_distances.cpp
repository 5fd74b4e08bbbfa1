#include "validation/scattering/twins/model_distances.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"

namespace hts::validation {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int angles_within = 10;  // of a bin, as the exact lobes are averaged

double decibels(double ratio) {
    return 10 * std::log10(ratio);
}

double of(const ProfileLobe& lobe, Polarisation polarisation) {
    return std::array{lobe.te, lobe.tm, (lobe.te + lobe.tm) / 2}[static_cast<std::size_t>(polarisation)];
}

double distance(const ExactLobe& exact, const std::vector<ProfileLobe>& model,
                const std::vector<ProfileLobe>& kirchhoff, double most_theta_r, Polarisation polarisation) {
    double weight = 0, squares = 0;
    for (std::size_t i = 0; i < exact.exact.size(); ++i) {
        const double power = of(exact.exact[i], polarisation),
                     currents = of(exact.kirchhoff[i], polarisation);
        const double closed = of(kirchhoff[i], polarisation);
        if (std::fabs(exact.theta_r_deg[i]) > most_theta_r || !(power > 0) || !(currents > 0) ||
            closed < least_light)
            continue;
        const double difference = decibels(of(model[i], polarisation) / closed * currents / power);
        weight += power;
        squares += power * difference * difference;
    }
    return weight > 0 ? std::sqrt(squares / weight) : 0;
}

CaseDistances of_case(std::size_t set, const ExactLobe& exact) {
    const auto twin = [&](TwinModel model) {
        return binned(ProfileTwin{model, exact.surface, kept_sets()[set].index}, exact);
    };
    const auto kirchhoff = twin(TwinModel::kirchhoff), he = twin(TwinModel::he),
               unified = twin(kept_sets()[set].successor);
    constexpr double above_horizon = 80;
    return {set,
            exact.surface,
            exact.theta_i_deg,
            distances(exact, he, kirchhoff),
            distances(exact, unified, kirchhoff),
            distances(exact, twin(TwinModel::smith), kirchhoff),
            distances(exact, he, kirchhoff, above_horizon),
            distances(exact, unified, kirchhoff, above_horizon)};
}

using Cases = std::vector<CaseDistances>;
using Of = Distances CaseDistances::*;

/// Which cases make a group of the table.
struct Group {
    std::string title;
    std::function<bool(const CaseDistances&)> has;
};

bool gentle(const CaseDistances& of) {
    return of.surface.correlation_length >= 1 &&
           of.surface.rms_roughness <= of.surface.correlation_length / 4 && of.theta_i_deg <= 60;
}

/// K-correlated cases of a set, by nu; false if there are none.
bool add_shapes(std::vector<Group>& groups, const Cases& cases,
                const std::function<bool(const CaseDistances&)>& of_set) {
    std::set<double> shapes;
    for (const CaseDistances& each : cases)
        if (of_set(each) && each.surface.nu) shapes.insert(*each.surface.nu);
    for (const double nu : shapes)
        groups.push_back({"of these nu = " + shortest(nu), [of_set, nu](const CaseDistances& of) {
                              return of_set(of) && of.surface.nu == nu;
                          }});
    return !shapes.empty();
}

std::vector<Group> groups(const Cases& cases) {
    std::vector<Group> all;
    for (std::size_t set = 0; set < kept_sets().size(); ++set) {
        const auto of_set = [set](const CaseDistances& of) { return of.set == set; };
        all.push_back({kept_sets()[set].title, of_set});
        if (add_shapes(all, cases, of_set)) continue;
        const auto gentle_ones = [of_set](const CaseDistances& of) { return of_set(of) && gentle(of); };
        const auto count = std::count_if(cases.begin(), cases.end(), gentle_ones);
        if (count > 0 && count < std::count_if(cases.begin(), cases.end(), of_set))
            all.push_back({"of these gentle", gentle_ones});
    }
    return all;
}

/// The shortcut is of unpolarised light alone.
bool knows(TwinModel model, Polarisation polarisation) {
    return model != TwinModel::he_unified_shortcut || polarisation == Polarisation::unpolarised;
}

std::vector<double> values(const Cases& cases, const Group& group, Of model, Polarisation polarisation) {
    std::vector<double> all;
    for (const CaseDistances& each : cases) {
        if (group.has(each) && knows(kept_sets()[each.set].successor, polarisation))
            all.push_back((each.*model)[polarisation]);
    }
    return all;
}

/// max / median / rms / number below 0.5 dB
std::vector<std::string> summary(const std::vector<double>& all) {
    constexpr double small = 0.5;
    const auto below = std::count_if(all.begin(), all.end(), [](double value) { return value < small; });
    return {rounded(*std::max_element(all.begin(), all.end()), 2), rounded(spectral::median(all), 2),
            rounded(spectral::root_mean_square(all), 2), std::to_string(below)};
}

ReportTable summary_table(const Cases& cases) {
    ReportTable table{"model-summary",
                      "Distance from exact scattering [dB] of the published model and of its successor over "
                      "the kept cases: greatest, median, rms, and in how many cases it is below 0.5 dB. "
                      "Nearer: cases in which he_unified is nearer to exact than he, and the same without "
                      "the last 10 degrees above the horizon. Gentle: tau >= lambda, sigma0/tau <= 1/4, "
                      "light up to 60 degrees.",
                      {"data", "cases", "polarisation", "he max", "median", "rms", "< 0.5", "he_unified max",
                       "median", "rms", "< 0.5", "nearer", "above 10 deg"},
                      {}};
    for (const Group& group : groups(cases)) {
        for (const Polarisation polarisation : polarisations) {
            if (values(cases, group, &CaseDistances::he, polarisation).empty()) continue;
            const auto he = values(cases, group, &CaseDistances::he, polarisation),
                       unified = values(cases, group, &CaseDistances::unified, polarisation),
                       he_above = values(cases, group, &CaseDistances::he_above, polarisation),
                       unified_above = values(cases, group, &CaseDistances::unified_above, polarisation);
            std::size_t nearer = 0, nearer_above = 0;
            for (std::size_t i = 0; i < he.size(); ++i) {
                if (unified[i] < he[i]) ++nearer;
                if (unified_above[i] < he_above[i]) ++nearer_above;
            }
            std::vector<std::string> row{group.title, std::to_string(he.size()), name(polarisation)};
            for (const auto& of_model : {summary(he), summary(unified)})
                row.insert(row.end(), of_model.begin(), of_model.end());
            row.insert(row.end(), {std::to_string(nearer), std::to_string(nearer_above)});
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

/// Where the successor is further off than the published model.
ReportTable loss_table(const Cases& cases) {
    ReportTable table{
        "model-losses",
        "Cases in which he_unified is more than 0.05 dB further from exact than he; the last two columns are "
        "without the last 10 degrees above the horizon.",
        {"data", "sigma0/lambda", "tau/lambda", "theta_i", "polarisation", "he", "he_unified", "he above",
         "he_unified above"},
        {}};
    for (const CaseDistances& each : cases) {
        for (const Polarisation polarisation : polarisations) {
            if (each.unified[polarisation] <= each.he[polarisation] + 0.05 ||
                kept_sets()[each.set].successor == TwinModel::he_unified_shortcut)
                continue;
            table.rows.push_back(
                {kept_sets()[each.set].title, shortest(each.surface.rms_roughness),
                 shortest(each.surface.correlation_length), shortest(each.theta_i_deg), name(polarisation),
                 rounded(each.he[polarisation], 2), rounded(each.unified[polarisation], 2),
                 rounded(each.he_above[polarisation], 2), rounded(each.unified_above[polarisation], 2)});
        }
    }
    return table;
}

/// Absolute errors of the mirrored share of conductors: the published model's, and
/// second-order perturbation theory's.
ReportTable mirror_table() {
    const FigureTable map = kept_table("moment-method-map");
    ReportTable table{
        "model-mirrors",
        "Error of the share of light that is mirrored, perfect conductors of the first set: he, and "
        "he_unified with \"mirror\": \"second_order\" as profiles have it. The closed form of he_unified has "
        "no twin for profiles.",
        {"polarisation", "he rms", "greatest", "second order rms", "greatest"},
        {}};
    for (const Polarisation polarisation : {Polarisation::te, Polarisation::tm}) {
        std::vector<double> he, second;
        for (const auto& row : map.rows) {
            const RoughnessStatistics surface{row[0], row[1]};
            const double exact = row[column_of(map, std::string{"mirror_"} + name(polarisation))],
                         theta = row[2] * degree;
            he.push_back(std::fabs(profile_mirror(ProfileModel::he_torrance, surface, theta) - exact));
            second.push_back(std::fabs(of(second_order_mirror(surface, theta), polarisation) - exact));
        }
        std::vector<std::string> row{name(polarisation)};
        for (const auto& errors : {he, second}) {
            row.push_back(rounded(spectral::root_mean_square(errors), 3));
            row.push_back(rounded(*std::max_element(errors.begin(), errors.end()), 3));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string three(const Cases& cases, const Group& group, Of model) {
    std::string text;
    for (const Polarisation polarisation : polarisations)
        text += (text.empty() ? "" : " / ") +
                rounded(spectral::root_mean_square(values(cases, group, model, polarisation)), 2);
    return text + " dB";
}

Group of_set(const char* stem) {
    return {stem,
            [stem](const CaseDistances& of) { return std::string_view{kept_sets()[of.set].stem} == stem; }};
}

/// Bounds in TE, TM and unpolarised light.
using Bounds = std::array<double, 3>;

Check rms_check(const Cases& cases, const Group& group, const std::string& claim, const Bounds& bounds) {
    bool met = true;
    for (const Polarisation polarisation : polarisations)
        met =
            met && spectral::root_mean_square(values(cases, group, &CaseDistances::unified, polarisation)) <=
                       bounds[static_cast<std::size_t>(polarisation)];
    return {claim, three(cases, group, &CaseDistances::unified), met,
            "he: " + three(cases, group, &CaseDistances::he) + " (TE / TM / unpolarised)"};
}

std::vector<Check> distance_checks(const Cases& cases) {
    std::vector<Check> checks;
    const Group first = of_set("moment-method");
    checks.push_back(
        rms_check(cases, first,
                  "he_unified on the first set of conductors: rms at most 0.45 / 0.40 / 0.35 dB in TE / TM / "
                  "unpolarised light",
                  {0.45, 0.40, 0.35}));
    const Group gentle_ones{"gentle", [&](const CaseDistances& of) { return first.has(of) && gentle(of); }};
    double worst = 0;
    for (const Polarisation polarisation : polarisations)
        for (const double value : values(cases, gentle_ones, &CaseDistances::unified, polarisation))
            worst = std::max(worst, value);
    checks.push_back({"he_unified below 0.5 dB in every gentle case of that set, in each polarisation",
                      rounded(worst, 2) + " dB at worst", worst < 0.5});
    if (const Group unseen = of_set("unseen");
        !values(cases, unseen, &CaseDistances::he, Polarisation::te).empty())
        checks.push_back(rms_check(
            cases, unseen,
            "he_unified on conductors that no constant was chosen by: rms within 1.2 times these bounds",
            {1.2 * 0.45, 1.2 * 0.40, 1.2 * 0.35}));
    const CaseDistances* where = nullptr;
    double most = -1;
    for (const CaseDistances& each : cases) {
        if (each.surface.nu || kept_sets()[each.set].successor == TwinModel::he_unified_shortcut)
            continue;  // sets of their own in the tables
        for (const Polarisation polarisation : polarisations) {
            const double loss = each.unified_above[polarisation] - each.he_above[polarisation];
            if (loss <= most) continue;
            most = loss;
            where = &each;
        }
    }
    checks.push_back(
        {"he_unified nowhere more than 0.1 dB further from exact than he, without the last 10 deg above the "
         "horizon",
         rounded(most, 2) + " dB at worst", most <= 0.1,
         where == nullptr ? ""
                          : std::string{kept_sets()[where->set].title} +
                                ", sigma0 = " + shortest(where->surface.rms_roughness) +
                                " lambda, tau = " + shortest(where->surface.correlation_length) +
                                " lambda, " + shortest(where->theta_i_deg) + " deg"});
    return checks;
}

FigureTable distance_table(const Cases& cases) {
    FigureTable table{"model-distances",
                      {"set", "index_n", "index_k", "sigma0_over_lambda", "tau_over_lambda", "theta_i_deg"},
                      {}};
    constexpr std::array<std::pair<const char*, Of>, 5> models{
        {{"he", &CaseDistances::he},
         {"he_unified", &CaseDistances::unified},
         {"smith", &CaseDistances::smith},
         {"he_above_10_deg", &CaseDistances::he_above},
         {"he_unified_above_10_deg", &CaseDistances::unified_above}}};
    for (const auto& model : models) {
        for (const char* polarisation : {"_te_db", "_tm_db", "_db"})
            table.columns.push_back(std::string{model.first} + polarisation);
    }
    table.columns.emplace_back("nu");  // 0 of Gaussian heights
    for (const CaseDistances& each : cases) {
        const KeptSet& set = kept_sets()[each.set];
        if (set.apart && !each.surface.nu) continue;
        std::vector<double> row{
            static_cast<double>(each.set),   set.index.n(),   set.index.k(), each.surface.rms_roughness,
            each.surface.correlation_length, each.theta_i_deg};
        for (const auto& model : models) {
            for (const Polarisation polarisation : polarisations)
                row.push_back((each.*model.second)[polarisation]);
        }
        row.push_back(each.surface.nu.value_or(0));
        table.rows.push_back(std::move(row));
    }
    return table;
}

void add_nothing(Section&, const std::vector<FigureTable>&, const std::string&) {}
}  // namespace

const std::vector<KeptSet>& kept_sets() {
    static const std::vector<KeptSet> sets{
        {"moment-method", "conductor, first set", perfect_conductor(), TwinModel::he_unified},
        {"unseen", "conductor, drawn by a seed", perfect_conductor(), TwinModel::he_unified},
        {"dielectric", "glass 1.5, mixing", {1.5, 0}, TwinModel::he_unified_mixing},
        {"metal", "metal 0.16 + 3.6i", {0.16, 3.6}, TwinModel::he_unified},
        {"grazing", "conductor, long profiles", perfect_conductor(), TwinModel::he_unified, true},
        {"k-correlation", "conductor, K-correlated", perfect_conductor(), TwinModel::he_unified, true},
        {"metal", "metal, conductor_shortcut", {0.16, 3.6}, TwinModel::he_unified_shortcut, true}};
    return sets;
}

std::vector<ExactLobe> exact_lobes(const FigureTable& lobes) {
    const std::size_t te = column_of(lobes, "exact_te"), tm = column_of(lobes, "exact_tm"),
                      kirchhoff_te = column_of(lobes, "kirchhoff_currents_te"),
                      kirchhoff_tm = column_of(lobes, "kirchhoff_currents_tm"),
                      error = column_of(lobes, "ratio_error_db");
    std::vector<ExactLobe> all;
    for (const auto& row : lobes.rows) {
        std::optional<double> nu;
        if (const auto at = std::ranges::find(lobes.columns, "nu"); at != lobes.columns.end())
            nu = row[static_cast<std::size_t>(at - lobes.columns.begin())];
        if (all.empty() || all.back().surface.rms_roughness != row[0] ||
            all.back().surface.correlation_length != row[1] || all.back().theta_i_deg != row[2])
            all.push_back({{row[0], row[1], nu}, row[2], {}, {}, {}, {}});
        ExactLobe& lobe = all.back();
        lobe.theta_r_deg.push_back(row[3]);
        lobe.error_db.push_back(row[error]);
        lobe.exact.push_back({row[te], row[tm]});
        lobe.kirchhoff.push_back({row[kirchhoff_te], row[kirchhoff_tm]});
    }
    return all;
}

std::vector<ProfileLobe> binned(const ProfileTwin& model, const ExactLobe& exact) {
    std::vector<ProfileLobe> bins;
    for (const double middle : exact.theta_r_deg) {
        ProfileLobe mean{0, 0};
        for (int i = 0; i < angles_within; ++i) {
            const double away = bin_width_deg * ((i + 0.5) / angles_within - 0.5);
            const ProfileLobe at = model.lobe(exact.theta_i_deg * degree, (middle + away) * degree);
            mean.te += at.te / angles_within;
            mean.tm += at.tm / angles_within;
        }
        bins.push_back(mean);
    }
    return bins;
}

Distances distances(const ExactLobe& exact, const std::vector<ProfileLobe>& model,
                    const std::vector<ProfileLobe>& kirchhoff, double most_theta_r) {
    const auto in = [&](Polarisation polarisation) {
        return distance(exact, model, kirchhoff, most_theta_r, polarisation);
    };
    return {in(Polarisation::te), in(Polarisation::tm), in(Polarisation::unpolarised)};
}

Cases case_distances() {
    std::vector<std::pair<std::size_t, ExactLobe>> lobes;
    for (std::size_t set = 0; set < kept_sets().size(); ++set) {
        for (ExactLobe& lobe : exact_lobes(kept_table(std::string{kept_sets()[set].stem} + "-lobes")))
            lobes.emplace_back(set, std::move(lobe));
    }
    Cases cases(lobes.size());
    spectral::parallel_for(cases.size(),
                           [&](std::size_t i) { cases[i] = of_case(lobes[i].first, lobes[i].second); });
    return cases;
}

GroundTruth model_distance_study(Effort effort) {
    const Cases cases = case_distances();
    GroundTruth truth = ground_truth(
        "Distances of models from the exact lobes that are kept, in dB; sets as in "
        "validation/scattering/twins/model_distances.cpp, from 0" +
            regenerating("models", effort),
        {distance_table(cases)},
        {"model-distances", "The published model and its successor", "", {}, {}, {}, {}, {}}, add_nothing);
    truth.section.checks = distance_checks(cases);
    truth.section.tables = {summary_table(cases), loss_table(cases), mirror_table()};
    return truth;
}

}  // namespace hts::validation
