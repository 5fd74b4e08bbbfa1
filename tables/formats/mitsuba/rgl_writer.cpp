#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/output.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/mitsuba/rgl_square.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"

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
/// up for what this density is not as a density of light.
class NodeDensity {
  public:
    NodeDensity(const Lobes& lobes, const Direction& in)
        : lobes_{lobes}, in_{in}, near_horizon_{std::clamp(10 * in.cos_theta(), 0.1, 1.0)} {}

    /// On the square, rows x columns.
    std::vector<float> slice(std::size_t rows, std::size_t columns, std::vector<double>& values) {
        std::vector<double> light, spread;
        for (std::size_t i = 0; i < rows * columns; ++i) {
            const Point2 point{coordinate(i % columns, columns), coordinate(i / columns, rows)};
            const FacetView view{in_, half_vector(point, 0)};
            const double area = static_cast<double>(point.x) * share(view);
            light.push_back(area > 0 ? area * tempered(lobes_(in_, view.out, values)) : 0);
            spread.push_back(area);
        }
        normalise(light, spread);
        std::vector<float> result;
        const double brightest = light_ * *std::max_element(light.begin(), light.end());
        const double floor = brightest > 0 ? 1e-6 * brightest : 1;
        for (std::size_t i = 0; i < light.size(); ++i)
            result.push_back(static_cast<float>(light_ * light[i] + spread_ * spread[i] + floor));
        return result;
    }

    /// Light per node; after `slice`.
    ///   mean   BRDF, mean of all wavelengths
    [[nodiscard]] double luminance(const FacetView& view, double mean) const {
        const double nodes = share(view) * (light_ * tempered(mean) + spread_);
        return nodes > 0 ? view.tilt * view.facing * std::max(view.cosine, 0.0) * mean / nodes : 0;
    }

  private:
    static double tempered(double mean) { return std::pow(mean, 0.4); }

    /// Per angle of the facet's tilt, without light's part.
    [[nodiscard]] double share(const FacetView& view) const {
        const double c = view.cosine, width = 0.15 * near_horizon_, behind = 0.1 * near_horizon_;
        const double height = c >= 0 ? 1 / (c + width) : std::max(1 + c / behind, 0.0) / width;
        return std::sqrt(view.facing) * height;
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
    double light_ = 0, spread_ = 0;
};

/// The arrays of the file.
class RglTables {
  public:
    RglTables(const spectral::Reflectance& brdf, const RglResolution& resolution)
        : lobes_{brdf},
          wavelengths_{brdf.wavelengths().size()},
          rows_{count(resolution.azimuths)},
          columns_{count(resolution.elevations)},
          n_{count(resolution.resolution)},
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
        NodeDensity density{lobes_, in};
        const std::vector<float> slice = density.slice(rows_, columns_, values);
        std::copy(slice.begin(), slice.end(), vndf_.begin() + static_cast<std::ptrdiff_t>(t * slice.size()));
        const BilinearWarp warp{slice, rows_, columns_};
        const SliceMix only = slice_mix({0, 0}, {0, 0}, 1, 1);
        const double scale = 4 * static_cast<double>(sigma_at(in));
        for (std::size_t i = 0; i < n_ * n_; ++i) {
            const Point2 node{coordinate(i % n_, n_), coordinate(i / n_, n_)};
            const FacetView view{in, half_vector(warp.sample(node, only).point, 0)};
            const double mean = lobes_(in, view.out, values);
            luminance_[t * n_ * n_ + i] = static_cast<float>(1e-6 + density.luminance(view, mean));
            for (std::size_t k = 0; k < wavelengths_; ++k)
                spectra_[(t * wavelengths_ + k) * n_ * n_ + i] =
                    static_cast<float>(scale * values[k] * view.cosine);
        }
    }

    /// As a reader interpolates it.
    [[nodiscard]] float sigma_at(const Direction& in) const {
        return BilinearCell{LightAngles{in}.square(), 2, sigma_columns}.value(sigma_.data());
    }

    Lobes lobes_;
    std::size_t wavelengths_, rows_, columns_, n_;
    std::vector<float> thetas_, sigma_, vndf_, luminance_, spectra_;
};

std::vector<float> nanometres(const spectral::Reflectance& brdf) {
    std::vector<float> result;
    for (const double um : brdf.wavelengths().micrometres()) result.push_back(static_cast<float>(um * 1000));
    return result;
}

}  // namespace

namespace {

std::string rgl_bytes(const spectral::Reflectance& brdf, const RglResolution& resolution) {
    require(resolution);
    if (!brdf.properties().isotropic)
        throw Error{brdf.name() + " is anisotropic: a file of this format is written of isotropic ones only"};
    const std::vector<float> wavelengths = nanometres(brdf);
    TensorFileWriter file;
    file.add("description", brdf.name() + ", computed by hts");
    file.add("jacobian", {1}, std::vector<std::uint8_t>{1});
    file.add("wavelengths", {wavelengths.size()}, wavelengths);
    RglTables{brdf, resolution}.add_to(file);
    return file.bytes();
}

std::string fine_enough(const spectral::Reflectance& brdf) {
    constexpr RglResolution first{72, 80, 129, 512};
    constexpr double most_error = 0.6 * accuracy::rgl;  // on fresh pairs half as much again was seen
    constexpr int most_refinements = 2;
    constexpr RoundTripOptions pairs{200'000, 0};
    RglResolution resolution = first;
    for (int refinements = 0;; ++refinements) {
        std::string bytes = rgl_bytes(brdf, resolution);
        if (refinements == most_refinements) return bytes;
        const spectral::Reflectance read{parse_rgl(bytes, brdf.name())};
        if (round_trip(brdf, read, pairs).worst.error <= most_error) return bytes;
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
               const RglResolution& resolution) {
    spectral::write_file(path.string(), rgl_bytes(brdf, resolution));
}

Exported exported_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path) {
    return {{{path.string(), fine_enough(brdf)}}, described()};
}

void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path) {
    spectral::write_files(exported_rgl(brdf, path).files);
}

}  // namespace hts::tables
