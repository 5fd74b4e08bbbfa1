// The parameters that come closest to measured points, or to another lobe.

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include "engine.hpp"
#include "hts/error.hpp"
#include "hts/he_torrance_gradient.hpp"

namespace hts::page {
namespace {

constexpr std::size_t columns = 5;  // theta_i, theta_r, phi_r [deg], wavelength [um], BRDF [1/sr]

struct Point {
    Direction in, out;
    SpectralSample sample;
    double measured;
};

// Points that the model can be compared with by logarithms.
std::vector<Point> points_of(const json& request, const Numbers& numbers) {
    const std::size_t count = numbers.in.size() / columns;
    numbers.require(columns * count, 0);
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = numbers.in.subspan(columns * i, columns);
        if (!(row[4] > 0)) continue;
        json one = request;
        one["wavelengths"] = {row[3]};
        const auto& brdf = reflectance_of(one);
        if (!brdf.properties().surface || brdf.properties().surface->unified())
            throw Error{brdf.name() +
                        ": is fitted by the model he alone here; the command hts fit fits the others"};
        if (brdf.samples()[0].index.coated())
            throw Error{brdf.name() + ": must be without films to be fitted here"};
        points.push_back({Direction::from_degrees(row[0], 0), Direction::from_degrees(row[1], row[2]),
                          brdf.samples()[0], row[4]});
    }
    return points;
}

// ln(model/measured) over ln sigma_0, ln tau and, where it is free, the logit of the albedo.
struct Residuals {
    const std::vector<Point>& points;
    bool with_albedo;
    double albedo;

    using Vector = Eigen::VectorXd;
    [[nodiscard]] int inputs() const { return with_albedo ? 3 : 2; }
    [[nodiscard]] int values() const { return static_cast<int>(points.size()); }
    [[nodiscard]] double albedo_of(const Vector& x) const {
        return with_albedo ? 1 / (1 + std::exp(-x[2])) : albedo;
    }

    // Surfaces beyond what a search may meet count as infinitely bad.
    template <class Use>
    int each(const Vector& x, const Use& use) const {
        if (!(std::abs(x[0]) < 14 && std::abs(x[1]) < 14)) return -1;
        const Surface surface{std::exp(x[0]), std::exp(x[1])};
        const double diffuse = uniform_diffuse(albedo_of(x));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point& p = points[i];
            const PairGradient pair{surface, view_gradient(surface, p.in), view_gradient(surface, p.out)};
            const auto f = brdf_gradient(pair, p.sample.wavelength, p.sample.index.substrate(), diffuse);
            use(static_cast<Eigen::Index>(i), p, f, std::fmax(f.value, 1e-300));
        }
        return 0;
    }
    int operator()(const Vector& x, Vector& r) const {
        return each(x, [&](Eigen::Index i, const Point& p, const BrdfGradient&, double value) {
            r[i] = std::log(value / p.measured);
        });
    }
    int df(const Vector& x, Eigen::MatrixXd& jacobian) const {
        return each(x, [&](Eigen::Index i, const Point&, const BrdfGradient& f, double value) {
            jacobian(i, 0) = f.by.rms_roughness * std::exp(x[0]) / value;
            jacobian(i, 1) = f.by.correlation_length * std::exp(x[1]) / value;
            if (!with_albedo) return;
            const double a = albedo_of(x);
            jacobian(i, 2) = f.by.diffuse_albedo * a * (1 - a) / value;
        });
    }
};

struct Found {
    double squares = std::numeric_limits<double>::infinity();
    Eigen::VectorXd x;
    long steps = 0;
};

Found found_from(const Residuals& residuals, Eigen::VectorXd x) {
    Residuals functor = residuals;
    Eigen::LevenbergMarquardt<Residuals> search{functor};
    search.parameters.maxfev = 120;
    search.parameters.xtol = search.parameters.ftol = 1e-10;
    search.minimize(x);
    Eigen::VectorXd r(residuals.values());
    if (residuals(x, r) != 0 || !r.allFinite()) return {};
    return {r.squaredNorm(), x, static_cast<long>(search.nfev)};
}

// From the surface of the page, and from rough and smooth, steep and gentle ones.
Found nearest(const Residuals& residuals, const Surface& now, double wavelength) {
    const auto start = [&](double sigma, double tau) {
        Eigen::VectorXd x(residuals.inputs());
        x[0] = std::log(sigma);
        x[1] = std::log(tau);
        if (residuals.with_albedo) x[2] = -3;
        return x;
    };
    Found best = found_from(residuals, start(std::fmax(now.rms_roughness(), 1e-4), now.correlation_length()));
    for (const double sigma : {0.05, 0.2, 1.0})
        for (const double slope : {0.03, 0.1, 0.3}) {
            const Found other = found_from(residuals, start(sigma * wavelength, sigma * wavelength / slope));
            if (other.squares < best.squares * (1 - 1e-9)) best = other;
        }
    return best;
}

// Standard errors of linearised least squares, by the residuals' own scatter.
Eigen::VectorXd errors_of(const Residuals& residuals, const Found& found) {
    Eigen::MatrixXd jacobian(residuals.values(), residuals.inputs());
    residuals.df(found.x, jacobian);
    const double freedom = std::fmax(1, residuals.values() - residuals.inputs());
    const Eigen::MatrixXd covariance =
        (jacobian.transpose() * jacobian).completeOrthogonalDecomposition().pseudoInverse();
    return (covariance.diagonal() * (found.squares / freedom)).cwiseMax(0).cwiseSqrt();
}

}  // namespace

json fit(const json& request, const Numbers& numbers) {
    const auto points = points_of(request, numbers);
    const bool with_albedo = request.value("albedo", false);
    const std::size_t least = with_albedo ? 4 : 3;
    if (points.size() < least)
        throw Error{"points with a BRDF above 0: " + std::to_string(points.size()) + ": must be at least " +
                    std::to_string(least)};
    const auto& surface = *reflectance_of(request).properties().surface;
    const Residuals residuals{points, with_albedo, request.at("material").value("diffuse_albedo", 0.0)};
    const Found best = nearest(residuals, surface, points[0].sample.wavelength.micrometres());
    if (!std::isfinite(best.squares)) throw Error{"no surface was found whose BRDF is near to the points"};
    const auto errors = errors_of(residuals, best);
    json result{
        {"rms_roughness_um", std::exp(best.x[0])},
        {"correlation_length_um", std::exp(best.x[1])},
        {"diffuse_albedo", residuals.albedo_of(best.x)},
        {"relative_errors", {errors[0], errors[1]}},
        {"points", points.size()},
        {"rms_db", 10 / std::numbers::ln10 * std::sqrt(best.squares / static_cast<double>(points.size()))}};
    return result;
}

json match(const json& request) {
    const auto& brdf = reflectance_of(request);
    const Direction in = Direction::from_degrees(request.at("theta_i_deg"), 0);
    std::vector<Direction> views;
    std::vector<double> lobe, weights;
    for (double theta = 2; theta < 88; theta += 4)
        for (double phi = 0; phi <= 180; phi += 12) {
            const Direction out = Direction::from_degrees(theta, phi);
            views.push_back(out);
            lobe.push_back(brdf.directional_diffuse({in, out})[0]);
            weights.push_back(out.sin_theta() * out.cos_theta() * out.cos_theta());
        }
    json beside = request.at("beside");
    const auto reflectance = [&](double width) {
        for (const auto& key : request.at("keys")) beside[json::json_pointer{key.get<std::string>()}] = width;
        for (const auto& key : request.at("exponents"))
            beside[json::json_pointer{key.get<std::string>()}] = 2 / (width * width);
        return spectral::material_from_text(beside.dump(), "/beside.json").at(brdf.wavelengths());
    };
    const auto distance = [&](double log_width) {
        const auto other = reflectance(std::exp(log_width));
        double sum = 0, all = 0;
        for (std::size_t i = 0; i < views.size(); ++i) {
            sum += weights[i] * std::pow(other.directional_diffuse({in, views[i]})[0] - lobe[i], 2);
            all += weights[i] * lobe[i] * lobe[i];
        }
        return all > 0 ? std::sqrt(sum / all) : 1;
    };
    // a grid, then golden section about its best
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (double x = -5; x <= 0.6; x += 0.2)
        if (const double d = distance(x); d < least) {
            least = d;
            best = x;
        }
    double low = best - 0.2, high = best + 0.2;
    for (int i = 0; i < 20; ++i) {
        const double a = high - (high - low) / std::numbers::phi, b = low + (high - low) / std::numbers::phi;
        distance(a) < distance(b) ? high = b : low = a;
    }
    const double middle = (low + high) / 2, near = distance(middle);
    return {{"width", std::exp(middle)}, {"distance", near}, {"material", beside}};
}

}  // namespace hts::page
