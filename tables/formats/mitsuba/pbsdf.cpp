#include "tables/formats/mitsuba/pbsdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/output.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/mitsuba/bilinear_warp.hpp"
#include "tables/formats/mitsuba/frames.hpp"
#include "tables/formats/mitsuba/half_angles.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"
#include "tables/formats/whole_file.hpp"

namespace hts::tables {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t bands = 5, elements = 16;

// ---- writing

void require(const char* what, int value) {
    if (value < 2 || value > 1024) throw out_of_range(what, value, "", "from 2 to 1024");
}

/// The five wavelengths in whole nanometres.
std::vector<std::uint16_t> whole_nanometres(const spectral::Reflectance& brdf) {
    if (brdf.wavelengths().size() != bands)
        throw out_of_range("number of wavelengths of a .pbsdf file",
                           static_cast<double>(brdf.wavelengths().size()), "", "5");
    std::vector<std::uint16_t> result;
    for (const double um : brdf.wavelengths().micrometres()) {
        const double nm = std::round(um * 1000);
        if (!(std::abs(um * 1000 - nm) <= 1e-6 * nm && nm >= 1 && nm <= 65535))
            throw out_of_range("wavelength of a .pbsdf file", um, "um",
                               "a whole number of nanometres, up to 65.535 um");
        result.push_back(static_cast<std::uint16_t>(nm));
    }
    return result;
}

/// Nodes where `at` takes 0 ... 1.
template <class At>
std::vector<float> nodes(int count, const At& at) {
    std::vector<float> result;
    result.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        result.push_back(static_cast<float>(at(static_cast<double>(i) / (count - 1))));
    return result;
}

struct Axes {
    Axes(const PbsdfResolution& resolution, double slope)
        : theta_h{nodes(resolution.theta_h,
                        [&](double x) { return slope * std::sinh(x * std::asinh(pi / 2 / slope)); })},
          theta_d{nodes(resolution.theta_d, [](double x) { return pi / 2 * (1 - std::pow(1 - x, 1.5)); })},
          phi_d{nodes(resolution.phi_d, [](double x) { return (2 * x - 1) * pi; })} {}

    std::vector<float> theta_h, theta_d, phi_d;
};

/// On the horizon or above it.
Direction raised(Vector3 v) {
    return Direction::from_vector({v.x, v.y, std::max(v.z, 1e-4)});
}

/// Matrices [theta_h][wavelength][element] of one theta_d and phi_d.
class RowWriter {
  public:
    explicit RowWriter(const spectral::Reflectance& brdf) : brdf_{brdf}, matrices_(bands) {}

    void operator()(const std::vector<float>& theta_h, float theta_d, float phi_d, float* row) {
        for (const float theta : theta_h) {
            const HalfAnglesPair pair{
                {static_cast<double>(theta), static_cast<double>(theta_d), static_cast<double>(phi_d)}};
            const DirectionPair seen{raised(pair.in), raised(pair.out)};
            brdf_.mueller(seen, matrices_);
            for (const Mueller& matrix : matrices_) {
                const auto turned = in_right_handed_frames(matrix, seen.in, seen.out, across(seen.in, pair.x),
                                                           across(seen.out, pair.x));
                row = std::transform(turned.elements().begin(), turned.elements().end(), row,
                                     [](double value) { return static_cast<float>(value); });
            }
        }
    }

  private:
    /// x made perpendicular to a direction, which differs from the pair's only behind the horizon.
    static Vector3 across(const Direction& direction, Vector3 x) {
        const Vector3 w = direction.vector();
        const Vector3 part = x - dot(x, w) * w;
        return (1 / std::sqrt(dot(part, part))) * part;
    }

    const spectral::Reflectance& brdf_;
    std::vector<Mueller> matrices_;
};

std::vector<float> matrices(const spectral::Reflectance& brdf, const Axes& axes) {
    const std::size_t row = axes.theta_h.size() * bands * elements, rows = axes.theta_d.size();
    std::vector<float> result(axes.phi_d.size() * rows * row);
    spectral::parallel_for(axes.phi_d.size(), [&](std::size_t p) {
        RowWriter write{brdf};
        for (std::size_t d = 0; d < rows; ++d)
            write(axes.theta_h, axes.theta_d[d], axes.phi_d[p], result.data() + (p * rows + d) * row);
    });
    return result;
}

// ---- reading

/// The content of a file, checked.
struct PbsdfFile {
    std::vector<float> theta_h, theta_d, phi_d;
    std::vector<std::uint16_t> nanometres;
    std::vector<float> matrices;

    explicit PbsdfFile(const TensorFile& file)
        : theta_h{axis(file, "theta_h")},
          theta_d{axis(file, "theta_d")},
          phi_d{axis(file, "phi_d")},
          nanometres{file.words("wvls")} {
        if (nanometres.size() != bands) throw file.error("wvls", "must be 5 wavelengths");
        for (std::size_t i = 0; i < bands; ++i)
            if (nanometres[i] == 0 || (i > 0 && nanometres[i] <= nanometres[i - 1]))
                throw file.error("wvls", "must be positive and increase");
        FloatTensor tensor = file.floats("M", 6, NotFinite::kept);
        if (tensor.shape != TensorShape{phi_d.size(), theta_d.size(), theta_h.size(), bands, 4, 4})
            throw file.error("M", "must have a 4 x 4 matrix per phi_d, theta_d, theta_h and wavelength");
        matrices = std::move(tensor.numbers);
    }

  private:
    static std::vector<float> axis(const TensorFile& file, const char* name) {
        FloatTensor tensor = file.floats(name, 2);
        if (tensor.shape[0] != 1) throw file.error(name, "must be a single row");
        for (std::size_t i = 1; i < tensor.numbers.size(); ++i)
            if (!(tensor.numbers[i] > tensor.numbers[i - 1])) throw file.error(name, "must increase");
        return std::move(tensor.numbers);
    }
};

spectral::WavelengthGrid grid_of(const std::vector<std::uint16_t>& nanometres) {
    std::vector<double> um;
    um.reserve(nanometres.size());
    for (const std::uint16_t nm : nanometres) um.push_back(nm / 1000.0);
    return spectral::WavelengthGrid::from_micrometres(std::move(um));
}

class PolarisedTable final : public spectral::Evaluator {
  public:
    PolarisedTable(std::string name, PbsdfFile file)
        : spectral::Evaluator{std::move(name), grid_of(file.nanometres)}, file_{std::move(file)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        const Corners corners = above_horizon(pair) ? corners_of(pair) : Corners{};
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double value = corners.mixed(file_.matrices, k * elements);
            values[k] = value > 0 ? value : 0;
        }
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0.0);
    }
    [[nodiscard]] spectral::Properties properties() const override {
        return {.polarised = true, .isotropic = true};
    }

    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        const Corners corners = above_horizon(pair) ? corners_of(pair) : Corners{};
        const Vector3 x = scattering_plane_normal(pair);
        for (std::size_t k = 0; k < values.size(); ++k) {
            std::array<double, elements> matrix{};
            for (std::size_t e = 0; e < elements; ++e)
                matrix[e] = corners.mixed(file_.matrices, k * elements + e);
            const bool usable =
                matrix[0] > 0 && std::ranges::all_of(matrix, [](double m) { return std::isfinite(m); });
            values[k] = usable
                            ? in_right_handed_frames(Mueller::from_elements(matrix), pair.in, pair.out, x, x)
                            : Mueller{};  // that change of frames is its own inverse
        }
    }

  private:
    /// The eight nodes around a point and their shares.
    struct Corners {
        std::array<std::size_t, 8> offset{};
        std::array<double, 8> share{};

        [[nodiscard]] double mixed(const std::vector<float>& numbers, std::size_t at) const noexcept {
            double sum = 0;
            for (std::size_t i = 0; i < 8; ++i)
                if (share[i] != 0) sum += share[i] * static_cast<double>(numbers[offset[i] + at]);
            return sum;
        }
    };

    static bool above_horizon(const DirectionPair& pair) noexcept {
        return pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0;
    }

    [[nodiscard]] Corners corners_of(const DirectionPair& pair) const noexcept {
        const HalfAngles angles = half_angles(pair);
        const Between h = between(file_.theta_h, static_cast<float>(angles.theta_h));
        const Between d = between(file_.theta_d, static_cast<float>(angles.theta_d));
        const Between p = between(file_.phi_d, static_cast<float>(angles.phi_d));
        Corners corners;
        for (std::size_t i = 0; i < 8; ++i) {
            const auto share = [&](const Between& along, bool next) {
                return static_cast<double>(next ? along.weight : 1 - along.weight);
            };
            const bool next_p = (i & 4) != 0, next_d = (i & 2) != 0, next_h = (i & 1) != 0;
            corners.share[i] = share(p, next_p) * share(d, next_d) * share(h, next_h);
            const auto node = [&](const Between& along, bool next, const std::vector<float>& axis) {
                return std::min(along.index + (next ? 1U : 0U), axis.size() - 1);
            };
            corners.offset[i] =
                ((node(p, next_p, file_.phi_d) * file_.theta_d.size() + node(d, next_d, file_.theta_d)) *
                     file_.theta_h.size() +
                 node(h, next_h, file_.theta_h)) *
                bands * elements;
        }
        return corners;
    }

    PbsdfFile file_;
};

}  // namespace

Exported exported_pbsdf(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                        const PbsdfResolution& resolution) {
    require("number of theta_h", resolution.theta_h);
    require("number of theta_d", resolution.theta_d);
    require("number of phi_d", resolution.phi_d);
    if (!brdf.properties().isotropic)
        throw Error{brdf.name() + " is anisotropic: a .pbsdf file must be of an isotropic reflectance"};
    if (!brdf.properties().polarised)
        throw Error{brdf.name() +
                    " has no Mueller matrix: must be polarised (model he, without a specular box)"};
    const auto nanometres = whole_nanometres(brdf);
    const double slope = lobe_slope(brdf);
    const Axes axes{resolution, slope};
    TensorFileWriter file;
    file.add("theta_h", {1, axes.theta_h.size()}, axes.theta_h);
    file.add("theta_d", {1, axes.theta_d.size()}, axes.theta_d);
    file.add("phi_d", {1, axes.phi_d.size()}, axes.phi_d);
    file.add("wvls", {bands}, nanometres);
    file.add("M", {axes.phi_d.size(), axes.theta_d.size(), axes.theta_h.size(), bands, 4, 4},
             matrices(brdf, axes));
    Sidecar sidecar{.format = "KAIST polarised tensor file (.pbsdf): Mitsuba 3 measured_polarized",
                    .value = "Mueller matrix of f, without the cosine",
                    .normalisation = "none",
                    .suggested_alpha = std::clamp(slope / std::sqrt(std::numbers::sqrt2 - 1), 1e-3, 1.0),
                    .notes = {"frames: x_in = x_out = w_light x w_view, right-handed, z along the "
                              "propagation, S3 = +1 clockwise for the receiver",
                              "isotropic, front side only",
                              "suggested_alpha is for the plugin's parameter alpha_sample"}};
    return {{{path.string(), file.bytes()}}, std::move(sidecar)};
}

void write_pbsdf(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                 const PbsdfResolution& resolution) {
    spectral::write_files(exported_pbsdf(brdf, path, resolution).files);
}

spectral::Reflectance parse_pbsdf(std::string bytes, const std::filesystem::path& path) {
    return spectral::Reflectance{std::make_shared<const PolarisedTable>(
        path.stem().string(), PbsdfFile{TensorFile::parse(std::move(bytes), path.string())})};
}

spectral::Reflectance read_pbsdf(const std::filesystem::path& path) {
    return parse_pbsdf(read_whole_file(path), path);
}

}  // namespace hts::tables
