#include "tables/formats/points/angular_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "hts/sampling/random.hpp"
#include "spectral/parallel.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {

using spectral::brief;

namespace {

constexpr double degree = std::numbers::pi / 180;

constexpr double slack = 0.05;  // [deg]: angles are written in few digits

// Neighbouring nodes and the share of the second, and whether the data reach there.
struct Neighbours {
    std::size_t low, high;
    double share;
    bool known = true;
};

// An axis, and up to where its first and last node speak for what is beyond.
class Axis {
  public:
    ///   first, last   natural ends [deg]
    ///   coarsest      step of which half is taken beyond an end
    Axis(const std::vector<double>& nodes, double first, double last, double coarsest, double gap,
         double reach = slack)
        : nodes_{&nodes}, from_{nodes.front() - reach}, to_{nodes.back() + reach}, gap_{gap + slack} {
        if (nodes.size() < 2) return;
        const double low = nodes[1] - nodes[0], high = nodes.back() - nodes[nodes.size() - 2];
        if (low <= coarsest && nodes.front() - low / 2 <= first) from_ = first;
        if (high <= coarsest && nodes.back() + high / 2 >= last) to_ = last;
    }
    void reaches_horizon() noexcept {
        if (nodes_->back() >= 89) to_ = 90;
    }
    [[nodiscard]] Neighbours at(double angle) const noexcept {
        const std::vector<double>& nodes = *nodes_;
        const bool inside = angle >= from_ && angle <= to_;
        const auto above = std::upper_bound(nodes.begin(), nodes.end(), angle);
        if (above == nodes.begin()) return {0, 0, 0, inside};
        const auto low = static_cast<std::size_t>(above - nodes.begin()) - 1;
        if (above == nodes.end()) return {low, low, 0, inside};
        return between(low, low + 1, angle - nodes[low], nodes[low + 1] - nodes[low]);
    }
    // Begins again after 360 degrees.
    [[nodiscard]] Neighbours around(double angle) const noexcept {
        const std::vector<double>& nodes = *nodes_;
        const double turned = angle < nodes.front() ? angle + 360 : angle;
        const double gap = nodes.front() + 360 - nodes.back();
        if (turned <= nodes.back() || gap <= 0) return at(turned);
        return between(nodes.size() - 1, 0, turned - nodes.back(), gap);
    }

  private:
    [[nodiscard]] Neighbours between(std::size_t low, std::size_t high, double beyond,
                                     double gap) const noexcept {
        if (gap <= gap_) return {low, high, beyond / gap};
        const std::size_t nearer = beyond < gap / 2 ? low : high;
        return {nearer, nearer, 0, beyond <= slack || gap - beyond <= slack};
    }

    const std::vector<double>* nodes_;
    double from_, to_, gap_;
};

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
    if (axis == PolarAxis::mirror_sine) {
        const double from_mirror = view.x + in.sin_theta();
        return {std::atan2(-view.y, -from_mirror) / degree, std::hypot(from_mirror, view.y)};
    }
    const double along = dot(view, {-in.sin_theta(), 0, in.cos_theta()});
    const double across = dot(view, {in.cos_theta(), 0, in.sin_theta()});
    return {std::atan2(view.y, across) / degree, std::atan2(std::hypot(across, view.y), along) / degree};
}

class GriddedBrdf final : public spectral::Evaluator {
  public:
    GriddedBrdf(const std::string& name, const spectral::WavelengthGrid& wavelengths, AngularGrid grid,
                std::vector<double> values)
        : spectral::Evaluator{name, wavelengths},
          grid_{std::move(grid)},
          values_{std::move(values)},
          phi_i_{grid_.phi_i, 0, 360, 0, azimuth_gap()},
          theta_i_{grid_.theta_i, 0, 90, 10, polar_gap()},
          azimuth_{grid_.azimuth, 0, 180, 20, azimuth_gap()},
          polar_{polar_axis()} {
        theta_i_.reaches_horizon();
        if (about_normal()) polar_.reaches_horizon();
        const auto dark = [&](std::size_t node) {
            const auto first = values_.begin() + static_cast<std::ptrdiff_t>(node * wavelengths.size());
            return std::all_of(first, first + static_cast<std::ptrdiff_t>(wavelengths.size()),
                               [](double value) { return value == 0; });
        };
        bool empty_below = true;
        for (std::size_t node = 0; node < grid_.size(); ++node) {
            known_.push_back(grid_.pair(node).has_value());
            empty_below = empty_below && (known_.back() || dark(node));
        }
        if (!empty_below) known_.assign(grid_.size(), true);
        for (std::size_t node = 0; node < grid_.size(); ++node)
            if (std::isnan(values_[node * wavelengths.size()])) known_[node] = false;
        for (std::size_t first = 0; first < grid_.size(); first += grid_.polar.size()) fill_row(first);
    }

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return;
        const auto axes = around(pair);
        const auto add = [&](std::size_t node, double weight) {
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] += weight * values_[node * values.size() + i];
        };
        double share = for_corners(axes, true, add);
        if (share == 0 && grid_.of_points) share = for_corners(axes, false, add);
        if (share > 0 && share != 1)
            for (double& value : values) value /= share;
    }
    void specular_reflectance(const Direction& /*in*/, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
    }
    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        const std::array<Neighbours, 4> axes = around(pair);
        return std::ranges::all_of(axes, &Neighbours::known) &&
               for_corners(axes, true, [](std::size_t, double) {}) > (grid_.of_points ? 0.49 : 0);
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override {
        std::string axes = axis_in_words("theta_i", grid_.theta_i) + ", ";
        if (grid_.phi_i.size() > 1) axes += axis_in_words("phi_i", grid_.phi_i) + ", ";
        if (grid_.axis == PolarAxis::mirror_sine)
            axes += axis_in_words("|beta - beta_0|", grid_.polar, "");
        else
            axes +=
                axis_in_words(about_normal() ? "theta_r" : "angle from the mirror direction", grid_.polar);
        axes += ", " + axis_in_words(about_normal() ? "phi" : "azimuth about it", grid_.azimuth);
        if (!about_normal() && grid_.azimuth.size() == 1) axes += ", which stands for all";
        return {grid_.theta_i, axes};
    }

  private:
    [[nodiscard]] bool about_normal() const noexcept { return grid_.axis == PolarAxis::normal; }
    [[nodiscard]] Axis polar_axis() const {
        if (grid_.axis == PolarAxis::mirror_sine) return {grid_.polar, 0, 2, 0.2, 360, 1e-3};
        return {grid_.polar, 0, about_normal() ? 90.0 : 180.0, 10, polar_gap()};
    }
    [[nodiscard]] double polar_gap() const noexcept { return grid_.of_points ? largest_polar_gap : 360; }
    [[nodiscard]] double azimuth_gap() const noexcept { return grid_.of_points ? largest_azimuth_gap : 360; }
    [[nodiscard]] std::array<Neighbours, 4> around(const DirectionPair& pair) const noexcept {
        const auto [azimuth, polar] = view_angles(grid_.axis, pair);
        const double phi_i = in_turn(std::atan2(pair.in.sin_phi(), pair.in.cos_phi()) / degree);
        std::array<Neighbours, 4> axes{
            phi_i_.around(phi_i), theta_i_.at(std::atan2(pair.in.sin_theta(), pair.in.cos_theta()) / degree),
            grid_.symmetric ? azimuth_.at(std::abs(azimuth)) : azimuth_.around(in_turn(azimuth)),
            polar_.at(polar)};
        if (grid_.phi_i.size() == 1) axes[0] = {0, 0, 0};
        if (polar <= (grid_.axis == PolarAxis::mirror_sine ? 1e-3 : slack) ||
            (!about_normal() && grid_.azimuth.size() == 1))
            axes[2].known = true;
        return axes;
    }
    // Nodes that were not measured hold the value of the nearest one in their row, for who asks for it.
    void fill_row(std::size_t first) {
        const std::size_t row = grid_.polar.size(), width = wavelengths().size();
        for (std::size_t r = 0; r < row; ++r) {
            if (known_[first + r] || !grid_.of_points) continue;
            std::size_t nearest = row;
            for (std::size_t other = 0; other < row; ++other) {
                const bool nearer = nearest == row || std::abs(grid_.polar[other] - grid_.polar[r]) <
                                                          std::abs(grid_.polar[nearest] - grid_.polar[r]);
                if (known_[first + other] && nearer) nearest = other;
            }
            for (std::size_t i = 0; i < width; ++i)
                values_[(first + r) * width + i] = nearest < row ? values_[(first + nearest) * width + i] : 0;
        }
    }
    // Calls visit(node, weight) for the nodes that have a part; returns the sum of weights.
    //   known_alone   leaves out what is below the horizon or was not measured
    template <class Visit>  // NOLINTNEXTLINE(modernize-use-nodiscard): the sum is not all there is to it
    double for_corners(const std::array<Neighbours, 4>& axes, bool known_alone,
                       Visit&& visit) const noexcept {
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
            if (weight == 0 || (known_alone && !known_[node])) continue;
            share += weight;
            visit(node, weight);
        }
        return share;
    }
    [[nodiscard]] std::size_t node_at(const std::array<std::size_t, 4>& index) const noexcept {
        return ((index[0] * grid_.theta_i.size() + index[1]) * grid_.azimuth.size() + index[2]) *
                   grid_.polar.size() +
               index[3];
    }

    AngularGrid grid_;
    std::vector<double> values_;
    std::vector<bool>
        known_;  // whether a node has a part in interpolation: measured, and as a rule above the horizon
    Axis phi_i_, theta_i_, azimuth_, polar_;
};

void check_axis(const char* name, const std::vector<double>& nodes, double most, const char* unit = "deg") {
    if (nodes.empty()) throw Error{std::string{name}.append(": must have at least one value")};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!(nodes[i] >= 0 && nodes[i] <= most))
            throw out_of_range(name, nodes[i], unit, "from 0 to " + shortest(most));
        if (i > 0 && !(nodes[i] > nodes[i - 1]))
            throw out_of_range(name, nodes[i], unit, "> the one before it, " + shortest(nodes[i - 1]));
    }
}

}  // namespace

std::string axis_in_words(const char* name, const std::vector<double>& nodes, const char* unit) {
    std::string text = std::string{name} + " ";
    if (nodes.size() > 4) {
        return text + brief(nodes.front(), 6) + " to " + brief(nodes.back(), 6) + unit + " (" +
               std::to_string(nodes.size()) + " values)";
    }
    return text + brief(nodes, 6) + unit;
}

namespace {

struct Node {
    Direction in;
    Vector3 view;  // may lie below the horizon
};

Node node_of(const AngularGrid& grid, std::size_t node) {
    const auto& polar = grid.polar;
    const auto& azimuth = grid.azimuth;
    const double r = polar[node % polar.size()];
    node /= polar.size();
    const double a = azimuth[node % azimuth.size()];
    node /= azimuth.size();
    const double theta = grid.theta_i[node % grid.theta_i.size()],
                 phi = grid.phi_i[node / grid.theta_i.size()];
    const Direction in = Direction::from_degrees(theta, phi);
    if (grid.axis == PolarAxis::normal) return {in, Direction::from_degrees(r, phi + a).vector()};
    const auto turned = [&in](double x, double y, double z) {
        return Vector3{x * in.cos_phi() - y * in.sin_phi(), x * in.sin_phi() + y * in.cos_phi(), z};
    };
    if (grid.axis == PolarAxis::mirror_sine) {
        const double x = -in.sin_theta() - r * std::cos(a * degree), y = -r * std::sin(a * degree);
        const double rest = 1 - x * x - y * y;
        return {in, turned(x, y, rest > 0 ? std::sqrt(rest) : -1)};
    }
    const double along = std::cos(r * degree), across = std::sin(r * degree) * std::cos(a * degree);
    const double y = std::sin(r * degree) * std::sin(a * degree);
    const double x = across * in.cos_theta() - along * in.sin_theta();
    const double z = along * in.cos_theta() + across * in.sin_theta();
    return {in, turned(x, y, z)};
}

}  // namespace

std::optional<DirectionPair> AngularGrid::pair(std::size_t node) const {
    const auto [in, view] = node_of(*this, node);
    if (axis != PolarAxis::normal && !(view.z > 0)) return std::nullopt;
    return DirectionPair{in, Direction::from_unit_vector(view)};
}

DirectionPair AngularGrid::raised_pair(std::size_t node) const {
    constexpr double horizon = 1e-4;  // lobes are 0 on the horizon itself
    const auto [in, view] = node_of(*this, node);
    return {in, Direction::from_vector({view.x, view.y, std::max(view.z, horizon)})};
}

void AngularGrid::check() const {
    check_axis("azimuth of the light", phi_i, 360);
    check_axis("polar angle of the light", theta_i, 90);
    check_axis("azimuth of the view", azimuth, symmetric ? 180 : 360);
    if (axis == PolarAxis::mirror_sine)
        check_axis("|beta - beta_0|", polar, 2, "");
    else
        check_axis("polar angle of the view", polar, axis == PolarAxis::normal ? 90 : 180);
}

std::vector<double> values_on(const AngularGrid& grid, const spectral::Reflectance& brdf,
                              BelowHorizon below) {
    const std::size_t wavelengths = brdf.wavelengths().size(), row = grid.polar.size();
    std::vector<double> values(grid.size() * wavelengths, 0);
    spectral::parallel_blocks(grid.size(), row, [&](std::size_t first, std::size_t count) {
        for (std::size_t node = first; node < first + count; ++node) {
            const auto place = std::span{values}.subspan(node * wavelengths, wavelengths);
            if (const auto pair = grid.pair(node))
                brdf.brdf(*pair, place);
            else if (below == BelowHorizon::continued)
                brdf.brdf(grid.raised_pair(node), place);
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
        if (!(std::abs(value) <= largest_number) && !(std::isnan(value) && grid.of_points))
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
