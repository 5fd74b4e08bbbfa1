#include "tables/formats/points/scatter_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/in_plane.hpp"
#include "tables/formats/points/nearest_points.hpp"
#include "tables/formats/points/tokens.hpp"
#include "tables/formats/points/two_sides.hpp"

namespace hts::tables {
namespace {

// Angles that differ by less are the same: radians of six decimals are.
double snapped(double degrees) {
    return std::round(degrees * 1e4) / 1e4;
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
        const auto& turns = grid_.azimuth;
        const auto below = [](double turn) { return turn > 0 && turn < 180; };
        grid_.symmetric = turns.back() <= 180 || std::ranges::none_of(turns, below);
        if (turns.back() > 180 && grid_.symmetric) {  // the other side was measured
            for (double& turn : grid_.azimuth) turn = azimuth_of(turn);
            sort_unique(grid_.azimuth);
        }
        grid_.of_points = true;
    }

    // The values at every node, NaN where there is no point; none if less than three in four nodes have one.
    // A view along the normal stands for all azimuths.
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
            const std::size_t azimuth = place(grid_.azimuth, azimuth_of(snapped_turn(at.phi_r - at.phi_i)));
            const std::size_t polar = place(grid_.polar, snapped(at.theta_r));
            const bool along_normal = grid_.polar[polar] == 0;
            for (std::size_t a = 0; a < grid_.azimuth.size(); ++a) {
                if (a != azimuth && !along_normal) continue;
                double* const node =
                    &values[((row * grid_.azimuth.size() + a) * grid_.polar.size() + polar) * channels];
                std::copy_n(&points_.values[i * channels], channels, node);
            }
        }
        const auto missing = std::ranges::count_if(values, [](double value) { return std::isnan(value); });
        if (4 * static_cast<std::size_t>(missing) > values.size()) return std::nullopt;
        return values;
    }
    [[nodiscard]] const AngularGrid& grid() const noexcept { return grid_; }

  private:
    [[nodiscard]] double azimuth_of(double turn) const noexcept {
        return grid_.symmetric && turn > 180 ? snapped(360 - turn) : turn;
    }
    const ScatterPoints& points_;
    AngularGrid grid_;
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

// Largest ratio of values at azimuths that stand more than 20 degrees apart, of what is not small.
double steepest_across(const AngularGrid& grid, const std::vector<double>& values, std::size_t channels) {
    const double least = 0.01 * std::accumulate(values.begin(), values.end(), 0.0,
                                                [](double a, double b) { return std::fmax(a, b); });
    double steepest = 1;
    for (std::size_t node = 0; node < grid.size(); ++node) {
        const std::size_t azimuth = node / grid.polar.size() % grid.azimuth.size();
        if (azimuth == 0 || grid.azimuth[azimuth] - grid.azimuth[azimuth - 1] <= 20) continue;
        for (std::size_t k = 0; k < channels; ++k) {
            const auto [low, high] =
                std::minmax(values[node * channels + k], values[(node - grid.polar.size()) * channels + k]);
            if (high > least && low >= 0) steepest = std::max(steepest, high / std::max(low, least));
        }
    }
    return steepest;
}

// Every pair of directions once. Rows that say the same twice count once; views along the normal, which stand
// for all azimuths, are averaged; hts::Error for others that contradict.
ScatterPoints without_repetitions(const std::string& name, const ScatterPoints& points) {
    const std::size_t channels = points.wavelengths.size();
    struct Found {
        std::size_t place;  // in the result
        std::size_t row;    // in the points
        double azimuth;
        double count = 1;
    };
    std::map<std::array<double, 4>, Found> found;
    ScatterPoints result{points.wavelengths, {}, {}, {}, points.notes};
    std::size_t same = 0, averaged = 0;
    for (std::size_t i = 0; i < points.angles.size(); ++i) {
        const ScatterAngles& at = points.angles[i];
        const double azimuth = snapped_turn(at.phi_r - at.phi_i);
        const bool along_normal = snapped(at.theta_r) == 0;
        const std::array key{snapped_turn(at.phi_i), snapped(at.theta_i), along_normal ? 0 : azimuth,
                             snapped(at.theta_r)};
        const double* const values = &points.values[i * channels];
        const auto [known, fresh] = found.emplace(key, Found{result.angles.size(), i, azimuth});
        if (fresh) {
            result.angles.push_back(at);
            result.values.insert(result.values.end(), values, values + channels);
            continue;
        }
        Found& first = known->second;
        const auto shown = [](double angle) { return spectral::brief(angle, 6); };
        double* const mean = &result.values[first.place * channels];
        if (std::equal(values, values + channels, &points.values[first.row * channels])) {
            if (!along_normal || first.azimuth == azimuth) ++same;
        } else if (along_normal && first.azimuth != azimuth) {
            ++averaged;
            first.count += 1;
            for (std::size_t k = 0; k < channels; ++k) mean[k] += (values[k] - mean[k]) / first.count;
        } else {
            throw Error{name + (points.lines.empty() ? "" : ":" + std::to_string(points.lines[i])) +
                        ": theta_i " + shown(at.theta_i) + ", phi_i " + shown(at.phi_i) + ", theta_r " +
                        shown(at.theta_r) + ", phi_r " + shown(at.phi_r) + " deg: " +
                        (points.lines.empty() ? ""
                                              : "the directions of line " +
                                                    std::to_string(points.lines[first.row]) + " again, ") +
                        "BRDF " + shortest(values[0]) + " and " +
                        shortest(points.values[first.row * channels]) + " 1/sr: must have one value"};
        }
    }
    if (same > 0)
        result.notes.push_back(
            std::to_string(same) +
            (same == 1 ? " point says again what another says" : " points say again what others say") +
            ": left out");
    if (averaged > 0)
        result.notes.push_back(std::to_string(averaged) +
                               " views along the normal repeat others with another value: averaged");
    return result;
}

bool brighter_towards_light(const ScatterPoints& points) {
    constexpr double beside = 1;  // [deg]
    TwoSides sides;
    const std::size_t each = points.wavelengths.size();
    for (std::size_t i = 0; i < points.angles.size(); ++i) {
        const ScatterAngles& at = points.angles[i];
        const double turn = std::abs(std::remainder(at.phi_r - at.phi_i, 360));
        const bool in_plane = turn < beside || turn > 180 - beside;
        const std::span values = std::span{points.values}.subspan(i * each, each);
        if (in_plane)
            sides.add(at.theta_i, at.theta_r, turn < beside,
                      std::accumulate(values.begin(), values.end(), 0.0));
    }
    return sides.brighter_towards_light();
}

}  // namespace

PointsBrdf brdf_from(const std::string& name, const ScatterPoints& given) {
    check(name, given);
    const ScatterPoints points = without_repetitions(name, given);
    std::vector<std::string> notes = points.notes;
    if (brighter_towards_light(points))
        notes.emplace_back(
            "more than twice as bright towards the light as about the mirror direction, which is "
            "taken to be at phi_i + 180 deg: are azimuths counted from the mirror direction?");
    const std::string count = std::to_string(points.angles.size()) + " points ";
    if (is_in_plane(points)) {
        notes.push_back(count +
                        "in the plane of incidence; views beside it are assumed to see what stands in it at "
                        "the same angle from the mirror direction");
        return {in_plane_brdf(name, points), PointLayout::in_plane, std::move(notes)};
    }
    const GridOfPoints grid{points};
    if (auto values = grid.values()) {
        const auto missing = std::ranges::count_if(*values, [](double value) { return std::isnan(value); });
        const double share = 1 - static_cast<double>(missing) / static_cast<double>(values->size());
        notes.push_back(count +
                        (missing == 0 ? "on a full grid"
                                      : "on a grid, " + spectral::brief(100 * share, 3) + " % of its nodes") +
                        ": linear between them");
        if (const double ratio = steepest_across(grid.grid(), *values, points.wavelengths.size());
            ratio > 3) {
            notes.push_back("values of neighbouring azimuths differ up to " + spectral::brief(ratio, 3) +
                            " times: the azimuths do not resolve the lobe");
        }
        return {gridded_brdf(name, points.wavelengths, grid.grid(), std::move(*values)), PointLayout::grid,
                std::move(notes)};
    }
    notes.push_back(count + "scattered: the eight nearest count");
    return {nearest_points_brdf(name, points), PointLayout::scattered, std::move(notes)};
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

namespace {

/// The grid where the surface needs no more of it, checked.
AngularGrid fitting(const spectral::Reflectance& brdf, AngularGrid grid) {
    grid.check();
    if (grid.axis != PolarAxis::normal)
        throw Error{"grid about the mirror direction: a file of points needs one about the normal"};
    if (grid.phi_i.size() == 1 && !brdf.properties().isotropic)
        throw Error{brdf.name() +
                    ": depends on the azimuth of the light, which must have more than one value"};
    if (grid.symmetric && !is_plane_symmetric(brdf)) {
        grid = without_symmetry(std::move(grid));
        grid.azimuth.pop_back();  // 360 is 0 again
    }
    return grid;
}

/// A row of angles and values per node.
///   unit    of a degree in the file
///   order   of the channels
std::string rows(const spectral::Reflectance& brdf, const AngularGrid& grid, double unit,
                 const std::vector<std::size_t>& order) {
    std::string text;
    const std::vector<double> values = values_on(grid, brdf);
    for (std::size_t node = 0; node < grid.size(); ++node) {
        const std::size_t row = node / grid.polar.size(), slice = row / grid.azimuth.size();
        const double phi_i = grid.phi_i[slice / grid.theta_i.size()];
        append_rounded(text, grid.theta_i[slice % grid.theta_i.size()] * unit, 9);
        for (const double angle :
             {phi_i, grid.polar[node % grid.polar.size()], phi_i + grid.azimuth[row % grid.azimuth.size()]}) {
            text += ',';
            append_rounded(text, angle * unit, 9);
        }
        for (const std::size_t channel : order) {
            text += ',';
            append_rounded(text, values[node * order.size() + channel]);
        }
        text += '\n';
    }
    return text;
}

std::vector<std::string> names_in_nanometres(const spectral::Reflectance& brdf) {
    std::vector<std::string> names;
    for (const double wavelength : brdf.wavelengths().micrometres()) {
        append_rounded(names.emplace_back(), 1000 * wavelength, 9);
        names.back() += "nm";
    }
    return names;
}

}  // namespace

std::string scatter_csv(const spectral::Reflectance& brdf, AngularGrid grid) {
    grid = fitting(brdf, std::move(grid));
    std::vector<std::size_t> order(brdf.size());
    std::iota(order.begin(), order.end(), 0U);
    std::string text = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg";
    for (const std::string& name : names_in_nanometres(brdf)) text += ",brdf_" + name;
    return text + "\n" + rows(brdf, grid, 1, order);
}

std::string scatter_astm(const spectral::Reflectance& brdf, AngularGrid grid, bool rgb) {
    if (rgb && brdf.size() != 3)
        throw out_of_range("number of channels", static_cast<double>(brdf.size()), "", "3 for R, G, B");
    grid = fitting(brdf, std::move(grid));
    std::vector<std::size_t> order(brdf.size());
    std::iota(order.begin(), order.end(), 0U);
    std::vector<std::string> names = names_in_nanometres(brdf);
    if (rgb) {
        order = {2, 1, 0};
        names = {"R", "G", "B"};
    }
    std::string text =
        "COMMENT BRDF in 1/sr without the cosine, angles in radians, written by hts\nNUM_POINTS ";
    text.append(std::to_string(grid.size())).append("\nVARS theta_i,phi_i,theta_s,phi_s");
    for (const std::string& name : names) text += "," + name;
    return text + "\n" + rows(brdf, grid, std::numbers::pi / 180, order);
}

}  // namespace hts::tables
