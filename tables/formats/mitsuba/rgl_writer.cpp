#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/output.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/mitsuba/rgl_nodes.hpp"
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

void require(const char* what, int value, int least, int most) {
    if (value < least || value > most)
        throw out_of_range(what, value, "", "from " + std::to_string(least) + " to " + std::to_string(most));
}

void require(const RglResolution& resolution) {
    require("number of angles of incidence", resolution.theta_i, 2, 256);
    require("resolution of the warped square", resolution.resolution, 2, 1024);
    require("number of azimuths of the warp", resolution.azimuths, 2, 1024);
    require("number of elevations of the warp", resolution.elevations, 8, 4096);
    require("number of azimuths of incidence", resolution.phi_i, 5, 361);
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

/// From -pi to pi, as readers want all azimuths, or 0 alone.
std::vector<float> incidence_azimuths(const spectral::Reflectance& brdf, int n) {
    if (brdf.properties().isotropic) return {0};
    std::vector<float> nodes;
    nodes.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) nodes.push_back(static_cast<float>(2 * pi * i / (n - 1) - pi));
    nodes.back() = -nodes.front();
    return nodes;
}

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
          phis_{incidence_azimuths(brdf, resolution.phi_i)},
          sigma_(std::max<std::size_t>(phis_.size(), 2) * sigma_columns),
          vndf_(phis_.size() * thetas_.size() * rows_ * columns_),
          luminance_(phis_.size() * thetas_.size() * n_ * n_),
          spectra_(luminance_.size() * wavelengths_) {
        fill_sigma();
        spectral::parallel_for(phis_.size() * thetas_.size(), [this](std::size_t i) { fill(i); });
    }

    void add_to(TensorFileWriter& file, RglChannels channels) const {
        const std::size_t thetas = thetas_.size(), phis = phis_.size();
        file.add("theta_i", {thetas}, thetas_);
        file.add("phi_i", {phis}, phis_);
        file.add("ndf", {2, 2}, std::vector<float>(4, 1));
        file.add("sigma", {sigma_.size() / sigma_columns, sigma_columns}, sigma_);
        file.add("vndf", {phis, thetas, rows_, columns_}, vndf_);
        file.add("luminance", {phis, thetas, n_, n_}, luminance_);
        if (channels == RglChannels::spectra) {
            file.add("spectra", {phis, thetas, wavelengths_, n_, n_}, spectra_);
            return;
        }
        std::vector<float> reversed(spectra_.size());  // red first
        const std::size_t plane = n_ * n_;
        for (std::size_t i = 0; i < phis * thetas * 3; ++i)
            std::copy_n(spectra_.begin() + static_cast<std::ptrdiff_t>(i * plane), plane,
                        reversed.begin() + static_cast<std::ptrdiff_t>((i / 3 * 3 + 2 - i % 3) * plane));
        file.add("rgb", {phis, thetas, 3, n_, n_}, reversed);
    }

  private:
    /// 1/(4 sigma) carries the growth of the lobe's peak with the direction of incidence.
    void fill_sigma() {
        std::vector<double> values;
        for (std::size_t p = 0; p < phis_.size(); ++p) {
            for (std::size_t c = 0; c < sigma_columns; ++c) {
                const auto theta = static_cast<double>(theta_of_u(coordinate(c, sigma_columns)));
                const Direction in =
                    Direction::from_angles(std::min(theta, 89.9 * pi / 180), static_cast<double>(phis_[p]));
                sigma_[p * sigma_columns + c] = static_cast<float>(0.25 / lobes_.peak(in, values));
            }
        }
        if (phis_.size() == 1) std::copy_n(sigma_.begin(), sigma_columns, sigma_.begin() + sigma_columns);
    }

    /// The t-th slice, azimuth by azimuth.
    void fill(std::size_t t) {
        const Direction in = Direction::from_angles(static_cast<double>(thetas_[t % thetas_.size()]),
                                                    static_cast<double>(phis_[t / thetas_.size()]));
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

    /// Light at a node of the warped square, where the BRDF has that mean. At facets along the normal neither
    /// they nor the nodes have any solid angle: a point a little aside stands for them.
    [[nodiscard]] double light_at(const BilinearWarp& warp, Point2 node, const Direction& in,
                                  double mean) const {
        node.x = std::max(node.x, 0.1F / static_cast<float>(n_ - 1));
        const WarpedPoint at = warp.sample(node, slice_mix({0, 0}, {0, 0}, 1, 1));
        const FacetView view{in, half_vector(at.point, 0)};
        if (!(at.density > 0)) return 0;
        return static_cast<double>(at.point.x) * view.tilt * view.facing * std::max(view.cosine, 0.0) * mean /
               static_cast<double>(at.density);
    }

    /// As a reader interpolates it.
    [[nodiscard]] float sigma_at(const Direction& in) const {
        return BilinearCell{LightAngles{in}.square(), sigma_.size() / sigma_columns, sigma_columns}.value(
            sigma_.data());
    }

    Lobes lobes_;
    std::size_t wavelengths_, rows_, columns_, n_;
    double specular_edge_;
    std::vector<float> thetas_, phis_, sigma_, vndf_, luminance_, spectra_;
};

std::vector<float> nanometres(const spectral::Reflectance& brdf) {
    std::vector<float> result;
    for (const double um : brdf.wavelengths().micrometres()) result.push_back(static_cast<float>(um * 1000));
    return result;
}

}  // namespace

namespace {

std::string rgl_bytes(const spectral::Reflectance& brdf, const RglResolution& resolution,
                      double specular_solid_angle, RglChannels channels = RglChannels::spectra) {
    require(resolution);
    if (channels == RglChannels::rgb && brdf.size() != 3)
        throw out_of_range("number of channels", static_cast<double>(brdf.size()), "", "3 in a file of rgb");
    TensorFileWriter file;
    file.add("description", brdf.name() + ", computed by hts");
    file.add("jacobian", {1}, std::vector<std::uint8_t>{1});
    if (channels == RglChannels::spectra) file.add("wavelengths", {brdf.size()}, nanometres(brdf));
    RglTables{brdf, resolution, specular_solid_angle}.add_to(file, channels);
    return file.bytes();
}

std::string fine_enough(const spectral::Reflectance& brdf, const RoundTripOptions& compared,
                        RglChannels channels) {
    constexpr RglResolution of_isotropic{72, 80, 129, 512}, of_others{36, 40, 65, 128, 25};
    constexpr double most_error = 0.6 * accuracy::rgl;  // on fresh pairs half as much again was seen
    const bool isotropic = brdf.properties().isotropic;
    const int most_refinements = isotropic ? 2 : 0;  // with azimuths of the light a file is large as it is
    RglResolution resolution = isotropic ? of_isotropic : of_others;
    for (int refinements = 0;; ++refinements) {
        std::string bytes = rgl_bytes(brdf, resolution, compared.specular_solid_angle, channels);
        if (refinements == most_refinements) return bytes;
        std::shared_ptr<const RglBrdf> file = parse_rgl(bytes, brdf.name());
        spectral::Reflectance read{std::move(file)};
        if (channels == RglChannels::rgb) read = with_channels_named(std::move(read), brdf.wavelengths());
        if (round_trip(brdf, read, compared).worst.error <= most_error) return bytes;
        resolution.resolution = resolution.resolution * 5 / 4;
    }
}

Sidecar described(RglChannels channels, bool isotropic) {
    const bool rgb = channels == RglChannels::rgb;
    return {.format = "RGL tensor file (.bsdf): Mitsuba 3 measured, pbrt-v4 measured, powitacq",
            .value = std::string{"f cos(theta_o), "} + (rgb ? "three channels, linear sRGB" : "spectral") +
                     ", on a warped half-vector square",
            .normalisation = "readers multiply by ndf/(4 sigma), which the stored numbers allow for",
            .notes = {"front side only",
                      isotropic ? "isotropic" : "anisotropic: azimuths of incidence over a full turn",
                      rgb ? "red, green, blue: for the RGB variants of Mitsuba 3; pbrt-v4 and powitacq read "
                            "spectra alone"
                          : "wavelengths outside those of the file take the values of the nearest"}};
}

}  // namespace

void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path,
               const RglResolution& resolution, double specular_solid_angle) {
    spectral::write_file(path.string(), rgl_bytes(brdf, resolution, specular_solid_angle));
}

Exported exported_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                      const RoundTripOptions& compared, RglChannels channels) {
    return {{{path.string(), fine_enough(brdf, compared, channels)}},
            described(channels, brdf.properties().isotropic)};
}

void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path) {
    spectral::write_files(exported_rgl(brdf, path).files);
}

}  // namespace hts::tables
