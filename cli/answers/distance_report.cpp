#include "cli/answers/distance_report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <vector>

#include "hts/error.hpp"

namespace hts::cli {
namespace {

using spectral::BothTheories;
using spectral::TrueDecibels;
using Json = nlohmann::ordered_json;

TrueDecibels greater(const TrueDecibels& a, const TrueDecibels& b) {
    return {std::fmax(a.te, b.te), std::fmax(a.tm, b.tm), std::fmax(a.unpolarised, b.unpolarised)};
}

/// Over the wavelengths at an angle of incidence.
struct AtAngle {
    double theta_deg = 0;
    std::size_t studied = 0, points = 0;
    BothTheories worst{{0, 0, 0}, {0, 0, 0}};  ///< of those that are studied
};

std::vector<AtAngle> by_angle(const MaterialInfo& info) {
    std::vector<AtAngle> angles(info.theta.size());
    const auto points = info.validity.points();
    for (std::size_t i = 0; i < points.size(); ++i) {
        AtAngle& at = angles[i % angles.size()];
        at.theta_deg = info.theta[i % angles.size()];
        ++at.points;
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
    return spectral::distance_study(info.validity.points().front().sample.index.substrate());
}

Json json_of(const TrueDecibels& of) {
    return {{"te", of.te}, {"tm", of.tm}, {"unpolarised", of.unpolarised}};
}

}  // namespace

spectral::ExpectedDistance distance_at(const MaterialInfo& info,
                                       const spectral::MaterialValidity::Point& point) {
    return spectral::expected_distance(
        info.surface, point.sample, std::acos(std::fmin(1, point.in.cos_theta())) * 180 / std::numbers::pi);
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

std::string distance_text(const MaterialInfo& info) {
    const spectral::DistanceStudy& study = study_of(info);
    std::ostringstream text;
    text << "\nExpected distance from exact scattering [dB], TE / TM / unpolarised, the greatest over the "
            "wavelengths:\n"
         << std::left << "  theta_i  " << std::setw(22) << "he" << std::setw(22) << "he_unified"
         << "studied\n";
    bool outside = false;
    for (const AtAngle& at : by_angle(info)) {
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
    if (info.material.model_name() != judged_model)
        text << "The limits above are those of the assumptions of " << judged_model << ". "
             << info.material.model_name()
             << " makes fewer: its mirror is not shadowed, light that is\nreflected again returns, and where "
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
                          {"he_unified", known ? json_of(at.worst.unified) : Json{}}});
    }
    return {{"by_angle", angles},
            {"cases", study.cases},
            {"substance", study.substance},
            {"studied", study.range},
            {"left_out_factor",
             {{"he", json_of(study.left_out.he)}, {"he_unified", json_of(study.left_out.unified)}}}};
}

}  // namespace hts::cli
