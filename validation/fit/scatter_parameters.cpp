#include "validation/fit/scatter_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "hts/error.hpp"
#include "spectral/statistics.hpp"
#include "validation/fit/least_squares.hpp"

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int views_a_side = 60;
constexpr double nearest = 1e-3, farthest_theta = 85;  // of beta from the mirror's; [deg]

constexpr double grazing = 0.5;  // of cos theta_i, below which cos theta_r is no law's

struct View {
    double x, cos_theta_r, log_brdf;
};

std::vector<View> views(const spectral::Reflectance& brdf, std::size_t wavelength, const Direction& in) {
    const double mirror = in.sin_theta(), edge = std::sin(farthest_theta * pi / 180);
    const double azimuth = std::atan2(in.sin_phi(), in.cos_phi()) + pi;
    std::vector<double> values(brdf.size());
    std::vector<View> result;
    for (const double side : {1.0, -1.0}) {
        const double most = edge - side * mirror;
        if (!(most > nearest)) continue;
        for (int i = 0; i < views_a_side; ++i) {
            const double x = nearest * std::pow(most / nearest, static_cast<double>(i) / (views_a_side - 1));
            const double beta = mirror + side * x, theta = std::asin(std::clamp(beta, -edge, edge));
            const Direction out = Direction::from_angles(std::abs(theta), theta < 0 ? azimuth + pi : azimuth);
            brdf.brdf({in, out}, values);
            const double f = values[wavelength];
            if (f > 1e-300) result.push_back({x, std::cos(theta), std::log(f)});
        }
    }
    if (result.size() < 8)
        throw Error{brdf.name() + ": reflects into " + std::to_string(result.size()) + " of " +
                    std::to_string(2 * views_a_side) +
                    " views in the plane of incidence: must be 8 at least to fit scatter parameters"};
    return result;
}

/// f0 and two numbers of shape: what all three have in common. ln f = log_f0 + shape(x).
struct Form {
    const char* name;
    double (*shape)(double x, double log_width, double power);
    Bounds power;
    std::array<double, 3> starts;
    bool smooth_law;  ///< whether the views' cosines are factors
};

double abg(double x, double log_width, double power) {
    return -std::log1p(std::exp(power * (std::log(x) - log_width)));
}
double power_of_square(double x, double log_width, double power) {
    return -power / 2 * std::log1p(std::exp(2 * (std::log(x) - log_width)));
}
constexpr std::array forms{Form{"abg", abg, {0.01, 20}, {1, 2, 4}, false},
                           Form{"harvey_shack", power_of_square, {0, 60}, {1, 2, 4}, false},
                           Form{"k_correlation", power_of_square, {0.01, 60}, {1, 2.5, 4}, true}};

struct Found {
    double log_f0, log_width, power;
    std::vector<double> residuals;
};

/// Least squares over logarithms; ln f0 is their mean for each shape.
Found fitted(const Form& form, const std::vector<View>& views) {
    const std::vector<Bounds> bounds{{std::log(1e-6), std::log(1e4)}, form.power};
    const auto residuals = [&](std::span<const double> x) {
        std::vector<double> result;
        double mean = 0;
        for (const View& view : views) {
            const double law = form.smooth_law ? std::log(view.cos_theta_r) : 0;
            result.push_back(form.shape(view.x, x[0], x[1]) + law - view.log_brdf);
            mean += result.back() / static_cast<double>(views.size());
        }
        for (double& each : result) each -= mean;
        result.push_back(mean);  // taken off below
        return result;
    };
    const Residuals linearised = [&](std::span<const double> x, bool with_jacobian) {
        Linearised result{residuals(x), {}};
        result.residuals.pop_back();
        for (std::size_t j = 0; with_jacobian && j < x.size(); ++j) {
            constexpr double step = 1e-5;
            std::vector<double> up{x.begin(), x.end()}, down = up;
            up[j] += step;
            down[j] -= step;
            const auto above = residuals(up), below = residuals(down);
            auto& column = result.jacobian.emplace_back();
            for (std::size_t i = 0; i < views.size(); ++i)
                column.push_back((above[i] - below[i]) / (2 * step));
        }
        return result;
    };
    std::optional<Minimum> best;
    for (const double width : {1e-3, 1e-2, 0.1, 0.5, 2.0}) {
        for (const double power : form.starts) {
            const Minimum minimum = local_minimum(linearised, {std::log(width), power}, bounds, {200, 1e-12});
            if (!best || minimum.cost < best->cost) best = minimum;
        }
    }
    auto left = residuals(best->x);
    const double mean = left.back();
    left.pop_back();
    return {-mean, best->x[0], best->x[1], std::move(left)};
}

std::vector<ScatterParameter> parameters(const Form& form, const Found& found, double wavelength,
                                         double cos_theta_i, double reflectance) {
    const double width = std::exp(found.log_width), most = std::exp(found.log_f0);
    if (!form.smooth_law && form.shape == abg) {
        const double b = std::pow(width, found.power);
        return {{"A", "1/sr", most * b}, {"B", "1", b}, {"g", "1", found.power}};
    }
    if (!form.smooth_law) return {{"b0", "1/sr", most}, {"l", "1", width}, {"s", "1", -found.power}};
    // `most` is what the law has at x = 0 but for cos theta_r
    const double a = most * std::pow(wavelength, 4) / (16 * pi * pi * cos_theta_i * reflectance);
    const double b = wavelength / width, s = found.power,
                 ends = std::log1p(b * b / (wavelength * wavelength));
    // integral of S2 2 pi f df up to 1/lambda; (1 - e^(-u t))/u is t at u = 0
    const double u = s / 2 - 1, part = std::abs(u) < 1e-9 ? ends : -std::expm1(-u * ends) / u;
    return {{"rms_roughness", "um", std::sqrt(pi * a * part) / b},
            {"B", "um", b},
            {"s", "1", s},
            {"A", "um^4", a},
            {"Q", "1", reflectance}};
}

}  // namespace

double ScatterFit::value(const std::string& parameter) const {
    const auto found = std::ranges::find(parameters, parameter, &ScatterParameter::name);
    if (found == parameters.end()) throw Error{model + ": no parameter " + parameter};
    return found->value;
}

std::vector<ScatterFit> scatter_fits(const spectral::Reflectance& brdf, std::size_t wavelength,
                                     const Direction& in, double reflectance) {
    const std::vector<View> seen = views(brdf, wavelength, in);
    if (reflectance <= 0) reflectance = brdf.albedo(in, wavelength).total();
    std::vector<ScatterFit> result;
    for (const Form& form : forms) {
        std::vector<View> used = seen;
        if (form.smooth_law)
            std::erase_if(used,
                          [&](const View& view) { return view.cos_theta_r < grazing * in.cos_theta(); });
        Found found = fitted(form, used);
        for (double& each : found.residuals) each = std::abs(each);
        result.push_back({form.name,
                          parameters(form, found, brdf.wavelengths().micrometres()[wavelength],
                                     in.cos_theta(), reflectance),
                          used.size(), spectral::median(found.residuals),
                          spectral::root_mean_square(found.residuals),
                          *std::ranges::max_element(found.residuals)});
    }
    return result;
}

}  // namespace hts::validation
