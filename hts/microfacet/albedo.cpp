#include "hts/microfacet/albedo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace hts {
namespace {

constexpr double pi = std::numbers::pi;

/// Of Gauss and Kronrod's estimate over the error: it is hundreds of times the error
/// where the BRDF is smooth.
constexpr double caution = 10;

/// Bounds the time where a tolerance cannot be met.
constexpr std::size_t most_panels = 400;

struct Panel {
    double from, to, value, error;

    [[nodiscard]] friend bool operator<(const Panel& a, const Panel& b) noexcept { return a.error < b.error; }
};

template <class Function>
Panel panel(const Function& f, double from, double to) {
    double error = 0;
    const double value =
        boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, from, to, 0, 0, &error);
    return {from, to, value, error};
}

/// Integral over the panels between neighbouring ends; that of the largest error is halved until the errors
/// together are below `relative` times the sum.
template <class Function>
double adaptive_integral(const Function& f, const std::vector<double>& ends, double relative) {
    std::vector<Panel> panels;
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (ends[i] > ends[i - 1]) panels.push_back(panel(f, ends[i - 1], ends[i]));
    }
    const auto total = [&](double Panel::*what) {
        double sum = 0;
        for (const Panel& p : panels) sum += p.*what;
        return sum;
    };
    std::make_heap(panels.begin(), panels.end());
    while (panels.size() < most_panels && total(&Panel::error) > relative * std::abs(total(&Panel::value))) {
        std::pop_heap(panels.begin(), panels.end());
        const Panel worst = panels.back();
        const double middle = (worst.from + worst.to) / 2;
        panels.back() = panel(f, worst.from, middle);
        std::push_heap(panels.begin(), panels.end());
        panels.push_back(panel(f, middle, worst.to));
        std::push_heap(panels.begin(), panels.end());
    }
    return total(&Panel::value);
}

/// The facets whose normals have one azimuth, as seen from `in`.
class Meridian {
  public:
    Meridian(const Direction& in, double phi) noexcept
        : in_{in},
          cos_phi_{std::cos(phi)},
          sin_phi_{std::sin(phi)},
          toward_{in.sin_theta() * (in.cos_phi() * cos_phi_ + in.sin_phi() * sin_phi_)},
          delta_{std::atan2(toward_, in.cos_theta())} {}

    /// theta_h where `out` sinks below the horizon.
    [[nodiscard]] double horizon() const noexcept { return pi / 4 + delta_ / 2; }
    /// theta_h where theta_out = theta_in, besides 0; may be negative.
    [[nodiscard]] double equal_angles() const noexcept { return delta_; }

    /// f cos theta_out |domega_out/dtheta_h dphi_h|.
    [[nodiscard]] double integrand(const OutgoingBrdf& brdf, double theta) const {
        const double sine = std::sin(theta);
        const double in_h = toward_ * sine + in_.cos_theta() * std::cos(theta);
        const double cosine = std::hypot(toward_, in_.cos_theta()) * std::cos(2 * theta - delta_);
        if (!(cosine > 0 && in_h > 0)) return 0;
        const Vector3 towards_in = in_.vector();
        const double x = 2 * in_h * sine * cos_phi_ - towards_in.x;
        const double y = 2 * in_h * sine * sin_phi_ - towards_in.y;
        const Direction out = Direction::from_vector({x, y, cosine});
        return brdf(out) * out.cos_theta() * 4 * in_h * sine;
    }

  private:
    Direction in_;
    double cos_phi_, sin_phi_;
    double toward_;  // sin theta_in cos(phi_h - phi_in)
    double delta_;
};

/// 0, ends that shrink towards it by factors of 4, the horizon, and cuts between.
std::vector<double> polar_ends(double horizon, double theta_in, double equal_angles) {
    std::vector<double> ends{0, horizon};
    for (int i = 1; i <= 13; ++i) ends.push_back(std::ldexp(horizon, -2 * i));
    for (const double cut : {theta_in, equal_angles}) {
        if (cut > 0 && cut < horizon) ends.push_back(cut);
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

/// A full turn, cut along the axes of the surface and of the plane of incidence.
std::vector<double> azimuth_ends(double phi_in) {
    std::vector<double> ends{2 * pi};
    for (int quarter = 0; quarter < 4; ++quarter) {
        ends.push_back(quarter * pi / 2);
        ends.push_back(std::fmod(phi_in + (quarter + 4) * pi / 2, 2 * pi));
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

}  // namespace

double directional_albedo(const OutgoingBrdf& brdf, const Direction& in, Tolerance tolerance) {
    if (!(in.cos_theta() > 0)) return 0;
    const double theta_in = std::atan2(in.sin_theta(), in.cos_theta());
    const double estimate = caution * std::max(tolerance.relative_error(), accuracy::directional_albedo);
    const auto along = [&](double phi) {
        const Meridian meridian{in, phi};
        const auto ends = polar_ends(meridian.horizon(), theta_in, meridian.equal_angles());
        return adaptive_integral([&](double theta) { return meridian.integrand(brdf, theta); }, ends,
                                 estimate / 10);
    };
    return adaptive_integral(along, azimuth_ends(std::atan2(in.sin_phi(), in.cos_phi())), estimate);
}

}  // namespace hts
