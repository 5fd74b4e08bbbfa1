/// Where the nodes of an RGL file stand: the lobes of a reflectance, and the density over half vectors that
/// follows them. Private to rgl_writer.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/mitsuba/rgl_square.hpp"

namespace hts::tables {

/// The i-th of n coordinates from 0 to 1.
inline float coordinate(std::size_t i, std::size_t n) {
    return static_cast<float>(i) / static_cast<float>(n - 1);
}

/// Where a facet mirrors the light, moved up to the horizon if it lies behind, and its cosine before that.
struct FacetView {
    FacetView(const Direction& in, Vector3 m)
        : facing{std::max(dot(in.vector(), m), 0.0)}, tilt{std::sqrt(std::max(1 - m.z * m.z, 0.0))} {
        const Vector3 view = mirrored(in, m);
        cosine = view.z;
        out = Direction::from_vector({view.x, view.y, std::max(view.z, 1e-4)});
    }

    double facing;  // w_i.m
    double tilt;    // sin theta_m
    double cosine = 0;
    Direction out = Direction::from_angles(0, 0);
};

/// The BRDF and its mean over the wavelengths, each taken relative to its peak.
class Lobes {
  public:
    explicit Lobes(const spectral::Reflectance& brdf)
        : brdf_{brdf},
          slope_{lobe_slope(brdf)},
          weights_{lobe_peaks(brdf, vertical(), slope_, std::numbers::pi / 2)} {
        for (double& weight : weights_)
            weight = weight > 0 ? 1 / (weight * static_cast<double>(weights_.size())) : 0;
    }

    /// [1/sr], one value per wavelength, into `values`; returns the mean.
    double operator()(const Direction& in, const Direction& out, std::vector<double>& values) const {
        values.resize(weights_.size());
        brdf_.brdf({in, out}, values);
        double mean = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!std::isfinite(values[k])) values[k] = 0;
            mean += weights_[k] * values[k];
        }
        return mean;
    }
    /// Largest mean f cos(theta_o) in the plane of incidence, > 0.
    [[nodiscard]] double peak(const Direction& in, std::vector<double>& values) const {
        double largest = 1e-12;
        for (const Direction& out : views_of_the_plane_of_incidence(in, slope_, std::numbers::pi / 2))
            largest = std::max(largest, (*this)(in, out, values) * out.cos_theta());
        return largest;
    }

  private:
    static Direction vertical() { return Direction::from_angles(0, 0); }

    const spectral::Reflectance& brdf_;
    double slope_;
    std::vector<double> weights_;
};

/// Where one angle of incidence gets its nodes: more of them where there is light, where it varies, at the
/// facets near the normal and at views near the horizon, where the stored f cos(theta_o) is divided by a
/// small cosine. The luminance makes up for what this density is not as a density of light. A specular lobe
/// of facets takes the same columns of the warped square for every azimuth and angle of incidence, so that
/// readers who mix them see the same lobe.
class NodeDensity {
  public:
    ///   specular_edge   u where that lobe ends, 0 for none
    NodeDensity(const Lobes& lobes, const Direction& in, double specular_edge)
        : lobes_{lobes},
          in_{in},
          near_horizon_{std::clamp(10 * in.cos_theta(), 0.1, 1.0)},
          specular_edge_{specular_edge} {}

    /// On the square, rows x columns.
    ///   in_front   part of each row's integral that lies in front of the horizon
    std::vector<float> slice(std::size_t rows, std::size_t columns, double in_front,
                             std::vector<double>& values) {
        std::vector<double> light, spread;
        for (std::size_t i = 0; i < rows * columns; ++i) {
            const Point2 point{coordinate(i % columns, columns), coordinate(i / columns, rows)};
            const FacetView view{in_, half_vector(point, 0)};
            const double area = static_cast<double>(point.x) * share(view);
            const bool in_lobe = static_cast<double>(point.x) < specular_edge_;  // see fill_specular
            light.push_back(area > 0 && !in_lobe ? area * tempered(lobes_(in_, view.out, values)) : 0);
            spread.push_back(area);
        }
        normalise(light, spread);
        std::vector<float> result;
        const double brightest = light_ * *std::max_element(light.begin(), light.end());
        const double floor = brightest > 0 ? 1e-6 * brightest : 1;
        for (std::size_t i = 0; i < light.size(); ++i)
            result.push_back(static_cast<float>(light_ * light[i] + spread_ * spread[i] + floor));
        for (std::size_t i = 0; i < rows; ++i) {
            const auto row = std::span{result}.subspan(i * columns, columns);
            if (specular_edge_ > 0) fill_specular(row, coordinate(i, rows), in_front);
            fill_behind(row, coordinate(i, rows), in_front);
        }
        return result;
    }

  private:
    static double tempered(double mean) { return std::pow(mean, 0.4); }

    /// Per angle of the facet's tilt, without light's part.
    [[nodiscard]] double share(const FacetView& view) const {
        if (view.cosine < 0) return 0;
        return std::sqrt(view.facing) / (view.cosine + 0.15 * near_horizon_);
    }
    /// The column where a row crosses the horizon: w_o.z is a cosine of twice the facet's tilt.
    [[nodiscard]] double horizon_column(float row, std::size_t columns) const {
        const double azimuth = (2 * static_cast<double>(row) - 1) * std::numbers::pi;
        const double towards_light = std::cos(azimuth) * in_.cos_phi() + std::sin(azimuth) * in_.sin_phi();
        const double tilt =
            (std::atan2(in_.sin_theta() * towards_light, in_.cos_theta()) + std::numbers::pi / 2) / 2;
        return std::sqrt(tilt * 2 / std::numbers::pi) * static_cast<double>(columns - 1);
    }
    /// A point along a row, in columns, and integrals of the row's straight lines up to it.
    struct Cut {
        Cut(double column, std::size_t columns)
            : node{std::min(static_cast<std::size_t>(column), columns - 2)},
              past{std::min(column - static_cast<double>(node), 1.0)} {}

        [[nodiscard]] double before(std::span<const float> row) const {
            double sum = static_cast<double>(row[node]) * (past - past * past / 2) +
                         static_cast<double>(row[node + 1]) * past * past / 2;
            for (std::size_t i = 0; i < node; ++i) sum += static_cast<double>(row[i] + row[i + 1]) / 2;
            return sum;
        }

        std::size_t node;
        double past;  // this node's cell, 0 ... 1
    };

    /// Nodes evenly over the tilts of the specular lobe, so many that they get their share of the row
    /// in front of the horizon.
    void fill_specular(std::span<float> row, float place, double in_front) const {
        constexpr double share = 0.3;  // of all columns
        const Cut edge{specular_edge_ * static_cast<double>(row.size() - 1), row.size()};
        const Cut horizon{horizon_column(place, row.size()), row.size()};
        if (horizon.node < edge.node + 2) return;
        for (std::size_t i = 0; i <= edge.node; ++i) row[i] = 0;
        const double inside = edge.before(row), outside = horizon.before(row) - inside;
        for (std::size_t i = 0; i <= edge.node; ++i) row[i] = static_cast<float>(i);
        const double inside_each = edge.before(row) - inside;
        const double outside_each = static_cast<double>(edge.node) * (1 - edge.past) * (1 - edge.past) / 2;
        const double ratio = share / (in_front - share);  // inside to outside
        const double step = (ratio * outside - inside) / (inside_each - ratio * outside_each);
        for (std::size_t i = 0; i <= edge.node; ++i)
            row[i] = static_cast<float>(
                std::max((static_cast<double>(i) + 1e-3) * step, static_cast<double>(row.back())));
    }
    /// Goes on behind the horizon as dense as in front of it, until the row's integral is what it has to be.
    /// Without a jump there the horizon keeps its place also where readers mix two rows or
    /// two angles of incidence.
    void fill_behind(std::span<float> row, float place, double in_front) const {
        const Cut horizon{horizon_column(place, row.size()), row.size()};
        const double past = horizon.past, edge = static_cast<double>(row[horizon.node]),
                     least = static_cast<double>(row.back());
        row[horizon.node + 1] = row[horizon.node];
        const double front = horizon.before(row);
        double left = front * (1 - in_front) / in_front - edge * (1 - past) * (1 - past) / 2;
        for (std::size_t i = horizon.node + 1; i < row.size(); ++i) {
            const double before = i == horizon.node + 1 ? (1 - past * past) / 2 : 0.5;
            const double weight = std::max(before + (i + 1 < row.size() ? 0.5 : 0.0), 1e-6);
            const bool end = i + 1 == row.size();
            const double density = std::max(end ? left / weight : std::min(left / weight, edge), least);
            row[i] = static_cast<float>(density);
            left -= density * weight;
        }
    }
    void normalise(const std::vector<double>& light, const std::vector<double>& spread) {
        constexpr double dark = 0.06;  // share of the nodes that does not follow the light
        const double light_sum = std::accumulate(light.begin(), light.end(), 0.0);
        light_ = light_sum > 0 ? (1 - dark) / light_sum : 0;
        const double spread_sum = std::accumulate(spread.begin(), spread.end(), 0.0);
        spread_ = spread_sum > 0 ? dark / spread_sum : 0;
    }

    const Lobes& lobes_;
    Direction in_;
    double near_horizon_;
    double specular_edge_;
    double light_ = 0, spread_ = 0;
};

}  // namespace hts::tables
