#include "cli/answers/info_report.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <utility>

#include "cli/answers/distance_report.hpp"
#include "cli/answers/roughness_report.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"

namespace hts::cli {
namespace {

using spectral::Criterion;
using spectral::Finding;
using spectral::MaterialValidity;
using spectral::Severity;
using Point = MaterialValidity::Point;
using Json = nlohmann::ordered_json;

constexpr Tolerance prepared_tolerance{accuracy::finest_lane_tolerance};

/// Along the steepest slopes of the surface.
std::vector<Direction> directions(const Surface& surface, const std::vector<double>& theta) {
    const auto& [along, across] = surface.correlation_lengths();
    const double azimuth = surface.azimuth() + (along <= across ? 0 : std::numbers::pi / 2);
    std::vector<Direction> result;
    result.reserve(theta.size());
    for (const double degrees : theta) {
        const Direction in = Direction::from_degrees(degrees, 0);
        result.push_back(surface.isotropic()
                             ? in
                             : Direction::from_vector({in.sin_theta() * std::cos(azimuth),
                                                       in.sin_theta() * std::sin(azimuth), in.cos_theta()}));
    }
    return result;
}

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -std::numeric_limits<double>::infinity();

    [[nodiscard]] std::string text() const {
        const std::string low = brief(least, 3), high = brief(greatest, 3);
        return low == high ? low : low + " to " + high;
    }
    [[nodiscard]] Json json() const { return {least, greatest}; }
};

/// Of a quantity over some of the points.
template <class Quantity>
Range range_of(std::span<const Point> points, const Quantity& quantity) {
    Range range;
    for (const Point& point : points) {
        range.least = std::fmin(range.least, quantity(point));
        range.greatest = std::fmax(range.greatest, quantity(point));
    }
    return range;
}

double phase_variance(const Point& point) {
    return point.validity.phase_variance;
}
double mirror_share(const Point& point) {
    return std::exp(-point.validity.phase_variance);
}
double n(const Point& point) {
    return point.sample.index.substrate().n();
}
double k(const Point& point) {
    return point.sample.index.substrate().k();
}
double albedo(const Point& point) {
    return point.sample.uniform_diffuse * std::numbers::pi;
}
double micrometres(const Point& point) {
    return point.sample.wavelength.micrometres();
}

/// From the least g to the greatest.
std::vector<std::string> regimes(const Range& g) {
    std::vector<std::string> names;
    for (auto i = static_cast<int>(spectral::regime(g.least));
         i <= static_cast<int>(spectral::regime(g.greatest)); ++i)
        names.emplace_back(name(static_cast<spectral::Regime>(i)));
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(name);
    return text;
}

double degrees_of(const MaterialInfo& info, const Point& point) {
    const auto place = static_cast<std::size_t>(&point - info.validity.points().data());
    return info.theta[place % info.theta.size()];
}

std::string error_text(const std::optional<spectral::Decibels>& known) {
    if (!known) return "unknown";
    if (known->most == 0) return "none (a mirror)";
    if (known->most == known->least) return brief(known->least) + " dB";
    return brief(known->least) + " to " + brief(known->most) + " dB";
}

std::string error_text(spectral::ModelError error) {
    return error_text(decibels(error));
}

std::string verdict_text(const MaterialValidity& validity) {
    const Severity worst = validity.severity();
    if (worst == Severity::fine) return "Inside the model's validity";
    const auto as_bad = [worst](const Point& point) { return point.validity.severity() == worst; };
    const auto points = validity.points();
    return (worst == Severity::outside ? "OUTSIDE the model's validity at "
                                       : "To be taken with caution at ") +
           std::to_string(std::count_if(points.begin(), points.end(), as_bad)) + " of " +
           std::to_string(points.size()) + " points (wavelengths x angles); measured worst:";
}

std::string extra_reason(const MaterialInfo& info, Criterion criterion) {
    if (criterion != Criterion::slope) return "";
    const double share = spectral::share_beyond_45_degrees(
        info.surface.seen_by(info.validity.points().front().sample.wavelength));
    return ";\n           " + brief(100 * share, 3) +
           " % of the surface is steeper than 45 deg and reflects light from above further down";
}

std::string finding_text(const MaterialInfo& info, Criterion criterion) {
    const Point& where = info.validity.worst(criterion);
    const Finding& finding = where.validity[criterion];
    const spectral::Limits limits = spectral::limits(criterion);
    std::ostringstream text;
    text << "  " << std::setw(9) << std::left << name(finding.severity()) << name(criterion) << ": "
         << quantity(criterion) << " = " << brief(finding.measured, 3) << " at "
         << shortest(micrometres(where)) << " um, " << shortest(degrees_of(info, where)) << " deg; "
         << (limits.least() ? ">= " : "<= ") << brief(limits.caution, 3) << " is fine";
    if (std::isfinite(limits.outside))
        text << ", " << (limits.least() ? "< " : "> ") << brief(limits.outside, 3) << " outside";
    if (finding.severity() != Severity::fine)
        text << "\n           " << reason(criterion) << extra_reason(info, criterion);
    text << '\n';
    return text.str();
}

/// What the shortest wavelength sees: the steepest slopes.
Surface steepest_of(const MaterialInfo& info) {
    return info.surface.seen_by(info.validity.points().front().sample.wavelength);
}

std::vector<double> wavelengths_of(const MaterialInfo& info) {
    std::vector<double> all;
    for (std::size_t i = 0; i < info.validity.points().size(); i += info.theta.size())
        all.push_back(micrometres(info.validity.points()[i]));
    return all;
}

std::string length_note(const Surface& surface) {
    std::string shape =
        surface.correlation()
            ? "tau of the findings is sqrt(2) sigma0 over the rms slope of frequencies up to 1/lambda. "
              "Limits and errors are those\nof Gaussian correlations.\n"
            : "";
    if (surface.isotropic()) return shape;
    return shape +
           "Angles are in the plane of the steepest slopes, along the shorter correlation length, which is "
           "the tau of the\nfindings. Limits and errors are those of isotropic surfaces: of others they are "
           "not measured yet.\n";
}

Json length_json(const Surface& surface) {
    if (surface.isotropic()) return surface.correlation_length();
    return {surface.correlation_lengths().along, surface.correlation_lengths().across};
}

/// A line per angle, each over all wavelengths.
std::string angles_text(const MaterialInfo& info) {
    std::ostringstream text;
    text << std::left << "\n  theta_i  " << std::setw(22) << "g" << std::setw(24) << "mirror's share exp(-g)"
         << std::setw(10) << "validity"
         << "expected error\n";
    for (std::size_t i = 0; i < info.theta.size(); ++i) {
        std::vector<Point> points;
        Severity severity = Severity::fine;
        auto error = spectral::ModelError::none;
        for (std::size_t j = i; j < info.validity.points().size(); j += info.theta.size()) {
            points.push_back(info.validity.points()[j]);
            severity = std::max(severity, judgement_at(info, points.back()).severity);
            error = std::max(error, points.back().validity.error);
        }
        text << "  " << std::setw(9) << shortest(info.theta[i]) + " deg" << std::setw(22)
             << range_of(points, phase_variance).text() << std::setw(24)
             << range_of(points, mirror_share).text() << std::setw(10) << name(severity)
             << (spectral::judged_by_distance(info.surface) ? error_text(unified_distances(info, points))
                                                            : error_text(error))
             << '\n';
    }
    return text.str();
}

std::vector<Criterion> criteria() {
    std::vector<Criterion> all;
    for (std::size_t i = 0; i < spectral::criterion_count; ++i) all.push_back(static_cast<Criterion>(i));
    return all;
}

/// What the assumptions of he say.
std::string criteria_text(const MaterialInfo& info) {
    std::string text = verdict_text(info.validity) + "\n";
    for (const Criterion criterion : criteria()) text += finding_text(info, criterion);
    if (info.validity.perturbation_advised())
        text += "First-order perturbation theory would do better: tau < lambda/2 and sigma0 < lambda/10.\n";
    return text + "Expected error of he against exact scattering: " + error_text(info.validity.error()) +
           "\n(where known: the map of hts truth moments, exact scattering by 1-D perfectly conducting "
           "surfaces up to 70 deg, unpolarised)\n";
}

Json finding_json(const MaterialInfo& info, Criterion criterion) {
    const Point& where = info.validity.worst(criterion);
    const Finding& finding = where.validity[criterion];
    const spectral::Limits limits = spectral::limits(criterion);
    return {{"criterion", name(criterion)},
            {"severity", name(finding.severity())},
            {"quantity", quantity(criterion)},
            {"measured", finding.measured},
            {"at", {{"wavelength_um", micrometres(where)}, {"theta_deg", degrees_of(info, where)}}},
            {"sense", limits.least() ? "at least" : "at most"},
            {"caution", limits.caution},
            {"outside", limits.outside},
            {"reason", finding.severity() == Severity::fine ? "" : reason(criterion)}};
}

Json error_json(const std::optional<spectral::Decibels>& known) {
    return known ? Json{known->least, known->most} : Json{};
}

}  // namespace

MaterialInfo::MaterialInfo(const spectral::Material& of, const spectral::WavelengthGrid& wavelengths,
                           std::vector<double> theta_deg, spectral::OutsideRange policy)
    : MaterialInfo{of, std::move(theta_deg),
                   of.at(wavelengths, {.tolerance = prepared_tolerance, .outside = policy})} {}

MaterialInfo::MaterialInfo(spectral::Material of, std::vector<double> theta_deg,
                           const spectral::Reflectance& prepared)
    : material{std::move(of)},
      surface{*prepared.properties().surface},
      theta{std::move(theta_deg)},
      validity{surface, prepared.samples(), directions(surface, theta)},
      prepared_bytes{prepared.bytes()},
      phi_table_bytes{hts::phi_table_bytes(prepared_tolerance)} {}

std::string info_text(const MaterialInfo& info) {
    const auto points = info.validity.points();
    const Range g = range_of(points, phase_variance);
    std::ostringstream text;
    text << info.material.name() << "\n  model        " << info.material.model_name() << " ("
         << info.material.model_source() << ")\n"
         << "  surface      " << surface_text(info.surface) << '\n'
         << roughness_text(info.surface, wavelengths_of(info)) << "  index        "
         << info.material.substance() << ": n " << range_of(points, n).text() << ", k "
         << range_of(points, k).text() << "; diffuse albedo " << range_of(points, albedo).text() << '\n'
         << "  wavelengths  " << range_of(points, micrometres).text() << " um, "
         << points.size() / info.theta.size() << " of them\n"
         << "  g            " << g.text() << ": " << joined(regimes(g)) << '\n'
         << "  memory       " << info.prepared_bytes << " bytes prepared at tolerance "
         << brief(prepared_tolerance.relative_error()) << ", and " << info.phi_table_bytes
         << " bytes of Phi that all materials share\n"
         << angles_text(info) << '\n'
         << (spectral::judged_by_distance(info.surface) ? distance_verdict(info) : criteria_text(info))
         << length_note(info.surface);
    text << distance_text(info);
    return text.str();
}

std::string info_json(const MaterialInfo& info) {
    const auto points = info.validity.points();
    const Surface& surface = info.surface;
    const Surface steepest = steepest_of(info);
    const Range g = range_of(points, phase_variance);
    Json findings = Json::array();
    const bool by_distance = spectral::judged_by_distance(info.surface);
    for (const Criterion criterion : criteria())
        if (!by_distance) findings.push_back(finding_json(info, criterion));
    auto severity = Severity::fine;
    for (const Point& point : points) severity = std::max(severity, judgement_at(info, point).severity);
    const Json wavelengths = wavelengths_of(info);
    Json result{{"name", info.material.name()},
                {"model", info.material.model_name()},
                {"limits_of_model", by_distance ? info.material.model_name() : std::string{judged_model}},
                {"rms_roughness_um", surface.rms_roughness()},
                {"correlation_length_um", length_json(surface)},
                {"rms_slope", spectral::rms_slope(steepest)},
                {"share_beyond_45_degrees", spectral::share_beyond_45_degrees(steepest)},
                {"curvature_radius_um", spectral::curvature_radius(steepest)},
                {"index", info.material.substance()},
                {"n", range_of(points, n).json()},
                {"k", range_of(points, k).json()},
                {"diffuse_albedo", range_of(points, albedo).json()},
                {"wavelengths_um", wavelengths},
                {"theta_deg", info.theta},
                {"phase_variance", g.json()},
                {"regimes", regimes(g)},
                {"mirror_share", range_of(points, mirror_share).json()},
                {"validity", name(severity)},
                {"findings", findings},
                {"perturbation_advised", !by_distance && info.validity.perturbation_advised()},
                {"expected_error_db",
                 error_json(by_distance ? unified_distances(info, points) : decibels(info.validity.error()))},
                {"expected_distance_db", distance_json(info)},
                {"prepared_bytes", info.prepared_bytes},
                {"phi_table_bytes", info.phi_table_bytes}};
    add_roughness(result, info.surface, wavelengths_of(info));
    if (!surface.isotropic()) {
        const auto slopes = spectral::rms_slopes(steepest);
        result["azimuth_deg"] = azimuth_in_degrees(surface);
        result["rms_slopes"] = {slopes.along, slopes.across};
    }
    return result.dump(1) + "\n";
}

void write_info_table(Output& output, const MaterialInfo& info) {
    TableWriter table{output,
                      Format::csv,
                      {"wavelength_um",
                       "theta_deg",
                       "n",
                       "k",
                       "diffuse_albedo",
                       "g",
                       "regime",
                       "mirror_share",
                       "tau_over_lambda",
                       "curvature",
                       "slope",
                       "shadowing",
                       "mirror_loss",
                       "energy",
                       "validity",
                       "least_error_db",
                       "most_error_db",
                       "studied",
                       "he_te_db",
                       "he_tm_db",
                       "he_db",
                       "he_unified_te_db",
                       "he_unified_tm_db",
                       "he_unified_db"}};
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::string text;
    for (const Point& point : info.validity.points()) {
        const double g = phase_variance(point);
        const spectral::Judgement judged = judgement_at(info, point);
        const auto error = judged.error.value_or(spectral::Decibels{nan, nan});
        TableWriter::Row row{table, text};
        row.field(shortest(micrometres(point))).field(shortest(degrees_of(info, point)));
        row.field(shortest(n(point))).field(shortest(k(point))).number(albedo(point));
        row.number(g).word(name(spectral::regime(g))).number(mirror_share(point));
        for (const Finding& finding : point.validity.findings) row.number(finding.measured);
        row.word(name(judged.severity)).number(error.least).number(error.most);
        add_distance(row, info, point);
        row.end();
    }
    table.add(text);
    table.finish();
}

}  // namespace hts::cli
