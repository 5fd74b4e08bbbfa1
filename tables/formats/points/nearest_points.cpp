#include "tables/formats/points/nearest_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace hts::tables {
namespace {

using Place = std::array<double, 3>;

Place place_of(const DirectionPair& pair) noexcept {
    const Vector3 in = pair.in.vector(), sum = in + pair.out.vector();
    const double length = std::sqrt(dot(sum, sum)), across = std::hypot(sum.x, sum.y);
    const double theta_h = std::atan2(across, sum.z), cos_d = std::min(1.0, length / 2);
    const double sin_d = std::sqrt(1 - cos_d * cos_d);
    double along = 0;  // sin theta_d cos phi_d
    if (across > 0) along = (sum.z * (in.x * sum.x + in.y * sum.y) / across - across * in.z) / length;
    // sin theta_d cos 2 phi_d = (2 along^2 - sin^2 theta_d)/sin theta_d
    const double doubled = sin_d > 0 ? (2 * along * along - sin_d * sin_d) / sin_d : 0;
    return {4 * theta_h, std::acos(cos_d), 2 * across / length * doubled};
}

class NearestPoints final : public spectral::Evaluator {
  public:
    NearestPoints(const std::string& name, const ScatterPoints& points)
        : spectral::Evaluator{name, points.wavelengths} {
        for (std::size_t i = 0; i < points.angles.size(); ++i) {
            const ScatterAngles& at = points.angles[i];
            points_.push_back({place_of({Direction::from_degrees(at.theta_i, at.phi_i),
                                         Direction::from_degrees(at.theta_r, at.phi_r)}),
                               i * points.wavelengths.size()});
        }
        std::stable_sort(points_.begin(), points_.end(),
                         [](const Point& a, const Point& b) { return a.place[0] < b.place[0]; });
        values_ = points.values;
        set_domain(points);
    }

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return;
        const Nearest nearest = nearest_to(place_of(pair));
        double sum = 0;
        for (std::size_t k = 0; k < nearest.count; ++k) {
            const double weight = 1 / (nearest.distance[k] + 1e-10);
            sum += weight;
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] += weight * values_[nearest.first[k] + i];
        }
        for (double& value : values) value /= sum;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
    }

    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        return nearest_to(place_of(pair)).distance[0] <= reach_ * reach_;
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override { return domain_; }

  private:
    // Three times the middle distance of neighbours, and their angles in words.
    void set_domain(const ScatterPoints& points) {
        constexpr double least_reach = 0.2;  // some 3 deg of theta_h, 11 deg of theta_d
        std::vector<double> distances;
        const std::size_t step = std::max<std::size_t>(1, points_.size() / 500);
        for (std::size_t i = 0; i < points_.size(); i += step)
            distances.push_back(std::sqrt(nearest_to(points_[i].place).distance[1]));
        std::ranges::nth_element(distances,
                                 distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2));
        reach_ = std::max(least_reach, 3 * distances[distances.size() / 2]);
        std::vector<double> theta_i, theta_r;
        for (const ScatterAngles& at : points.angles) {
            theta_i.push_back(at.theta_i);
            theta_r.push_back(at.theta_r);
        }
        for (auto* axis : {&theta_i, &theta_r}) {
            std::ranges::sort(*axis);
            axis->erase(std::unique(axis->begin(), axis->end()), axis->end());
        }
        domain_ = {theta_i, axis_in_words("theta_i", theta_i) + ", " + axis_in_words("theta_r", theta_r) +
                                ", near one of " + std::to_string(points_.size()) + " points"};
    }
    struct Point {
        Place place;
        std::size_t first;  // of its values
    };
    // Squared distances in growing order.
    struct Nearest {
        std::array<double, 8> distance{};
        std::array<std::size_t, 8> first{};
        std::size_t count = 0;

        [[nodiscard]] bool needs(double squared) const noexcept {
            return count < distance.size() || squared < distance.back();
        }
        void note(double squared, std::size_t values) noexcept {
            if (!needs(squared)) return;
            std::size_t i = count < distance.size() ? count++ : count - 1;
            for (; i > 0 && distance[i - 1] > squared; --i) {
                distance[i] = distance[i - 1];
                first[i] = first[i - 1];
            }
            distance[i] = squared;
            first[i] = values;
        }
    };
    [[nodiscard]] Nearest nearest_to(const Place& place) const noexcept {
        Nearest nearest;
        const auto visit = [&](const Point& point) {
            const double x = point.place[0] - place[0], y = point.place[1] - place[1],
                         z = point.place[2] - place[2];
            if (!nearest.needs(x * x)) return false;
            nearest.note(x * x + y * y + z * z, point.first);
            return true;
        };
        const auto middle =
            std::lower_bound(points_.begin(), points_.end(), place[0],
                             [](const Point& point, double at) { return point.place[0] < at; });
        // outwards on both sides in turn until neither has a point that may be nearer
        auto up = middle, down = middle;
        for (bool rising = true, falling = true; rising || falling;) {
            if (rising) rising = up != points_.end() && visit(*up++);
            if (falling) falling = down != points_.begin() && visit(*--down);
        }
        return nearest;
    }

    std::vector<Point> points_;  // by their first coordinate
    std::vector<double> values_;
    double reach_ = 0;
    spectral::MeasuredDomain domain_;
};

}  // namespace

spectral::Reflectance nearest_points_brdf(const std::string& name, const ScatterPoints& points) {
    return spectral::Reflectance{std::make_shared<const NearestPoints>(name, points)};
}

}  // namespace hts::tables
