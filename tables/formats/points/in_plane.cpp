#include "tables/formats/points/in_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "spectral/text/text.hpp"

namespace hts::tables {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double slack = 0.05;  // [deg]: angles are written in few digits

double turned(double azimuth) {
    return std::remainder(azimuth, 360);
}

// Values over the angle from the mirror direction, positive towards the normal, of one angle of incidence.
class Scan {
  public:
    struct Node {
        double from_mirror;  // [deg]
        std::size_t first;   // of its values
    };
    struct Place {
        std::size_t low, high;  // first of the values of two nodes
        double share;
        bool known;
    };
    Scan(double theta_i, std::vector<Node> nodes) : theta_i_{theta_i}, nodes_{std::move(nodes)} {
        std::ranges::sort(nodes_, {}, &Node::from_mirror);
        from_ = nodes_.front().from_mirror - slack;
        to_ = nodes_.back().from_mirror + slack;
        const std::size_t count = nodes_.size();
        const double first_step = count > 1 ? nodes_[1].from_mirror - nodes_[0].from_mirror : 0;
        const double last_step =
            count > 1 ? nodes_[count - 1].from_mirror - nodes_[count - 2].from_mirror : 0;
        if (reaches_horizon(nodes_.front().from_mirror - theta_i_ + 90, first_step)) from_ = theta_i_ - 90;
        if (reaches_horizon(90 + theta_i_ - nodes_.back().from_mirror, last_step)) to_ = theta_i_ + 90;
    }
    [[nodiscard]] double theta_i() const noexcept { return theta_i_; }
    [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }
    [[nodiscard]] Place at(double from_mirror) const noexcept {
        const bool inside = from_mirror >= from_ && from_mirror <= to_;
        const auto above = std::ranges::upper_bound(nodes_, from_mirror, {}, &Node::from_mirror);
        if (above == nodes_.begin()) return {above->first, above->first, 0, inside};
        const auto below = above - 1;
        if (above == nodes_.end()) return {below->first, below->first, 0, inside};
        const double gap = above->from_mirror - below->from_mirror, beyond = from_mirror - below->from_mirror;
        if (gap <= largest_polar_gap + slack) return {below->first, above->first, beyond / gap, true};
        const std::size_t nearer = (beyond < gap / 2 ? below : above)->first;
        return {nearer, nearer, 0, beyond <= slack || gap - beyond <= slack};
    }

  private:
    // left   from the end of the scan to the horizon [deg]
    static bool reaches_horizon(double left, double step) noexcept {
        return left <= 1 || (step <= 10 && left <= step / 2);
    }
    double theta_i_, from_, to_;
    std::vector<Node> nodes_;
};

// The scans of one azimuth of the light.
struct Plane {
    double phi_i;
    std::vector<Scan> scans;  // by theta_i
};

std::vector<Plane> planes_of(const ScatterPoints& points) {
    std::map<double, std::map<double, std::vector<Scan::Node>>> nodes;
    double normal_azimuth = 0;  // of the plane of a scan with light along the normal
    bool has_azimuth = false;
    for (const ScatterAngles& at : points.angles) {
        if (at.theta_i > slack || at.theta_r <= slack || has_azimuth) continue;
        normal_azimuth = turned(at.phi_r - at.phi_i);
        if (std::abs(normal_azimuth) > 90) normal_azimuth = turned(normal_azimuth + 180);
        has_azimuth = true;
    }
    for (std::size_t i = 0; i < points.angles.size(); ++i) {
        const ScatterAngles& at = points.angles[i];
        const double zero = at.theta_i > slack ? 0 : normal_azimuth;
        const bool towards_light = std::abs(turned(at.phi_r - at.phi_i - zero)) < 90;
        const double phi_i =
            at.theta_i > slack ? std::round((at.phi_i - 360 * std::floor(at.phi_i / 360)) * 20) / 20 : 0;
        const double theta_i = std::round(at.theta_i * 1e4) / 1e4;  // one scan, whatever the last digit
        nodes[phi_i >= 360 ? 0 : phi_i][theta_i].push_back(
            {towards_light ? at.theta_i + at.theta_r : at.theta_i - at.theta_r,
             i * points.wavelengths.size()});
    }
    std::vector<Plane> planes;
    for (auto& [phi_i, by_theta] : nodes) {
        planes.push_back({phi_i, {}});
        for (auto& [theta_i, scan] : by_theta) planes.back().scans.emplace_back(theta_i, std::move(scan));
    }
    return planes;
}

// A part of a value and where it stands.
struct Part {
    std::size_t first;
    double weight;
};

// Up to 2 azimuths of the light, 2 angles of incidence, 2 sides, 2 nodes.
struct Parts {
    std::array<Part, 16> list;
    std::size_t count = 0;
    bool known = false;

    void add(const Scan::Place& place, double weight) noexcept {
        if (weight * (1 - place.share) > 0) list[count++] = {place.low, weight * (1 - place.share)};
        if (weight * place.share > 0) list[count++] = {place.high, weight * place.share};
    }
};

// The view as seen from the mirror direction.
struct View {
    double delta, cos_psi;  // [deg]
};

class InPlaneBrdf final : public spectral::Evaluator {
  public:
    InPlaneBrdf(const std::string& name, const ScatterPoints& points)
        : spectral::Evaluator{name, points.wavelengths}, planes_{planes_of(points)}, values_{points.values} {}

    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        std::ranges::fill(values, 0);
        if (!(pair.in.cos_theta() > 0) || !(pair.out.cos_theta() > 0)) return;
        const Parts parts = parts_of(pair);
        double sum = 0;
        for (std::size_t k = 0; k < parts.count; ++k) {
            sum += parts.list[k].weight;
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] += parts.list[k].weight * values_[parts.list[k].first + i];
        }
        if (sum > 0)
            for (double& value : values) value /= sum;
    }
    [[nodiscard]] bool knows(const DirectionPair& pair) const noexcept override {
        return parts_of(pair).known;
    }
    [[nodiscard]] spectral::MeasuredDomain domain() const override {
        std::vector<double> theta_i, phi_i, from_mirror;
        for (const Plane& plane : planes_) {
            phi_i.push_back(plane.phi_i);
            for (const Scan& scan : plane.scans) {
                theta_i.push_back(scan.theta_i());
                for (const auto& node : scan.nodes()) from_mirror.push_back(node.from_mirror);
            }
        }
        for (auto* axis : {&theta_i, &from_mirror}) {
            std::ranges::sort(*axis);
            axis->erase(std::unique(axis->begin(), axis->end()), axis->end());
        }
        std::string axes = axis_in_words("theta_i", theta_i);
        if (phi_i.size() > 1) axes += ", " + axis_in_words("phi_i", phi_i);
        return {theta_i, axes + ", " + axis_in_words("angle from the mirror direction", from_mirror) +
                             ", which grows towards the normal"};
    }

  private:
    static View view_of(const DirectionPair& pair) noexcept {
        const Direction &in = pair.in, &out = pair.out;
        const double x = out.sin_theta() * (out.cos_phi() * in.cos_phi() + out.sin_phi() * in.sin_phi());
        const double y = out.sin_theta() * (out.sin_phi() * in.cos_phi() - out.cos_phi() * in.sin_phi());
        const double along = out.cos_theta() * in.cos_theta() - x * in.sin_theta();
        const double towards_normal = out.cos_theta() * in.sin_theta() + x * in.cos_theta();
        const double across = std::hypot(towards_normal, y);
        return {std::atan2(across, along) / degree, across > 0 ? towards_normal / across : 1};
    }
    // Both sides of a scan; whether the view is known by it.
    static bool add_sides(const Scan& scan, double theta_i, const View& view, double weight,
                          Parts& parts) noexcept {
        const Scan::Place near = scan.at(view.delta), far = scan.at(-view.delta);
        const double near_weight = (1 + view.cos_psi) / 2;
        if (near.known || !far.known)
            parts.add(near, far.known == near.known ? weight * near_weight : weight);
        if (far.known || !near.known)
            parts.add(far, far.known == near.known ? weight * (1 - near_weight) : weight);
        const bool on_near_side = view.cos_psi > 0;
        if (on_near_side ? near.known : far.known) return true;
        const bool below_horizon = view.delta > (on_near_side ? 90 + theta_i : 90 - theta_i);
        return below_horizon && (near.known || far.known);
    }
    // One azimuth of the light; whether the view is known by it.
    static bool add_plane(const Plane& plane, double theta_i, const View& view, double weight,
                          Parts& parts) noexcept {
        const auto& scans = plane.scans;
        const auto above = std::ranges::upper_bound(scans, theta_i, {}, &Scan::theta_i);
        if (above == scans.begin() || above == scans.end()) {
            const Scan& end = above == scans.begin() ? scans.front() : scans.back();
            const bool within = std::abs(theta_i - end.theta_i()) <= slack;
            return add_sides(end, theta_i, view, weight, parts) && within;
        }
        const Scan &low = *(above - 1), &high = *above;
        const double gap = high.theta_i() - low.theta_i();
        double share = (theta_i - low.theta_i()) / gap;
        const bool close = gap <= largest_polar_gap + slack;
        if (!close) share = share < 0.5 ? 0 : 1;
        const bool within = close || std::min(theta_i - low.theta_i(), high.theta_i() - theta_i) <= slack;
        // one that does not know the view leaves it to the other
        Parts by_low, by_high;
        const bool low_knows = add_sides(low, theta_i, view, 1, by_low);
        const bool high_knows = add_sides(high, theta_i, view, 1, by_high);
        if (low_knows != high_knows) share = high_knows ? 1 : 0;
        for (const auto& [from, part] : {std::pair{&by_low, 1 - share}, {&by_high, share}})
            for (std::size_t k = 0; k < from->count && part > 0; ++k)
                parts.list[parts.count++] = {from->list[k].first, weight * part * from->list[k].weight};
        return within && (low_knows || high_knows);
    }
    [[nodiscard]] Parts parts_of(const DirectionPair& pair) const noexcept {
        Parts parts;
        const double theta_i = std::atan2(pair.in.sin_theta(), pair.in.cos_theta()) / degree;
        const View view = view_of(pair);
        if (planes_.size() == 1) {
            parts.known = add_plane(planes_.front(), theta_i, view, 1, parts);
            return parts;
        }
        double phi_i = std::atan2(pair.in.sin_phi(), pair.in.cos_phi()) / degree;
        if (phi_i < planes_.front().phi_i) phi_i += 360;
        const auto above = std::ranges::upper_bound(planes_, phi_i, {}, &Plane::phi_i);
        const Plane& low = above == planes_.begin() ? planes_.back() : *(above - 1);
        const Plane& high = above == planes_.end() ? planes_.front() : *above;
        const double gap = high.phi_i - low.phi_i + (above == planes_.end() ? 360 : 0);
        double share = std::clamp((phi_i - low.phi_i) / gap, 0.0, 1.0);
        const bool close = gap <= largest_azimuth_gap + slack;
        const bool within = close || std::min(share, 1 - share) * gap <= slack;
        if (!close) share = share < 0.5 ? 0 : 1;
        bool known = within;
        if (share < 1) known = add_plane(low, theta_i, view, 1 - share, parts) && known;
        if (share > 0) known = add_plane(high, theta_i, view, share, parts) && known;
        parts.known = known;
        return parts;
    }

    std::vector<Plane> planes_;
    std::vector<double> values_;
};

}  // namespace

bool is_in_plane(const ScatterPoints& points) {
    std::optional<double> along_normal;
    for (const ScatterAngles& at : points.angles) {
        if (at.theta_r <= slack) continue;
        const double azimuth = at.phi_r - at.phi_i;
        if (at.theta_i <= slack && !along_normal) along_normal = azimuth;
        if (std::abs(std::remainder(azimuth - (at.theta_i > slack ? 0 : *along_normal), 180)) > slack)
            return false;
    }
    return true;
}

spectral::Reflectance in_plane_brdf(const std::string& name, const ScatterPoints& points) {
    return spectral::Reflectance{std::make_shared<const InPlaneBrdf>(name, points)};
}

}  // namespace hts::tables
