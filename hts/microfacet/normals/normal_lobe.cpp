#include "hts/microfacet/normals/normal_lobe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace hts {
namespace {

using std::numbers::pi;

/// Adaptive, to 1e-12 of the integral where rounding lets it.
template <class Function>
double integral(Function f, double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 21>::integrate(f, from, to, 12, 1e-12);
}

/// exp(-x^2) is below 1e-18 beyond.
constexpr double far = 6.5;

/// k N(k/d) + d N'(k/d): the mean of the positive part of a normal variable of mean k, deviation d.
double mean_of_positive_part(double k, double d) {
    if (!(d > 0)) return std::fmax(k, 0);
    const double z = k / d;
    return k * std::erfc(-z / std::numbers::sqrt2) / 2 + d * std::exp(-z * z / 2) / std::sqrt(2 * pi);
}

/// k^2/(a + s), 0 for k = 0 whatever a + s.
double over(double k, double a, double s) {
    return k == 0 ? 0 : k * k / (a + s);
}

}  // namespace

// Gaussian slopes

GaussianFacets::GaussianFacets(double sigma_x, double sigma_y, double tilt, double tops)
    : a_x_{1 / (sigma_x * sigma_x)},
      a_y_{1 / (sigma_y * sigma_y)},
      cos_tilt_{std::cos(tilt)},
      sin_tilt_{std::sin(tilt)},
      tops_{tops} {
    // s = x^2; (1 + q^2)^(-3/2) = 2/sqrt(pi) int sqrt(s) exp(-s(1 + q^2)) ds
    const auto weighted = [&](double x, double power) {
        const double s = x * x;
        return 2 * std::pow(x, power) * std::exp(-s) / std::sqrt((a_x_ + s) * (a_y_ + s));
    };
    const double area = 2 * std::sqrt(pi) * integral([&](double x) { return weighted(x, 2); }, 0, far);
    scale_ = 1 / area;
    mean_length_ = scale_ * pi * integral([&](double x) { return weighted(x, 3); }, 0, far);
}

Vector3 GaussianFacets::to_pole(Vector3 h) const noexcept {
    return {cos_tilt_ * h.x - sin_tilt_ * h.z, h.y, sin_tilt_ * h.x + cos_tilt_ * h.z};
}

Vector3 GaussianFacets::from_pole(Vector3 h) const noexcept {
    return {cos_tilt_ * h.x + sin_tilt_ * h.z, h.y, cos_tilt_ * h.z - sin_tilt_ * h.x};
}

Vector3 GaussianFacets::mean() const noexcept {
    return from_pole({0, 0, mean_length_});
}

double GaussianFacets::value(Vector3 h) const noexcept {
    const auto [x, y, z] = to_pole(h);
    return z > 0 ? scale_ * std::exp(-(a_x_ * x * x + a_y_ * y * y) / (z * z)) : 0;
}

double GaussianFacets::projected_area(Vector3 k) const {
    const auto [x, y, z] = to_pole(k);
    const auto slice = [&, x = x, y = y, z = z](double root) {
        const double s = root * root;
        const double deviation = std::sqrt((over(x, a_x_, s) + over(y, a_y_, s)) / 2);
        return 2 * root * s * std::exp(-s) / std::sqrt((a_x_ + s) * (a_y_ + s)) *
               mean_of_positive_part(z, deviation);
    };
    return scale_ * pi * integral(slice, 0, far);
}

// cos^(2a) theta with a(phi) = cos^2 phi/sigma_x^2 + sin^2 phi/sigma_y^2 integrates in closed form, and
// exp(-a tan^2 theta) <= cos^(2a) theta, with equality in the limits a -> 0 and a -> infinity.
Vector3 GaussianFacets::spread(double u, double v) const noexcept {
    const double b_x = 1 + 2 * a_x_, b_y = 1 + 2 * a_y_;
    const double c = std::sqrt(b_y) * std::cos(2 * pi * u), s = std::sqrt(b_x) * std::sin(2 * pi * u);
    const double squared = c * c + s * s;
    const double power = (b_x * c * c + b_y * s * s) / squared;
    const double tangent_squared = std::expm1(-2 * std::log1p(-v) / power);
    const double z = 1 / std::sqrt(1 + tangent_squared);
    const double radius = std::sqrt(tangent_squared / squared) * z;
    return from_pole({radius * c, radius * s, z});
}

double GaussianFacets::spread_density(Vector3 h) const noexcept {
    const auto [x, y, z] = to_pole(h);
    if (!(z > 0)) return 0;
    const double level = std::sqrt((1 + 2 * a_x_) * (1 + 2 * a_y_)) / (2 * pi);
    const double radius_squared = x * x + y * y;
    if (radius_squared == 0) return level;
    const double a = (a_x_ * x * x + a_y_ * y * y) / radius_squared;
    return level * std::exp(-a * std::log1p(radius_squared / (z * z)));
}

// Upright fibres

UprightFibres::UprightFibres(double sigma) : a_{1 / (sigma * sigma)}, kappa_{1 + 2 * a_ / 3} {
    const auto over_z = [&](double z) { return value({std::sqrt((1 - z) * (1 + z)), 0, z}); };
    scale_ = 1 / (2 * pi * integral(over_z, 0, 1));
    mean_z_ = 2 * pi * integral([&](double z) { return z * over_z(z); }, 0, 1);
}

double UprightFibres::value(Vector3 h) const noexcept {
    if (!(h.z > 0)) return 0;
    const double sine_squared = h.x * h.x + h.y * h.y;
    if (a_ == 0) return scale_;
    return scale_ * std::exp(-a_ * h.z * h.z / sine_squared);
}

double UprightFibres::projected_area(Vector3 k) const {
    // over the azimuth in closed form: B + A cos phi, positive up to phi_0
    const double horizontal = std::hypot(k.x, k.y);
    const auto ring = [&](double z) {
        const double sine = std::sqrt((1 - z) * (1 + z));
        const double a = sine * horizontal, b = z * k.z;
        const double p = value({sine, 0, z});
        if (b >= a) return p * 2 * pi * b;
        if (b <= -a) return 0.0;
        return p * 2 * (b * std::acos(-b / a) + std::sqrt((a - b) * (a + b)));
    };
    const double bend = std::fmin(horizontal, 1);  // where rings begin to be turned away in part
    return integral(ring, 0, bend) + integral(ring, bend, 1);
}

// With y = cot theta: exp(-y^2/sigma^2) (1 + y^2)^(-3/2) <= (1 + kappa y^2)^(-3/2),
// kappa = 1 + 2/(3 sigma^2).
Vector3 UprightFibres::spread(double u, double v) const noexcept {
    const double ratio = v * v / (kappa_ * (1 - v) * (1 + v));  // cot^2 theta
    const double sine = 1 / std::sqrt(1 + ratio);
    return {sine * std::cos(2 * pi * u), sine * std::sin(2 * pi * u), std::sqrt(ratio) * sine};
}

double UprightFibres::spread_density(Vector3 h) const noexcept {
    if (!(h.z > 0)) return 0;
    const double bracket = 1 + (kappa_ - 1) * h.z * h.z;
    return std::sqrt(kappa_) / (2 * pi * bracket * std::sqrt(bracket));
}

// Samples

void SampledFacets::normalise(std::size_t per_side_u, std::size_t per_side_v) {
    double sum = 0;
    for (std::size_t i = 0; i < per_side_u; ++i) {
        for (std::size_t j = 0; j < per_side_v; ++j) {
            const Vector3 h = spread((static_cast<double>(i) + 0.5) / static_cast<double>(per_side_u),
                                     (static_cast<double>(j) + 0.5) / static_cast<double>(per_side_v));
            const double weight = value(h) / spread_density(h);
            if (!(weight > 0)) continue;
            points_.push_back({h, weight});
            sum += weight;
        }
    }
    if (!(sum > 0)) return;
    for (auto& point : points_) {
        point.weight /= sum;
        mean_ = mean_ + point.weight * point.normal;
    }
    scale_ = static_cast<double>(per_side_u * per_side_v) / sum;
}

double SampledFacets::projected_area(Vector3 k) const {
    double sum = 0;
    for (const auto& point : points_) sum += point.weight * std::fmax(dot(point.normal, k), 0);
    return sum;
}

// A table over (theta, phi)

TabulatedFacets::TabulatedFacets(ValueGrid grid) : grid_{std::move(grid)} {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < grid_.rows; ++i) {
        for (std::size_t j = 0; j < grid_.columns; ++j) {
            const double corners = at(i, j) + at(i, j + 1) + at(i + 1, j) + at(i + 1, j + 1);
            sum += corners * (cosine(i) - cosine(i + 1));
            sums_.push_back(sum);
        }
    }
    for (double& partial : sums_) partial /= sum;
    const auto points = [](std::size_t cells) { return cells * std::max<std::size_t>(2, 192 / cells + 1); };
    normalise(points(grid_.columns), points(grid_.rows - 1));
}

double TabulatedFacets::at(std::size_t i, std::size_t j) const noexcept {
    return grid_.values[i * grid_.columns + j % grid_.columns];
}

double TabulatedFacets::cosine(std::size_t row) const noexcept {
    return row + 1 == grid_.rows
               ? 0
               : std::cos(pi / 2 * static_cast<double>(row) / static_cast<double>(grid_.rows - 1));
}

double TabulatedFacets::value(Vector3 h) const noexcept {
    if (!(h.z > 0)) return 0;
    const double turn = std::atan2(h.y, h.x) / (2 * pi);
    const double down = std::atan2(std::hypot(h.x, h.y), h.z) * 2 / pi * static_cast<double>(grid_.rows - 1);
    const double along = (turn < 0 ? turn + 1 : turn) * static_cast<double>(grid_.columns);
    const auto i = std::min(static_cast<std::size_t>(down), grid_.rows - 2);
    const auto j = std::min(static_cast<std::size_t>(along), grid_.columns - 1);
    return scale_ * std::lerp(std::lerp(at(i, j), at(i, j + 1), along - static_cast<double>(j)),
                              std::lerp(at(i + 1, j), at(i + 1, j + 1), along - static_cast<double>(j)),
                              down - static_cast<double>(i));
}

Vector3 TabulatedFacets::spread(double u, double v) const noexcept {
    const double sine = std::sin(pi / 2 * v);
    return {sine * std::cos(2 * pi * u), sine * std::sin(2 * pi * u), std::cos(pi / 2 * v)};
}

double TabulatedFacets::spread_density(Vector3 h) const noexcept {
    return h.z > 0 ? 1 / (pi * pi * std::hypot(h.x, h.y)) : 0;
}

Vector3 TabulatedFacets::draw(const Uniforms& u) const noexcept {
    const auto cell =
        static_cast<std::size_t>(std::upper_bound(sums_.begin(), sums_.end() - 1, u[0]) - sums_.begin());
    const std::size_t i = cell / grid_.columns, j = cell % grid_.columns;
    const double z = std::lerp(cosine(i), cosine(i + 1), u[1]);
    const double phi = 2 * pi * (static_cast<double>(j) + u[2]) / static_cast<double>(grid_.columns);
    const double sine = std::sqrt((1 - z) * (1 + z));
    return {sine * std::cos(phi), sine * std::sin(phi), z};
}

double TabulatedFacets::draw_density(Vector3 h) const noexcept {
    if (!(h.z > 0)) return 0;
    const double turn = std::atan2(h.y, h.x) / (2 * pi);
    const double down = std::atan2(std::hypot(h.x, h.y), h.z) * 2 / pi * static_cast<double>(grid_.rows - 1);
    const auto i = std::min(static_cast<std::size_t>(down), grid_.rows - 2);
    const auto j =
        std::min(static_cast<std::size_t>((turn < 0 ? turn + 1 : turn) * static_cast<double>(grid_.columns)),
                 grid_.columns - 1);
    const std::size_t cell = i * grid_.columns + j;
    const double mass = sums_[cell] - (cell == 0 ? 0 : sums_[cell - 1]);
    return mass * static_cast<double>(grid_.columns) / (2 * pi * (cosine(i) - cosine(i + 1)));
}

bool TabulatedFacets::mirror_y() const noexcept {
    for (std::size_t i = 0; i < grid_.rows; ++i) {
        for (std::size_t j = 0; j < grid_.columns; ++j) {
            if (at(i, j) != at(i, grid_.columns - j)) return false;
        }
    }
    return true;
}

bool TabulatedFacets::mirror_x() const noexcept {
    if (grid_.columns % 2 != 0) return grid_.columns == 1;
    for (std::size_t i = 0; i < grid_.rows; ++i) {
        for (std::size_t j = 0; j < grid_.columns; ++j) {
            if (at(i, j) != at(i, grid_.columns + grid_.columns / 2 - j)) return false;
        }
    }
    return true;
}

// A picture

PicturedFacets::PicturedFacets(GaussianFacets facets, ValueGrid pixels, double extent)
    : facets_{std::move(facets)}, pixels_{std::move(pixels)}, extent_{extent} {
    const std::size_t per_side = std::max<std::size_t>(192, 2 * std::max(pixels_.rows, pixels_.columns));
    normalise(per_side, per_side);
}

double PicturedFacets::value(Vector3 h) const noexcept {
    return scale_ * facets_.value(h) * pixel(h);
}

double PicturedFacets::pixel(Vector3 h) const noexcept {
    if (!(std::fabs(h.x) <= extent_ && std::fabs(h.y) <= extent_)) return 0;
    const auto position = [](double share, std::size_t count) {
        return std::clamp(share * static_cast<double>(count) - 0.5, 0.0, static_cast<double>(count - 1));
    };
    const double across = position((h.x / extent_ + 1) / 2, pixels_.columns);
    const double down = position((1 - h.y / extent_) / 2, pixels_.rows);
    const auto i = static_cast<std::size_t>(down), j = static_cast<std::size_t>(across);
    const auto at = [&](std::size_t row, std::size_t column) {
        return pixels_.values[std::min(row, pixels_.rows - 1) * pixels_.columns +
                              std::min(column, pixels_.columns - 1)];
    };
    const double fraction = across - static_cast<double>(j);
    return std::lerp(std::lerp(at(i, j), at(i, j + 1), fraction),
                     std::lerp(at(i + 1, j), at(i + 1, j + 1), fraction), down - static_cast<double>(i));
}

}  // namespace hts
