#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/output.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/mitsuba/rgl_square.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"
#include "tables/formats/specular_box.hpp"

namespace hts::tables {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t sigma_columns = 512;

std::size_t count(int value) {
    return static_cast<std::size_t>(value);
}

/// The i-th of n coordinates from 0 to 1.
float coordinate(std::size_t i, std::size_t n) {
    return static_cast<float>(i) / static_cast<float>(n - 1);
}

void require(const char* what, int value, int least, int most) {
    if (value < least || value > most)
        throw out_of_range(what, value, "", "from " + std::to_string(least) + " to " + std::to_string(most));
}

void require(const RglResolution& resolution) {
    require("number of angles of incidence", resolution.theta_i, 2, 256);
    require("resolution of the warped square", resolution.resolution, 2, 1024);
    require("number of azimuths of the warp", resolution.azimuths, 2, 1024);
    require("number of elevations of the warp", resolution.elevations, 8, 4096);
}

/// From 0 to just short of the horizon, in steps that shrink with the height above it.
std::vector<float> incidence_angles(int n) {
    constexpr double last = 89, crowding = 25;
    const auto steps = [](double theta) { return theta + crowding * std::log(90 / (90 - theta)); };
    std::vector<float> nodes;
    double theta = 0;
    for (int i = 0; i < n; ++i) {
        const double target = steps(last) * i / (n - 1);
        for (int newton = 0; newton < 20;
             ++newton)  // steps is convex: from below the first step passes, then it falls
            theta = std::min(theta - (steps(theta) - target) / (1 + crowding / (90 - theta)), last);
        nodes.push_back(static_cast<float>(theta * pi / 180));
    }
    return nodes;
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
        : brdf_{brdf}, slope_{lobe_slope(brdf)}, weights_{lobe_peaks(brdf, vertical(), slope_, pi / 2)} {
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
        for (const Direction& out : views_of_the_plane_of_incidence(in, slope_, pi / 2))
            largest = std::max(largest, (*this)(in, out, values) * out.cos_theta());
        return largest;
    }

  private:
    static Direction vertical() { return Direction::from_angles(0, 0); }

    const spectral::Reflectance& brdf_;
    double slope_;
    std::vector<double> weights_;
};

/// Where one angle of incidence gets its nodes: more of them where there is light, where it varies, at the facets near the
/// normal and at views near the horizon, where the stored f cos(theta_o) is divided by a small cosine. The luminance makes
/// up for what this density is not as a density of light. A specular lobe of facets takes the same columns of the warped square for every
/// azimuth and angle of incidence, so that readers who mix them see the same lobe.
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
        const double azimuth = (2 * static_cast<double>(row) - 1) * pi;
        const double tilt = (std::atan2(in_.sin_theta() * std::cos(azimuth), in_.cos_theta()) + pi / 2) / 2;
        return std::sqrt(tilt * 2 / pi) * static_cast<double>(columns - 1);
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

    /// Nodes evenly over the tilts of the specular lobe, so many that they get their share of the row in front of the horizon.
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
    /// Goes on behind the horizon as dense as in front of it, until the row's integral is what it has to be. Without a jump
    /// there the horizon keeps its place also where readers mix two rows or two angles of incidence.
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

/// The arrays of the file.
class RglTables {
  public:
    RglTables(const spectral::Reflectance& brdf, const RglResolution& resolution, double specular_solid_angle)
        : lobes_{brdf},
          wavelengths_{brdf.wavelengths().size()},
          rows_{count(resolution.azimuths)},
          columns_{count(resolution.elevations)},
          n_{count(resolution.resolution)},
          specular_edge_{
              specular_solid_angle > 0 ? std::sqrt(specular_lobe_tilt(specular_solid_angle) * 2 / pi) : 0},
          thetas_{incidence_angles(resolution.theta_i)},
          sigma_(2 * sigma_columns),
          vndf_(thetas_.size() * rows_ * columns_),
          luminance_(thetas_.size() * n_ * n_),
          spectra_(luminance_.size() * wavelengths_) {
        fill_sigma();
        spectral::parallel_for(thetas_.size(), [this](std::size_t t) { fill(t); });
    }

    void add_to(TensorFileWriter& file) const {
        const std::size_t thetas = thetas_.size();
        file.add("theta_i", {thetas}, thetas_);
        file.add("phi_i", {1}, std::vector<float>{0});
        file.add("ndf", {2, 2}, std::vector<float>(4, 1));
        file.add("sigma", {2, sigma_columns}, sigma_);
        file.add("vndf", {1, thetas, rows_, columns_}, vndf_);
        file.add("luminance", {1, thetas, n_, n_}, luminance_);
        file.add("spectra", {1, thetas, wavelengths_, n_, n_}, spectra_);
    }

  private:
    /// 1/(4 sigma) carries the growth of the lobe's peak with the angle of incidence.
    void fill_sigma() {
        std::vector<double> values;
        for (std::size_t c = 0; c < sigma_columns; ++c) {
            const auto theta = static_cast<double>(theta_of_u(coordinate(c, sigma_columns)));
            const Direction in = Direction::from_angles(std::min(theta, 89.9 * pi / 180), 0);
            sigma_[c] = sigma_[c + sigma_columns] = static_cast<float>(0.25 / lobes_.peak(in, values));
        }
    }

    void fill(std::size_t t) {
        const Direction in = Direction::from_angles(static_cast<double>(thetas_[t]), 0);
        std::vector<double> values;
        NodeDensity density{lobes_, in, specular_edge_};
        const std::size_t behind = std::max<std::size_t>(n_ / 40, 1);  // columns of the warped square
        const double in_front =
            static_cast<double>(n_ - 1 - std::min(behind, n_ - 1)) / static_cast<double>(n_ - 1);
        const std::vector<float> slice = density.slice(rows_, columns_, std::max(in_front, 0.5), values);
        std::copy(slice.begin(), slice.end(), vndf_.begin() + static_cast<std::ptrdiff_t>(t * slice.size()));
        const BilinearWarp warp{slice, rows_, columns_};
        const SliceMix only = slice_mix({0, 0}, {0, 0}, 1, 1);
        const double scale = 4 * static_cast<double>(sigma_at(in));
        std::vector<double> luminance(n_ * n_);
        for (std::size_t i = 0; i < n_ * n_; ++i) {
            const Point2 node{coordinate(i % n_, n_), coordinate(i / n_, n_)};
            const FacetView view{in, half_vector(warp.sample(node, only).point, 0)};
            const double mean = lobes_(in, view.out, values);
            luminance[i] = light_at(warp, node, in, mean);
            for (std::size_t k = 0; k < wavelengths_; ++k)
                spectra_[(t * wavelengths_ + k) * n_ * n_ + i] =
                    static_cast<float>(scale * values[k] * std::max(view.cosine, 0.0));
        }
        const double brightest = *std::ranges::max_element(luminance);
        const double floor = brightest > 0 ? 1e-6 * brightest : 1;
        std::ranges::transform(luminance, luminance_.begin() + static_cast<std::ptrdiff_t>(t * n_ * n_),
                               [floor](double light) { return static_cast<float>(light + floor); });
    }

    /// Light at a node of the warped square, where the BRDF has that mean. At facets along the normal neither they nor the nodes have
    /// any solid angle: a point a little aside stands for them.
    [[nodiscard]] double light_at(const BilinearWarp& warp, Point2 node, const Direction& in,
                                  double mean) const {
        node.x = std::max(node.x, 0.1F / static_cast<float>(n_ - 1));
        const WarpedPoint at = warp.sample(node, slice_mix({0, 0}, {0, 0}, 1, 1));
        const FacetView view{in, half_vector(at.point, 0)};
        return static_cast<double>(at.point.x) * view.tilt * view.facing * std::max(view.cosine, 0.0) * mean /
               static_cast<double>(at.density);
    }

    /// As a reader interpolates it.
    [[nodiscard]] float sigma_at(const Direction& in) const {
        return BilinearCell{LightAngles{in}.square(), 2, sigma_columns}.value(sigma_.data());
    }

    Lobes lobes_;
    std::size_t wavelengths_, rows_, columns_, n_;
    double specular_edge_;
    std::vector<float> thetas_, sigma_, vndf_, luminance_, spectra_;
};

std::vector<float> nanometres(const spectral::Reflectance& brdf) {
    std::vector<float> result;
    for (const double um : brdf.wavelengths().micrometres()) result.push_back(static_cast<float>(um * 1000));
    return result;
}

}  // namespace

namespace {

std::string rgl_bytes(const spectral::Reflectance& brdf, const RglResolution& resolution,
                      double specular_solid_angle) {
    require(resolution);
    if (!brdf.properties().isotropic)
        throw Error{brdf.name() + " is anisotropic: a file of this format is written of isotropic ones only"};
    const std::vector<float> wavelengths = nanometres(brdf);
    TensorFileWriter file;
    file.add("description", brdf.name() + ", computed by hts");
    file.add("jacobian", {1}, std::vector<std::uint8_t>{1});
    file.add("wavelengths", {wavelengths.size()}, wavelengths);
    RglTables{brdf, resolution, specular_solid_angle}.add_to(file);
    return file.bytes();
}

std::string fine_enough(const spectral::Reflectance& brdf, const RoundTripOptions& compared) {
    constexpr RglResolution first{72, 80, 129, 512};
    constexpr double most_error = 0.6 * accuracy::rgl;  // on fresh pairs half as much again was seen
    constexpr int most_refinements = 2;
    RglResolution resolution = first;
    for (int refinements = 0;; ++refinements) {
        std::string bytes = rgl_bytes(brdf, resolution, compared.specular_solid_angle);
        if (refinements == most_refinements) return bytes;
        const spectral::Reflectance read{parse_rgl(bytes, brdf.name())};
        if (round_trip(brdf, read, compared).worst.error <= most_error) return bytes;
        resolution.resolution = resolution.resolution * 5 / 4;
    }
}

Sidecar described() {
    return {.format = "RGL tensor file (.bsdf): Mitsuba 3 measured, pbrt-v4 measured, powitacq",
            .value = "f cos(theta_o), spectral, on a warped half-vector square",
            .normalisation = "readers multiply by ndf/(4 sigma), which the stored numbers allow for",
            .notes = {"front side only", "isotropic",
                      "wavelengths outside those of the file take the values of the nearest"}};
}

}  // namespace

void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path,
               const RglResolution& resolution, double specular_solid_angle) {
    spectral::write_file(path.string(), rgl_bytes(brdf, resolution, specular_solid_angle));
}

Exported exported_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                      const RoundTripOptions& compared) {
    return {{{path.string(), fine_enough(brdf, compared)}}, described()};
}

void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path) {
    spectral::write_files(exported_rgl(brdf, path).files);
}

}  // namespace hts::tables
