#include "tables/formats/mitsuba/rgl.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/mitsuba/rgl_square.hpp"
#include "tables/formats/mitsuba/tensor_file.hpp"
#include "tables/formats/points/angular_grid.hpp"
#include "tables/formats/whole_file.hpp"

namespace hts::tables {
namespace {

/// A bilinear picture per node of the parameters.
struct Pictures {
    std::vector<float> values;
    std::size_t rows = 2, columns = 2;

    [[nodiscard]] float operator()(Point2 point) const noexcept {
        return BilinearCell{point, rows, columns}.value(values.data());
    }
    /// The first and the last of every three change places: red comes first in files, blue in a reflectance.
    void reverse_threes() {
        const auto plane = static_cast<std::ptrdiff_t>(rows * columns);
        for (auto first = values.begin(); first != values.end(); first += 3 * plane)
            std::swap_ranges(first, first + plane, first + 2 * plane);
    }
};

/// The content of a file, checked.
struct RglFile {
    bool jacobian = true;
    std::vector<float> theta_i, phi_i, nanometres;  // none of a file of three channels
    Pictures ndf, sigma, vndf, luminance, spectra;

    explicit RglFile(const TensorFile& file);
};

/// Takes fields and checks them; every message names the field.
class RglFields {
  public:
    explicit RglFields(const TensorFile& file) : file_{file} {}

    [[nodiscard]] std::vector<float> increasing(const char* name, double least, double most) const {
        auto nodes = file_.floats(name, 1).numbers;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (i > 0 && !(nodes[i] > nodes[i - 1])) throw file_.error(name, "must increase");
            const auto node = static_cast<double>(nodes[i]);
            if (!(node >= least && node <= most)) {
                throw file_.error(
                    name, shortest(node) + ": must be from " + shortest(least) + " to " + shortest(most));
            }
        }
        return nodes;
    }

    /// A picture per combination of as many nodes, at least 2 x 2.
    [[nodiscard]] Pictures pictures(const char* name, const TensorShape& nodes, float least) const {
        FloatTensor tensor = file_.floats(name, nodes.size() + 2);
        const std::size_t rows = tensor.shape[nodes.size()], columns = tensor.shape[nodes.size() + 1];
        if (!std::equal(nodes.begin(), nodes.end(), tensor.shape.begin()))
            throw file_.error(name, "does not have the shape that phi_i, theta_i and wavelengths say");
        if (rows < 2 || columns < 2) throw file_.error(name, "must have at least 2 rows and 2 columns");
        for (const float value : tensor.numbers)
            if (!(value >= least))
                throw file_.error(name, shortest(static_cast<double>(value)) +
                                            ": must be >= " + shortest(static_cast<double>(least)));
        return {std::move(tensor.numbers), rows, columns};
    }

    /// Pictures that are densities.
    [[nodiscard]] Pictures densities(const char* name, const TensorShape& nodes) const {
        Pictures result = pictures(name, nodes, 0);
        const std::size_t size = result.rows * result.columns;
        for (std::size_t at = 0; at < result.values.size(); at += size) {
            if (!BilinearWarp::has_integral({result.values.data() + at, size}, result.rows, result.columns))
                throw file_.error(name, "slice " + std::to_string(at / size) + " has no positive integral");
        }
        return result;
    }

    void require_full_turn(const std::vector<float>& phi_i) const {
        if (phi_i.size() > 2 && !(phi_i.back() - phi_i.front() > 6.283F))
            throw file_.error("phi_i", "must span all azimuths, -pi to pi (or have at most 2: isotropic)");
    }

    [[nodiscard]] bool flag(const char* name) const {
        const auto values = file_.octets(name);
        if (values.size() != 1) throw file_.error(name, "must be one number");
        return values.front() != 0;
    }

  private:
    const TensorFile& file_;
};

RglFile::RglFile(const TensorFile& file) {
    constexpr double pi = 3.141593;  // to the single precision of the file
    const RglFields fields{file};
    const bool rgb = file.contains("rgb") && !file.contains("spectra");
    if (file.octets("description").empty()) throw file.error("description", "must be text");
    jacobian = fields.flag("jacobian");
    theta_i = fields.increasing("theta_i", 0, pi / 2);
    phi_i = fields.increasing("phi_i", -pi, pi);
    fields.require_full_turn(phi_i);
    if (!rgb) nanometres = fields.increasing("wavelengths", 1, 1e7);
    const std::size_t phis = phi_i.size(), thetas = theta_i.size();
    ndf = fields.pictures("ndf", {}, 0);
    sigma = fields.pictures("sigma", {}, 1e-30F);
    vndf = fields.densities("vndf", {phis, thetas});
    luminance = fields.densities("luminance", {phis, thetas});
    spectra = rgb ? fields.pictures("rgb", {phis, thetas, 3}, -1e30F)
                  : fields.pictures("spectra", {phis, thetas, nanometres.size()}, -1e30F);
    if (rgb) spectra.reverse_threes();
    if (spectra.rows != luminance.rows || spectra.columns != luminance.columns)
        throw file.error("luminance",
                         std::string{"must have as many rows and columns as "} + (rgb ? "rgb" : "spectra"));
}

spectral::WavelengthGrid grid_of(const std::vector<float>& nanometres) {
    if (nanometres.empty()) return rgb_wavelengths();
    std::vector<double> um;
    um.reserve(nanometres.size());
    for (const float nm : nanometres) um.push_back(static_cast<double>(nm) / 1000);
    return spectral::WavelengthGrid::from_micrometres(std::move(um));
}

double usable(float value) noexcept {
    return std::isfinite(value) && value > 0 ? static_cast<double>(value) : 0;
}

constexpr double nodes_end = 1e-3;                               // [rad]: angles are written in few digits
constexpr double horizon_reached = 0.97 * std::numbers::pi / 2;  // [rad]: no slice can stand on the horizon

class MeasuredBrdf final : public RglBrdf {
  public:
    MeasuredBrdf(std::string name, RglFile file)
        : RglBrdf{std::move(name), grid_of(file.nanometres)},
          vndf_{std::move(file.vndf.values), file.vndf.rows, file.vndf.columns},
          luminance_{std::move(file.luminance.values), file.luminance.rows, file.luminance.columns},
          file_{std::move(file)} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) {
            std::ranges::fill(values, 0.0);
            return;
        }
        const HalfVector half{pair, isotropic()};
        const SliceMix mix = mix_of(half.light());
        const BilinearCell cell{vndf_.inverse(half.square(), mix).point, file_.spectra.rows,
                                file_.spectra.columns};
        const float scale = jacobian(half) / static_cast<float>(pair.out.cos_theta());
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = usable(scale * spectrum(cell, mix, k));
    }

    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0.0);
    }

    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        const double theta_i = std::atan2(pair.in.sin_theta(), pair.in.cos_theta());
        const auto last = static_cast<double>(file_.theta_i.back());
        return theta_i >= static_cast<double>(file_.theta_i.front()) - nodes_end &&
               (theta_i <= last + nodes_end || last > horizon_reached);
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override {
        std::vector<double> theta_i;
        for (const float node : file_.theta_i)
            theta_i.push_back(static_cast<double>(node) * 180 / std::numbers::pi);
        return {theta_i, axis_in_words("theta_i", theta_i) + ", all views"};
    }
    [[nodiscard]] spectral::Properties properties() const override { return {.isotropic = isotropic()}; }

    [[nodiscard]] double density(const DirectionPair& pair) const noexcept override {
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return 0;
        const HalfVector half{pair, isotropic()};
        const SliceMix mix = mix_of(half.light());
        const WarpedPoint warped = vndf_.inverse(half.square(), mix);
        return usable(warped.density * luminance_.density(warped.point, mix) / half.solid_angle());
    }

    [[nodiscard]] Draw sample(const Direction& in, double u1, double u2) const noexcept override {
        const LightAngles light{in};
        const SliceMix mix = mix_of(light);
        const WarpedPoint bright = luminance_.sample({static_cast<float>(u1), static_cast<float>(u2)}, mix);
        const Vector3 m = half_vector(vndf_.sample(bright.point, mix).point, isotropic() ? light.phi : 0);
        const Vector3 out = 2 * dot(in.vector(), m) * m - in.vector();
        if (!(out.z > 0)) return {out, 0};
        return {out, density({in, Direction::from_unit_vector(out)})};
    }

  private:
    [[nodiscard]] bool isotropic() const noexcept { return file_.phi_i.size() <= 2; }
    [[nodiscard]] SliceMix mix_of(const LightAngles& light) const noexcept {
        return slice_mix(between(file_.phi_i, light.phi), between(file_.theta_i, light.theta),
                         file_.phi_i.size(), file_.theta_i.size());
    }
    [[nodiscard]] float jacobian(const HalfVector& half) const noexcept {
        if (!file_.jacobian) return 1;
        return file_.ndf(half.square()) / (4 * file_.sigma(half.light().square()));
    }
    [[nodiscard]] float spectrum(const BilinearCell& cell, const SliceMix& mix,
                                 std::size_t k) const noexcept {
        const std::size_t size = file_.spectra.rows * file_.spectra.columns;
        float sum = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (mix.share[i] == 0) continue;
            const std::size_t slice = mix.slice[i] * wavelengths().size() + k;
            sum += mix.share[i] * cell.value(file_.spectra.values.data() + slice * size);
        }
        return sum;
    }

    BilinearWarp vndf_, luminance_;
    RglFile file_;
};

}  // namespace

bool is_rgb_rgl(std::string_view head) {
    using namespace std::string_view_literals;
    return head.find("\3\0rgb"sv) !=
           std::string_view::npos;  // a field of that name, and its length before it
}

std::unique_ptr<RglBrdf> parse_rgl(std::string bytes, const std::filesystem::path& path) {
    return std::make_unique<MeasuredBrdf>(path.stem().string(),
                                          RglFile{TensorFile::parse(std::move(bytes), path.string())});
}

std::unique_ptr<RglBrdf> read_rgl(const std::filesystem::path& path) {
    return parse_rgl(read_whole_file(path), path);
}

}  // namespace hts::tables
