#include "tables/formats/points/angular_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/parallel.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Neighbouring nodes and the share of the second.
struct Neighbours {
    std::size_t low, high;
    double share;
};

Neighbours neighbours(const std::vector<double>& nodes, double at) noexcept {
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), at);
    if (above == nodes.begin()) return {0, 0, 0};
    const auto low = static_cast<std::size_t>(above - nodes.begin()) - 1;
    if (above == nodes.end()) return {low, low, 0};
    return {low, low + 1, (at - nodes[low]) / (nodes[low + 1] - nodes[low])};
}

// On an axis that begins again after 360 degrees.
Neighbours neighbours_around(const std::vector<double>& nodes, double at) noexcept {
    const double turned = at < nodes.front() ? at + 360 : at;
    const double gap = nodes.front() + 360 - nodes.back();
    if (turned <= nodes.back() || gap <= 0) return neighbours(nodes, turned);
    return {nodes.size() - 1, 0, (turned - nodes.back()) / gap};
}

double in_turn(double azimuth) noexcept {
    return azimuth < 0 ? azimuth + 360 : azimuth;
}

// Azimuth and polar angle of the view [deg].
struct ViewAngles {
    double azimuth, polar;
};

ViewAngles view_angles(PolarAxis axis, const DirectionPair& pair) noexcept {
    const Direction &in = pair.in, &out = pair.out;
    const double x = out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi();
    const double y = out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi();
    if (axis == PolarAxis::normal)
        return {std::atan2(y, x) / degree, std::atan2(out.sin_theta(), out.cos_theta()) / degree};
    const Vector3 view{out.sin_theta() * x, out.sin_theta() * y, out.cos_theta()};
    const double along = dot(view, {-in.sin_theta(), 0, in.cos_theta()});
    const double across = dot(view, {in.cos_theta(), 0, in.sin_theta()});
    return {std::atan2(view.y, across) / degree, std::atan2(std::hypot(across, view.y), along) / degree};
}

class GriddedBrdf final : public spectral::Evaluator {
  public:
    GriddedBrdf(const std::string& name, const spectral::WavelengthGrid& wavelengths, AngularGrid grid,
                std::vector<double> values)
        : spectral::Evaluator{name, wavelengths}, grid_{std::move(grid)}, values_{std::move(values)} {
        for (std::size_t node = 0; node < grid_.size(); ++node)
            above_.push_back(grid_.pair(node).has_value());
    }

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return;
        const std::array<Neighbours, 4> axes = around(pair);
        double share = 0;
        for (unsigned corner = 0; corner < 16; ++corner) {
            double weight = 1;
            std::array<std::size_t, 4> index{};
            for (unsigned axis = 0; axis < 4; ++axis) {
                const bool up = (corner >> axis & 1) != 0;
                weight *= up ? axes[axis].share : 1 - axes[axis].share;
                index[axis] = up ? axes[axis].high : axes[axis].low;
            }
            const std::size_t node = node_at(index);
            if (weight == 0 || !above_[node]) continue;
            share += weight;
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] += weight * values_[node * values.size() + i];
        }
        if (share > 0 && share != 1)
            for (double& value : values) value /= share;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
    }

  private:
    [[nodiscard]] std::array<Neighbours, 4> around(const DirectionPair& pair) const noexcept {
        const auto [azimuth, polar] = view_angles(grid_.axis, pair);
        const double phi_i = in_turn(std::atan2(pair.in.sin_phi(), pair.in.cos_phi()) / degree);
        return {neighbours_around(grid_.phi_i, phi_i),
                neighbours(grid_.theta_i, std::atan2(pair.in.sin_theta(), pair.in.cos_theta()) / degree),
                grid_.symmetric ? neighbours(grid_.azimuth, std::abs(azimuth))
                                : neighbours_around(grid_.azimuth, in_turn(azimuth)),
                neighbours(grid_.polar, polar)};
    }
    [[nodiscard]] std::size_t node_at(const std::array<std::size_t, 4>& index) const noexcept {
        return ((index[0] * grid_.theta_i.size() + index[1]) * grid_.azimuth.size() + index[2]) *
                   grid_.polar.size() +
               index[3];
    }

    AngularGrid grid_;
    std::vector<double> values_;
    std::vector<bool> above_;  // the horizon, per node
};

void check_axis(const char* name, const std::vector<double>& nodes, double most) {
    if (nodes.empty()) throw Error{std::string{name}.append(": must have at least one value")};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!(nodes[i] >= 0 && nodes[i] <= most))
            throw out_of_range(name, nodes[i], "deg", "from 0 to " + shortest(most));
        if (i > 0 && !(nodes[i] > nodes[i - 1]))
            throw out_of_range(name, nodes[i], "deg", "> the one before it, " + shortest(nodes[i - 1]));
    }
}

}  // namespace

std::optional<DirectionPair> AngularGrid::pair(std::size_t node) const {
    const double r = polar[node % polar.size()];
    node /= polar.size();
    const double a = azimuth[node % azimuth.size()];
    node /= azimuth.size();
    const double theta = theta_i[node % theta_i.size()], phi = phi_i[node / theta_i.size()];
    const Direction in = Direction::from_degrees(theta, phi);
    if (axis == PolarAxis::normal) return DirectionPair{in, Direction::from_degrees(r, phi + a)};
    const double along = std::cos(r * degree), across = std::sin(r * degree) * std::cos(a * degree);
    const double y = std::sin(r * degree) * std::sin(a * degree);
    const double x = across * in.cos_theta() - along * in.sin_theta();
    const double z = along * in.cos_theta() + across * in.sin_theta();
    if (!(z > 0)) return std::nullopt;
    return DirectionPair{in, Direction::from_unit_vector({x * in.cos_phi() - y * in.sin_phi(),
                                                          x * in.sin_phi() + y * in.cos_phi(), z})};
}

void AngularGrid::check() const {
    check_axis("azimuth of the light", phi_i, 360);
    check_axis("polar angle of the light", theta_i, 90);
    check_axis("azimuth of the view", azimuth, symmetric ? 180 : 360);
    check_axis("polar angle of the view", polar, axis == PolarAxis::normal ? 90 : 180);
}

std::vector<double> values_on(const AngularGrid& grid, const spectral::Reflectance& brdf) {
    const std::size_t wavelengths = brdf.wavelengths().size(), row = grid.polar.size();
    std::vector<double> values(grid.size() * wavelengths, 0);
    spectral::parallel_blocks(grid.size(), row, [&](std::size_t first, std::size_t count) {
        for (std::size_t node = first; node < first + count; ++node) {
            if (const auto pair = grid.pair(node))
                brdf.brdf(*pair, std::span{values}.subspan(node * wavelengths, wavelengths));
        }
    });
    return values;
}

spectral::Reflectance gridded_brdf(const std::string& name, const spectral::WavelengthGrid& wavelengths,
                                   AngularGrid grid, std::vector<double> values) {
    grid.check();
    if (values.size() != grid.size() * wavelengths.size()) {
        throw out_of_range(
            "number of values", static_cast<double>(values.size()), "",
            std::to_string(grid.size()) + " nodes times " + std::to_string(wavelengths.size()));
    }
    for (const double value : values) {
        if (!(std::abs(value) <= largest_number))
            throw out_of_range("BRDF", value, "1/sr", "from -1e100 to 1e100");
    }
    return spectral::Reflectance{
        std::make_shared<const GriddedBrdf>(name, wavelengths, std::move(grid), std::move(values))};
}

bool is_plane_symmetric(const spectral::Reflectance& brdf) {
    constexpr int pairs = 64;
    Random random{2};
    std::vector<double> there(brdf.wavelengths().size()), here(there.size());
    for (int i = 0; i < pairs; ++i) {
        const DirectionPair pair{random.direction(0.1), random.direction(0.1)};
        // the view mirrored at the plane of the light and the normal
        const double c = pair.in.cos_phi(), s = pair.in.sin_phi();
        const Vector3 v = pair.out.vector();
        const double across = v.y * c - v.x * s;
        const Vector3 mirrored{v.x + 2 * s * across, v.y - 2 * c * across, v.z};
        brdf.brdf(pair, here);
        brdf.brdf({pair.in, Direction::from_unit_vector(mirrored)}, there);
        for (std::size_t k = 0; k < here.size(); ++k) {
            if (std::abs(here[k] - there[k]) > 1e-6 * std::max(here[k], there[k]) + 1e-18) return false;
        }
    }
    return true;
}

AngularGrid without_symmetry(AngularGrid grid) {
    grid.symmetric = false;
    for (std::size_t i = grid.azimuth.size(); i-- > 0;) {
        if (grid.azimuth[i] > 0 && grid.azimuth[i] < 180) grid.azimuth.push_back(360 - grid.azimuth[i]);
    }
    grid.azimuth.push_back(360);
    return grid;
}

}  // namespace hts::tables
