#include "cli/answers/distance_report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "hts/error.hpp"
#include "spectral/energy/solved_surfaces.hpp"

namespace hts::cli {
namespace {

using spectral::BothTheories;
using spectral::Severity;
using spectral::TrueDecibels;
using Json = nlohmann::ordered_json;
using Point = spectral::MaterialValidity::Point;

TrueDecibels greater(const TrueDecibels& a, const TrueDecibels& b) {
    return {std::fmax(a.te, b.te), std::fmax(a.tm, b.tm), std::fmax(a.unpolarised, b.unpolarised)};
}

/// Of the cases with surfaces rough in both directions that stand near a surface at one of its wavelengths.
struct Solved {
    std::size_t points = 0;  ///< with such a case
    spectral::SolvedSurface worst{};
};

double greatest_distance_of(const spectral::SolvedSurface& each) {
    return std::fmax(each.he.unpolarised, each.unified.unpolarised);
}

/// Over the wavelengths at an angle of incidence.
struct AtAngle {
    double theta_deg = 0;
    std::size_t studied = 0, points = 0;
    BothTheories worst{{0, 0, 0}, {0, 0, 0}};  ///< of those that are studied
    Solved solved{};
};

std::vector<AtAngle> by_angle(const MaterialInfo& info) {
    std::vector<AtAngle> angles(info.theta.size());
    const auto points = info.validity.points();
    for (std::size_t i = 0; i < points.size(); ++i) {
        AtAngle& at = angles[i % angles.size()];
        at.theta_deg = info.theta[i % angles.size()];
        ++at.points;
        if (const auto near = spectral::nearest_solved(info.surface, points[i].sample, points[i].in)) {
            const bool first = ++at.solved.points == 1;
            if (first || greatest_distance_of(*near) > greatest_distance_of(at.solved.worst))
                at.solved.worst = *near;
        }
        const auto expected = distance_at(info, points[i]);
        if (!expected.studied) continue;
        ++at.studied;
        at.worst.he = greater(at.worst.he, expected.distance.he);
        at.worst.unified = greater(at.worst.unified, expected.distance.unified);
    }
    return angles;
}

std::string three(const TrueDecibels& of) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << of.te << " / " << of.tm << " / " << of.unpolarised;
    return text.str();
}

const spectral::DistanceStudy& study_of(const MaterialInfo& info) {
    return spectral::distance_study(info.surface, info.validity.points().front().sample.index.substrate());
}

Json json_of(const TrueDecibels& of) {
    return {{"te", of.te}, {"tm", of.tm}, {"unpolarised", of.unpolarised}};
}

}  // namespace

spectral::Judgement judgement_at(const MaterialInfo& info, const Point& point) {
    if (spectral::judged_by_distance(info.surface)) return spectral::judgement(distance_at(info, point));
    return {point.validity.severity(), spectral::decibels(point.validity.error)};
}

std::optional<spectral::Decibels> unified_distances(const MaterialInfo& info, std::span<const Point> points) {
    spectral::Decibels range{std::numeric_limits<double>::infinity(), 0};
    for (const Point& point : points) {
        const auto error = judgement_at(info, point).error;
        if (!error) return std::nullopt;
        range.least = std::fmin(range.least, error->least);
        range.most = std::fmax(range.most, error->most);
    }
    return range;
}

std::string distance_verdict(const MaterialInfo& info) {
    const auto points = info.validity.points();
    auto worst = Severity::fine;
    for (const Point& point : points) worst = std::max(worst, judgement_at(info, point).severity);
    const auto as_bad = std::count_if(points.begin(), points.end(), [&](const Point& point) {
        return judgement_at(info, point).severity == worst;
    });
    const std::string of = " from exact scattering in unpolarised light";
    const std::string at = " at " + std::to_string(as_bad) + " of " + std::to_string(points.size()) +
                           " points (wavelengths x angles)";
    const std::string fine = shortest(spectral::fine_distance), most = shortest(spectral::greatest_distance);
    if (worst == Severity::fine)
        return "Inside the model's validity: at most " + fine + " dB" + of + " is expected" + at + "\n";
    if (worst == Severity::caution)
        return "To be taken with caution" + at + ": " + fine + " to " + most + " dB" + of + " is expected\n";
    return "OUTSIDE the model's validity" + at + ": more than " + most + " dB" + of +
           " is expected,\nor nothing like it was solved exactly\n";
}

spectral::ExpectedDistance distance_at(const MaterialInfo& info,
                                       const spectral::MaterialValidity::Point& point) {
    return spectral::expected_distance(info.surface, point.sample, point.in);
}

void add_distance(TableWriter::Row& row, const MaterialInfo& info,
                  const spectral::MaterialValidity::Point& point) {
    const auto expected = distance_at(info, point);
    row.word(expected.studied ? "yes" : "no");
    for (const TrueDecibels& of : {expected.distance.he, expected.distance.unified}) {
        for (const double value : {of.te, of.tm, of.unpolarised})
            row.number(expected.studied ? value : std::numeric_limits<double>::quiet_NaN());
    }
}

namespace {

std::string four(const spectral::PolarisedDecibels& of) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << of.ss << " / " << of.pp << " / " << of.cross << " / "
         << of.unpolarised;
    return text.str();
}

/// A line per angle that has a case near it; empty if none has.
std::string solved_text(const std::vector<AtAngle>& angles) {
    std::ostringstream lines;
    for (const AtAngle& at : angles) {
        const auto& [points, worst] = at.solved;
        if (points == 0) continue;
        std::string tau = shortest(worst.length_in_plane);
        if (worst.length_across != worst.length_in_plane) tau += " x " + shortest(worst.length_across);
        lines << std::left << "  " << std::setw(9) << shortest(at.theta_deg) + " deg" << std::setw(28)
              << four(worst.he) << std::setw(28) << four(worst.unified) << shortest(worst.rms_roughness)
              << ", " << tau << ", " << shortest(worst.theta_i_deg) << " deg\n";
    }
    if (lines.str().empty()) return "";
    return "\nThe nearest of the surfaces rough in both directions that were solved exactly (hts truth "
           "vector) [dB],\ns / p / cross-polarised / unpolarised; of several wavelengths, the one with the "
           "greatest unpolarised distance.\nOf two tau the first lies in the plane of incidence:\n"
           "  theta_i  he                          he_unified                  sigma0, tau [lambda], "
           "theta_i\n" +
           lines.str();
}

Json json_of(const spectral::PolarisedDecibels& of) {
    return {{"s", of.ss}, {"p", of.pp}, {"cross", of.cross}, {"unpolarised", of.unpolarised}};
}

Json json_of(const Solved& solved) {
    if (solved.points == 0) return {};
    const auto& worst = solved.worst;
    return {{"points", solved.points},
            {"sigma0_over_lambda", worst.rms_roughness},
            {"tau_over_lambda", {worst.length_in_plane, worst.length_across}},
            {"theta_i_deg", worst.theta_i_deg},
            {"he", json_of(worst.he)},
            {"he_unified", json_of(worst.unified)}};
}

}  // namespace

std::string distance_text(const MaterialInfo& info) {
    const spectral::DistanceStudy& study = study_of(info);
    std::ostringstream text;
    text << "\nExpected distance from exact scattering [dB], TE / TM / unpolarised, the greatest over the "
            "wavelengths:\n"
         << std::left << "  theta_i  " << std::setw(22) << "he" << std::setw(22) << "he_unified"
         << "studied\n";
    bool outside = false;
    const auto angles = by_angle(info);
    for (const AtAngle& at : angles) {
        text << "  " << std::setw(9) << shortest(at.theta_deg) + " deg" << std::setw(22)
             << (at.studied > 0 ? three(at.worst.he) : "unknown") << std::setw(22)
             << (at.studied > 0 ? three(at.worst.unified) : "unknown") << at.studied << " of " << at.points
             << '\n';
        outside = outside || at.studied < at.points;
    }
    text << "Interpolated between " << study.cases << " cases solved exactly (hts truth models): profiles of "
         << study.substance << ".\nA case that is left out is met within a factor of "
         << three(study.left_out.he) << " (he), " << three(study.left_out.unified) << " (he_unified), rms.\n";
    if (outside) text << "Studied are " << study.range << ";\nof what is outside nothing is known.\n";
    text << solved_text(angles);
    if (spectral::judged_by_distance(info.surface))
        text << "The validity above is by this distance. The assumptions of " << judged_model
             << " are not those of " << info.material.model_name()
             << ": its mirror is not shadowed, light that is\nreflected again returns, and where "
                "the surface curves within a wavelength it is perturbation theory.\n";
    return text.str();
}

Json distance_json(const MaterialInfo& info) {
    const spectral::DistanceStudy& study = study_of(info);
    Json angles = Json::array();
    for (const AtAngle& at : by_angle(info)) {
        const bool known = at.studied > 0;
        angles.push_back({{"theta_deg", at.theta_deg},
                          {"studied", at.studied},
                          {"points", at.points},
                          {"he", known ? json_of(at.worst.he) : Json{}},
                          {"he_unified", known ? json_of(at.worst.unified) : Json{}},
                          {"in_both_directions", json_of(at.solved)}});
    }
    return {{"by_angle", angles},
            {"cases", study.cases},
            {"substance", study.substance},
            {"studied", study.range},
            {"left_out_factor",
             {{"he", json_of(study.left_out.he)}, {"he_unified", json_of(study.left_out.unified)}}}};
}

}  // namespace hts::cli
