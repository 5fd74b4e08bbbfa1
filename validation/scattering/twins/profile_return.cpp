#include "validation/scattering/twins/profile_return.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

namespace hts::validation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t nodes = 32;
using Row = std::array<double, nodes>;

double node_angle(std::size_t i) {
    return pi * (static_cast<double>(i) + 0.5) / nodes;
}

/// y = 1/(1 + cot theta/alpha), 0 along the normal and 1 at the horizon.
double place_of(double theta, double alpha) {
    const double sine = std::sin(std::fabs(theta)) * alpha;
    return sine / (sine + std::cos(theta));
}

double angle_of(double place, double alpha) {
    return std::atan2(place, alpha * (1 - place));
}

/// Values at y of the polynomials that are 1 at one node and 0 at the others.
Row lagrange(double y) {
    Row weights{};
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) {
        double distance = 2 * y - 1 - std::cos(node_angle(j));
        if (std::fabs(distance) < 1e-15) distance = 1e-15;
        weights[j] = (j % 2 == 0 ? 1 : -1) * std::sin(node_angle(j)) / distance;
        sum += weights[j];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// Smith's Lambda of Gaussian slopes.
double lambda(double theta, double alpha) {
    const double c = std::cos(theta) / (alpha * std::sin(std::fabs(theta)));
    if (!(c < 30)) return 0;
    return (std::exp(-c * c) * std::numbers::inv_sqrtpi / c - std::erfc(c)) / 2;
}

template <class Function>
void for_gauss_nodes(double from, double to, int panels, const Function& f) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    for (int panel = 0; panel < panels; ++panel) {
        for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
            for (const int sign : {-1, 1})
                f(from + (to - from) * (panel + 0.5 * (1 + sign * Rule::abscissa()[i])) / panels,
                  0.5 * (to - from) * Rule::weights()[i] / panels);
        }
    }
}

/// The kernel for one angle of incidence: the integral of kernel times m is the sum of row times m at the
/// nodes. Over the facets' slopes, those whose reflected ray goes up.
Row kernel_row(double theta_i, double alpha) {
    Row row{};
    const double to_left = -std::tan(pi / 4 + theta_i / 2), to_right = std::tan(pi / 4 - theta_i / 2);
    constexpr double farthest = 6.5;  // of the slopes' width: the Gaussian is 4e-19 there
    const double from = std::max(to_left, -farthest * alpha), to = std::min(to_right, farthest * alpha);
    for_gauss_nodes(from, to, 4, [&](double slope, double weight) {
        const double theta_r = theta_i + 2 * std::atan(slope);
        const double density = std::exp(-slope * slope / (alpha * alpha)) * std::numbers::inv_sqrtpi / alpha;
        const double share = facet_lobe(density, theta_i, theta_r) * 2 / (1 + slope * slope) /
                             (1 + lambda(theta_i, alpha) + lambda(theta_r, alpha)) * weight;
        const Row at = lagrange(place_of(theta_r, alpha));
        for (std::size_t j = 0; j < nodes; ++j) row[j] += share * at[j];
    });
    return row;
}

double interpolated(const std::vector<double>& values, double y) {
    const Row at = lagrange(y);
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) sum += at[j] * values[j];
    return sum;
}

}  // namespace

double facet_lobe(double density, double theta_i, double theta_r) noexcept {
    const double cos_facet = std::cos((theta_r - theta_i) / 2);
    return density * std::cos((theta_r + theta_i) / 2) /
           (2 * cos_facet * cos_facet * cos_facet * std::cos(theta_i));
}

ProfileReturn::ProfileReturn(const RoughnessStatistics& surface)
    : alpha_{2 * surface.rms_roughness / surface.correlation_length}, values_(nodes, 1.0) {
    if (alpha_ == 0) return;
    std::array<Row, nodes> kernel{};
    std::vector<double> single(nodes, 0.0);
    for (std::size_t i = 0; i < nodes; ++i) {
        kernel[i] = kernel_row(angle_of((1 + std::cos(node_angle(i))) / 2, alpha_), alpha_);
        for (const double share : kernel[i]) single[i] += share;
    }
    for (int step = 0; step < 1000; ++step) {
        std::vector<double> next = values_;
        double change = 0;
        for (std::size_t i = 0; i < nodes; ++i) {
            double returned = 0;
            for (std::size_t j = 0; j < nodes; ++j) returned += kernel[i][j] * values_[j];
            returned *= values_[i];
            next[i] /= std::sqrt(returned);
            change = std::max(change, std::fabs(returned - 1));
        }
        values_ = next;
        if (change < 1e-12) break;
    }
    single_ = 0;
    for_gauss_nodes(0, pi / 2, 4, [&](double theta, double weight) {
        single_ += interpolated(single, place_of(theta, alpha_)) * std::cos(theta) * weight;
    });
}

double ProfileReturn::operator()(double theta) const noexcept {
    return alpha_ == 0 ? 1 : interpolated(values_, place_of(theta, alpha_));
}

}  // namespace hts::validation
