#include "validation/curves/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "hts/error.hpp"
#include "hts/wavelength.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

constexpr auto polar_range = "0 ... 90 deg";

void require(bool legal, std::string_view quantity, double value, std::string_view unit,
             std::string_view range) {
    if (!legal) throw out_of_range(quantity, value, unit, range);
}

void check_angles(const CurvePoint& point) {
    const auto polar = [](std::string_view quantity, double angle) {
        require(angle >= 0 && angle <= 90, quantity, angle, "deg", polar_range);
    };
    polar("theta_i", point.theta_i);
    polar("theta_r", point.theta_r);
    require(std::isfinite(point.phi_i), "phi_i", point.phi_i, "deg", "a finite number");
    require(std::isfinite(point.phi_r), "phi_r", point.phi_r, "deg", "a finite number");
}

/// Checks of one point, given whether the set has uncertainties and a noise floor.
void check_point(const Curve& curve, const CurvePoint& point, bool uncertain, bool noisy) {
    check_angles(point);
    require(std::isfinite(point.value) && (noisy || point.value >= 0), "value", point.value, "",
            noisy ? "a finite number" : ">= 0, unless \"noise_floor\" is stated");
    const double u = point.uncertainty;
    if (uncertain) require(std::isfinite(u) && u > 0, "uncertainty", u, "", "> 0");
    if (!uncertain) require(u == 0, "uncertainty", u, "", "0 where the set does not say what it rests on");
    if (curve.sweep == Sweep::scattered) return;
    const CurvePoint flat =
        in_plane_point(curve.sweep, curve.fixed_angle(), curve.swept_angle(point), point.value, u);
    const auto angles = [](const CurvePoint& p) { return std::tie(p.theta_i, p.phi_i, p.theta_r, p.phi_r); };
    if (angles(flat) != angles(point)) {
        throw Error{"directions that leave the plane of incidence: must be a curve of scattered pairs"};
    }
}

void check_curve(const Curve& curve, const std::string& place, bool uncertain, bool noisy) {
    spectral::located(place, [&] {
        require(curve.band.first >= shortest_length, "wavelength", curve.band.first, "um", "> 0");
        require(curve.band.last >= curve.band.first && curve.band.last <= longest_length, "end of the band",
                curve.band.last, "um", "at least its beginning");
        if (curve.points.empty()) throw Error{"no points: must be at least one"};
    });
    std::set<std::tuple<double, double, double, double>> seen;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const CurvePoint& p = curve.points[i];
        spectral::located(place + ": row " + std::to_string(i + 1), [&] {
            check_point(curve, p, uncertain, noisy);
            if (!seen.emplace(p.theta_i, p.phi_i, p.theta_r, p.phi_r).second) {
                throw Error{"the same directions as in an earlier row: must stand once"};
            }
        });
    }
}

void check_texts(const CurveSet& set) {
    const auto given = [](const char* key, const std::string& text) {
        if (spectral::trimmed(text).empty())
            throw Error{"key " + spectral::in_quotes(key) + ": must not be empty"};
    };
    given("surface", set.surface);
    given("by", set.by);
    given("source", set.source);
    given("licence", set.licence);
    given("how", set.how);
}

/// Reflectances into all directions have no angle of view.
void check_views(const CurveSet& set) {
    if (set.quantity != Quantity::hemispherical_reflectance) return;
    for (const Curve& curve : set.curves) {
        if (curve.sweep != Sweep::incident || curve.fixed_angle() != 0 || set.scale != Scale::absolute)
            throw Error{"hemispherical_reflectance: must be absolute, in curves with \"theta_r_deg\" 0"};
    }
}

void check_instrument(const CurveSet& set) {
    const auto cone = [](const char* key, const std::optional<double>& solid_angle) {
        const double sr = solid_angle.value_or(1);
        require(sr > 0 && sr <= 2 * std::numbers::pi, key, sr, "sr", "> 0 and at most 2 pi sr");
    };
    cone("source_solid_angle_sr", set.source_solid_angle);
    cone("detector_solid_angle_sr", set.detector_solid_angle);
    const double rms = set.roughness ? set.roughness->rms_um : 1;
    require(rms >= 0 && rms <= longest_length, "rms_roughness_um", rms, "um", ">= 0");
    const double floor = set.noise_floor.value_or(1);
    require(std::isfinite(floor) && floor > 0, "noise_floor", floor, unit(set.quantity), "> 0");
}

}  // namespace

const char* name(CurveKind kind) noexcept {
    constexpr std::array names{"measured", "digitised", "theory"};
    return names[static_cast<std::size_t>(kind)];
}

const char* name(Quantity quantity) noexcept {
    constexpr std::array names{"brdf", "brdf_cosine", "reflectance_factor", "hemispherical_reflectance"};
    return names[static_cast<std::size_t>(quantity)];
}

const char* name(Scale scale) noexcept {
    constexpr std::array names{"absolute", "specular", "unknown"};
    return names[static_cast<std::size_t>(scale)];
}

const char* unit(Quantity quantity) noexcept {
    return quantity == Quantity::brdf || quantity == Quantity::brdf_cosine ? "1/sr" : "1";
}

DirectionPair CurvePoint::pair() const {
    return {Direction::from_degrees(theta_i, phi_i), Direction::from_degrees(theta_r, phi_r)};
}

double CurvePoint::side() const noexcept {
    return std::cos((phi_r - phi_i) * std::numbers::pi / 180) > 0 ? -1 : 1;
}

CurvePoint in_plane_point(Sweep sweep, double fixed, double swept, double value,
                          double uncertainty) noexcept {
    const double phi_r = swept < 0 ? 0 : 180, moving = std::abs(swept);
    if (sweep == Sweep::incident) return {moving, 0, fixed, phi_r, value, uncertainty};
    return {fixed, 0, moving, phi_r, value, uncertainty};
}

double Curve::fixed_angle() const noexcept {
    if (sweep == Sweep::scattered || points.empty()) return 0;
    return sweep == Sweep::incident ? points.front().theta_r : points.front().theta_i;
}

double Curve::swept_angle(const CurvePoint& point) const noexcept {
    return point.side() * (sweep == Sweep::incident ? point.theta_i : point.theta_r);
}

std::size_t CurveSet::point_count() const noexcept {
    std::size_t count = 0;
    for (const Curve& curve : curves) count += curve.points.size();
    return count;
}

std::optional<double> log_ratio(double model, double measured, double noise_floor) noexcept {
    if (noise_floor > 0)
        return std::asinh(model / (2 * noise_floor)) - std::asinh(measured / (2 * noise_floor));
    if (model > 0 && measured > 0) return std::log(model / measured);
    return std::nullopt;
}

CurveSet checked(CurveSet set, const std::string& place) {
    spectral::located(place, [&] {
        check_texts(set);
        check_instrument(set);
        if (set.curves.empty()) throw Error{"key \"curves\": must have at least one curve"};
        for (std::size_t i = 0; i < set.curves.size(); ++i) {
            check_curve(set.curves[i], "key \"curves[" + std::to_string(i + 1) + "].points\"",
                        !set.uncertainty.empty(), set.noise_floor.has_value());
        }
        check_views(set);
    });
    return set;
}

}  // namespace hts::validation
