#include "spectral/energy/lobe_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "hts/roughness.hpp"

namespace hts::spectral {
namespace {

double square(double x) {
    return x * x;
}

/// The way from the mirror direction to the horizon, in the disc of direction cosines.
struct Ray {
    double cosine, sine;  ///< of its angle, 0 outwards in the plane of incidence
    double length;        ///< to the horizon
    double beyond;        ///< from the mirror direction to the horizon behind
    double stretch;       ///< sqrt(t) over distance along it, beside that of an isotropic surface
    double width;         ///< w
    double range;         ///< U, u at the horizon
    double weight;        ///< dangle/dx, of both halves of the disc where they are alike
};

/// The disc about the mirror direction of one incident direction, in the coordinates of the header.
class MirrorDisc {
  public:
    MirrorDisc(const Surface& surface, const Direction& in, const Wavelength& wavelength,
               const ReflectedLight::Lobe& lobe)
        : surface_{surface},
          in_{in},
          lobe_{lobe},
          smooth_{surface.rms_roughness() == 0},
          sine_{in.sin_theta()},
          cosine_{in.cos_theta()},
          half_turn_range_{std::asinh(std::numbers::pi / 2 / cosine_)},
          scale_{wavelength.wave_number() * surface.correlation_length() / 2},
          width_{std::sqrt(1 + phase_variance(surface.rms_roughness(), 2 * cosine_, wavelength)) / scale_} {}

    /// Whether there is a lobe at all.
    [[nodiscard]] bool empty() const { return smooth_ || cosine_ == 0; }

    /// Calls visit(side, hand) for each part of the disc: both sides, and both hands of each where the
    /// surface is not isotropic.
    template <class Visit>
    void for_each_part(Visit&& visit) const {
        for (const int side : {1, -1}) {
            visit(side, 1);
            if (!surface_.isotropic()) visit(side, -1);
        }
    }

    ///   side   +1: the half towards the light, -1: the half towards the nearer horizon      x   0 ... 1
    ///   hand   +1 or -1: on which hand of the plane of incidence
    [[nodiscard]] Ray ray(int side, int hand, double x) const {
        const double turn = cosine_ * std::sinh(half_turn_range_ * x);
        const double cosine = -side * std::sin(turn);
        const double along = sine_ * cosine;
        const double longer = std::abs(along) + std::hypot(along, cosine_);
        const double shorter = square(cosine_) / longer;
        const double length = along > 0 ? shorter : longer;
        const double sine = hand * std::cos(turn);
        const double stretch = stretched(cosine, sine);
        const double width = width_ / stretch;
        return {cosine,
                sine,
                length,
                along > 0 ? longer : shorter,
                stretch,
                width,
                std::asinh(length / width),
                (surface_.isotropic() ? 2 : 1) * half_turn_range_ * std::hypot(cosine_, turn)};
    }

    /// visit(out, lobe times Jacobian) at a point of a ray, y 0 ... 1.
    template <class Visit>
    [[nodiscard]] auto at(const Ray& ray, double y, Visit&& visit) const {
        const double rest = 1 - y;
        const double u = ray.range * y * (2 - y);
        const double distance = ray.width * std::sinh(u);
        const double to_horizon =
            2 * ray.width * std::cosh((ray.range + u) / 2) * std::sinh(ray.range * rest * rest / 2);
        const Direction out = in_frame_of_light({-sine_ - distance * ray.cosine, distance * ray.sine,
                                                 std::sqrt(to_horizon * (distance + ray.beyond))});
        // t from the distance itself: the difference of two directions keeps too little of a narrow lobe
        return visit(out, lobe_(out, square(scale_ * ray.stretch * distance)) * distance *
                              std::hypot(ray.width, distance) * 2 * ray.range * rest);
    }

  private:
    /// A vector whose x axis has the azimuth of the light.
    [[nodiscard]] Direction in_frame_of_light(Vector3 v) const {
        const double c = in_.cos_phi(), s = in_.sin_phi();
        return Direction::from_vector({c * v.x - s * v.y, s * v.x + c * v.y, v.z});
    }

    /// Of a unit vector of the plane, in the frame of the light with x away from it.
    [[nodiscard]] double stretched(double cosine, double sine) const {
        if (surface_.isotropic()) return 1;
        const double c = in_.cos_phi(), s = in_.sin_phi();
        return surface_.stretched({-c * cosine - s * sine, -s * cosine + c * sine});
    }

    const Surface& surface_;
    const Direction& in_;
    const ReflectedLight::Lobe& lobe_;
    bool smooth_;
    double sine_, cosine_;
    double half_turn_range_;  // x = 1
    double scale_;            // sqrt(t) over distance
    double width_;            // w along a stretch of 1
};

/// Gauss's rule over 0 ... 1: f(x, weight).
template <unsigned points, class Function>
void for_gauss_nodes(double from, double to, Function&& f) {
    using Rule = boost::math::quadrature::gauss<double, points>;
    const double half = (to - from) / 2;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        for (const int sign : {-1, 1})
            f(from + half * (1 + sign * Rule::abscissa()[i]), half * Rule::weights()[i]);
    }
}

}  // namespace

double lobe_integral(const Surface& surface, const Direction& in, const Wavelength& wavelength,
                     const ReflectedLight::Lobe& lobe, const LobeWeight& weight, Tolerance tolerance) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
    constexpr unsigned levels = 8;
    // Gauss's rule against Kronrod's: on smooth panels an estimate that is far too large
    const double estimate = 25 * tolerance.relative_error();
    const MirrorDisc disc{surface, in, wavelength, lobe};
    if (disc.empty()) return 0;
    const auto weighted = [&](const Direction& out, double share) { return share * weight(out); };
    const auto along_ray = [&](int side, int hand, double x) {
        const Ray ray = disc.ray(side, hand, x);
        const auto value = [&](double y) { return disc.at(ray, y, weighted); };
        return ray.weight * Rule::integrate(value, 0.0, 1.0, levels, estimate);
    };
    double sum = 0;
    disc.for_each_part([&](int side, int hand) {
        sum +=
            Rule::integrate([&](double x) { return along_ray(side, hand, x); }, 0.0, 1.0, levels, estimate);
    });
    return sum;
}

void visit_lobe(const Surface& surface, const Direction& in, const Wavelength& wavelength,
                const ReflectedLight::Lobe& lobe,
                const std::function<void(const Direction& out, double share)>& visit) {
    constexpr unsigned points = 16;
    const MirrorDisc disc{surface, in, wavelength, lobe};
    if (disc.empty()) return;
    disc.for_each_part([&](int side, int hand) {
        for_gauss_nodes<points>(0, 1, [&](double x, double x_weight) {
            const Ray ray = disc.ray(side, hand, x);
            for (const int third : {0, 1, 2}) {
                for_gauss_nodes<points>(third / 3.0, (third + 1) / 3.0, [&](double y, double y_weight) {
                    disc.at(ray, y, [&](const Direction& out, double share) {
                        visit(out, share * ray.weight * x_weight * y_weight);
                    });
                });
            }
        });
    });
}

}  // namespace hts::spectral
