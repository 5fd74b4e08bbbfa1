#include "tables/formats/points/scatter_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Angles that differ by less are the same: printed with six decimals at least.
double snapped(double degrees) {
    return std::round(degrees * 1e6) / 1e6;
}
double snapped_turn(double degrees) {
    const double turn = snapped(degrees - 360 * std::floor(degrees / 360));
    return turn >= 360 ? 0 : turn;
}

void sort_unique(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::size_t place(const std::vector<double>& nodes, double value) {
    return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), value) - nodes.begin());
}

// Points that may be a full grid: its axes, and where each point is on it.
class GridOfPoints {
  public:
    explicit GridOfPoints(const ScatterPoints& points) : points_{points} {
        grid_.phi_i.clear();
        for (const ScatterAngles& at : points.angles) {
            grid_.phi_i.push_back(snapped_turn(at.phi_i));
            grid_.theta_i.push_back(snapped(at.theta_i));
            grid_.azimuth.push_back(snapped_turn(at.phi_r - at.phi_i));
            grid_.polar.push_back(snapped(at.theta_r));
        }
        for (auto* axis : {&grid_.phi_i, &grid_.theta_i, &grid_.azimuth, &grid_.polar}) sort_unique(*axis);
        grid_.symmetric = grid_.azimuth.back() <= 180;
    }

    // The values at every node; none if one has no point or two. A view along the normal stands for all azimuths.
    [[nodiscard]] std::optional<std::vector<double>> values() const {
        double nodes = 1;
        for (const auto* axis : {&grid_.phi_i, &grid_.theta_i, &grid_.azimuth, &grid_.polar})
            nodes *= static_cast<double>(axis->size());
        if (nodes > 2 * static_cast<double>(points_.angles.size())) return std::nullopt;
        const std::size_t channels = points_.wavelengths.size();
        std::vector<double> values(grid_.size() * channels, std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < points_.angles.size(); ++i) {
            const ScatterAngles& at = points_.angles[i];
            const std::size_t row = place(grid_.phi_i, snapped_turn(at.phi_i)) * grid_.theta_i.size() +
                                    place(grid_.theta_i, snapped(at.theta_i));
            const std::size_t azimuth = place(grid_.azimuth, snapped_turn(at.phi_r - at.phi_i));
            const std::size_t polar = place(grid_.polar, snapped(at.theta_r));
            const bool along_normal = grid_.polar[polar] == 0;
            for (std::size_t a = 0; a < grid_.azimuth.size(); ++a) {
                if (a != azimuth && !along_normal) continue;
                double* const node =
                    &values[((row * grid_.azimuth.size() + a) * grid_.polar.size() + polar) * channels];
                if (!along_normal && !std::isnan(*node)) return std::nullopt;
                std::copy_n(&points_.values[i * channels], channels, node);
            }
        }
        for (const double value : values)
            if (std::isnan(value)) return std::nullopt;
        return values;
    }
    [[nodiscard]] const AngularGrid& grid() const noexcept { return grid_; }

  private:
    const ScatterPoints& points_;
    AngularGrid grid_;
};

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

  private:
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
};

void check(const std::string& name, const ScatterPoints& points) {
    if (points.angles.empty()) throw Error{name + ": no points"};
    for (const ScatterAngles& at : points.angles) {
        for (const double theta : {at.theta_i, at.theta_r})
            if (!(theta >= 0 && theta <= 90)) throw out_of_range("polar angle", theta, "deg", "from 0 to 90");
        for (const double phi : {at.phi_i, at.phi_r})
            if (!(std::abs(phi) <= 1e6)) throw out_of_range("azimuth", phi, "deg", "from -1e6 to 1e6");
    }
    if (points.values.size() != points.angles.size() * points.wavelengths.size())
        throw Error{name + ": must have a value per point and wavelength"};
    for (const double value : points.values)
        if (!(std::abs(value) <= largest_number))
            throw out_of_range("BRDF", value, "1/sr", "from -1e100 to 1e100");
}

}  // namespace

spectral::Reflectance brdf_from(const std::string& name, const ScatterPoints& points, bool* regular) {
    check(name, points);
    const GridOfPoints grid{points};
    auto values = grid.values();
    if (regular != nullptr) *regular = values.has_value();
    if (values) return gridded_brdf(name, points.wavelengths, grid.grid(), std::move(*values));
    return spectral::Reflectance{std::make_shared<const NearestPoints>(name, points)};
}

AngularGrid csv_grid(bool isotropic) {
    AngularGrid grid;
    const double step = isotropic ? 2.5 : 5;
    for (double theta = 0; theta < 75; theta += step) grid.theta_i.push_back(theta);
    for (double theta = 75; theta < 90; theta += isotropic ? 1 : 3) grid.theta_i.push_back(theta);
    grid.theta_i.push_back(89.9);
    grid.polar = grid.theta_i;
    for (double azimuth = 0; azimuth < 150; azimuth += 15) grid.azimuth.push_back(azimuth);
    for (const double azimuth : {150, 155, 160, 164, 168, 171, 173, 175, 176, 177, 178, 179, 180})
        grid.azimuth.push_back(azimuth);
    if (isotropic) return grid;
    grid.phi_i.clear();
    for (double phi = 0; phi < 360; phi += 15) grid.phi_i.push_back(phi);
    return grid;
}

std::string scatter_csv(const spectral::Reflectance& brdf, AngularGrid grid) {
    grid.check();
    if (grid.axis != PolarAxis::normal)
        throw Error{"grid about the mirror direction: a CSV file needs one about the normal"};
    if (grid.phi_i.size() == 1 && !brdf.properties().isotropic)
        throw Error{brdf.name() +
                    ": depends on the azimuth of the light, which must have more than one value"};
    if (grid.symmetric && !is_plane_symmetric(brdf)) {
        grid = without_symmetry(std::move(grid));
        grid.azimuth.pop_back();  // 360 is 0 again
    }
    std::string text = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg";
    for (const double wavelength : brdf.wavelengths().micrometres()) {
        text += ",brdf_";
        append_rounded(text, 1000 * wavelength, 9);
        text += "nm";
    }
    text += '\n';
    const std::size_t wavelengths = brdf.wavelengths().size();
    const std::vector<double> values = values_on(grid, brdf);
    for (std::size_t node = 0; node < grid.size(); ++node) {
        const std::size_t row = node / grid.polar.size(), slice = row / grid.azimuth.size();
        const double phi_i = grid.phi_i[slice / grid.theta_i.size()];
        append_rounded(text, grid.theta_i[slice % grid.theta_i.size()], 9);
        for (const double angle :
             {phi_i, grid.polar[node % grid.polar.size()], phi_i + grid.azimuth[row % grid.azimuth.size()]}) {
            text += ',';
            append_rounded(text, angle, 9);
        }
        for (std::size_t k = 0; k < wavelengths; ++k) {
            text += ',';
            append_rounded(text, values[node * wavelengths + k]);
        }
        text += '\n';
    }
    return text;
}

}  // namespace hts::tables
