#include "validation/curves/reciprocity.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "spectral/statistics.hpp"

namespace hts::validation {
namespace {

/// Angles in units of 1e-6 deg, so that they compare as written.
long long key(double degrees) {
    return std::llround(degrees * 1e6);
}

long long turn(const CurvePoint& p) {
    return key(std::abs(std::remainder(p.phi_r - p.phi_i, 360)));
}

using Geometry = std::tuple<double, double, long long, long long, long long>;

/// The BRDF of a value, up to a factor that all share.
double brdf(const CurvePoint& p, Quantity quantity) {
    return quantity == Quantity::brdf_cosine ? p.value / std::cos(p.theta_r * std::numbers::pi / 180)
                                             : p.value;
}

}  // namespace

double Reciprocity::relative_uncertainty() const noexcept {
    constexpr double quartile_of_normal = 0.6744897501960817;
    return median_abs_log / (quartile_of_normal * std::numbers::sqrt2);
}

Reciprocity reciprocity(const CurveSet& set) {
    std::map<Geometry, const CurvePoint*> seen;
    Reciprocity result;
    std::vector<double> logs;
    if (set.scale == Scale::specular || set.quantity == Quantity::hemispherical_reflectance) return result;
    for (const Curve& curve : set.curves) {
        for (const CurvePoint& p : curve.points) {
            if (!(p.value > 0)) continue;
            const auto [first, last] = curve.band;
            const long long theta_i = key(p.theta_i), theta_r = key(p.theta_r);
            const auto partner = seen.find({first, last, theta_r, theta_i, turn(p)});
            seen.emplace(Geometry{first, last, theta_i, theta_r, turn(p)}, &p);
            if (partner == seen.end() || theta_i == theta_r) continue;
            const double log_ratio = std::log(brdf(*partner->second, set.quantity) / brdf(p, set.quantity));
            if (logs.empty() || std::abs(log_ratio) > std::abs(result.worst.log_ratio))
                result.worst = {*partner->second, p, log_ratio};
            logs.push_back(log_ratio);
        }
    }
    result.pairs = logs.size();
    result.rms_log = spectral::root_mean_square(logs);
    for (double& x : logs) x = std::abs(x);
    result.median_abs_log = spectral::median(std::move(logs));
    return result;
}

}  // namespace hts::validation
