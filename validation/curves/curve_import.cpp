#include "validation/curves/curve_import.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/two_sides.hpp"
#include "validation/curves/digitised.hpp"
#include "validation/curves/import_formats.hpp"
#include "validation/curves/reciprocity.hpp"

namespace hts::validation {
namespace {

namespace fs = std::filesystem;

/// Angle between two vectors of length 1 [deg].
double apart(Vector3 a, Vector3 b) {
    return std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * 180 / std::numbers::pi;
}

double from_mirror(const CurvePoint& point) {
    const DirectionPair pair = point.pair();
    return apart(pair.in.mirror().vector(), pair.out.vector());
}

/// A reason to leave a point out, and how many it met.
struct Reason {
    std::string text;
    std::size_t count = 0;
};

/// Says which points stay.
class Filter {
  public:
    explicit Filter(Selection keep) : keep_{std::move(keep)} {}

    bool keeps(const CurvePoint& p) {
        const Selection& k = keep_;
        const auto [least, most] = std::minmax(p.theta_i, p.theta_r);
        if (k.positive_only && !(p.value > 0)) return reject(0);
        if (least < k.least_theta || most > k.largest_theta) return reject(1);
        const DirectionPair pair = p.pair();
        if (apart(pair.in.vector(), pair.out.vector()) < k.least_apart) return reject(2);
        if (from_mirror(p) < k.least_from_mirror) return reject(3);
        const double turn = std::abs(std::remainder(p.phi_r - p.phi_i, 360));
        if (k.in_plane_only && turn != 0 && turn != 180) return reject(4);
        return true;
    }
    /// What was left out, for the reader of the file.
    [[nodiscard]] std::vector<std::string> notes() const {
        std::vector<std::string> result;
        for (const Reason& reason : reasons_)
            if (reason.count > 0)
                result.push_back("left out: " + std::to_string(reason.count) + " values " + reason.text);
        return result;
    }

  private:
    bool reject(std::size_t reason) {
        ++reasons_.at(reason).count;
        return false;
    }
    Selection keep_;
    std::array<Reason, 5> reasons_{
        Reason{"that are 0 or negative"},
        Reason{"with a polar angle outside " + shortest(keep_.least_theta) + " ... " +
               shortest(keep_.largest_theta) + " deg"},
        Reason{"with light and viewer less than " + shortest(keep_.least_apart) + " deg apart"},
        Reason{"less than " + shortest(keep_.least_from_mirror) + " deg from the mirror direction"},
        Reason{"out of the plane of incidence"}};
};

std::vector<ImportedPoint> points_in(const fs::path& path, const ImportRecipe& recipe) {
    if (recipe.format == ImportFormat::csv) return read_csv_points(path, recipe);
    return recipe.format == ImportFormat::fred ? read_fred_points(path, recipe)
                                               : read_astm_points(path, recipe);
}

/// What `checked` would say without the line; `lowest` is the least value that is taken for noise about 0.
void check_value(const CurvePoint& p, double lowest, bool uncertain) {
    if (!(p.value >= lowest))
        throw out_of_range("value", p.value, "",
                           ">= 0, or noise about 0 of at most 5 % of the largest value; larger noise by the "
                           "recipe's \"noise_floor\"");
    if (uncertain && !(p.uncertainty > 0)) throw out_of_range("uncertainty", p.uncertainty, "", "> 0");
    for (const double theta : {p.theta_i, p.theta_r})
        if (!(theta >= 0 && theta <= 90)) throw out_of_range("polar angle", theta, "deg", "0 ... 90 deg");
}

bool same_curve(const Curve& curve, const ImportedPoint& p) {
    if (curve.band.first != p.band.first || curve.band.last != p.band.last) return false;
    if (curve.sweep == Sweep::scattered) return true;
    return curve.fixed_angle() == (curve.sweep == Sweep::incident ? p.point.theta_r : p.point.theta_i);
}

/// Points by band and by the angle that stands still, in the file's order.
std::vector<Curve> grouped(const std::vector<ImportedPoint>& points, Sweep sweep) {
    std::vector<Curve> curves;
    for (const ImportedPoint& p : points) {
        auto curve =
            std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return same_curve(c, p); });
        if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{p.band, sweep, {}});
        curve->points.push_back(p.point);
    }
    for (Curve& curve : curves) {
        if (sweep == Sweep::scattered) continue;
        std::stable_sort(curve.points.begin(), curve.points.end(),
                         [&](const CurvePoint& a, const CurvePoint& b) {
                             return curve.swept_angle(a) < curve.swept_angle(b);
                         });
    }
    return curves;
}

Curve thinned(const Curve& curve, const Selection& keep) {
    const auto largest =
        std::max_element(curve.points.begin(), curve.points.end(),
                         [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
    Curve result{curve.band, curve.sweep, {}};
    for (auto p = curve.points.begin(); p != curve.points.end(); ++p) {
        const bool in_turn = (p - curve.points.begin()) % keep.every == 0;
        if (in_turn || p == largest || from_mirror(*p) < keep.all_within) result.points.push_back(*p);
    }
    return result;
}

/// To three significant digits, which is more than an uncertainty has.
double rounded(double value) {
    return spectral::number_in(spectral::brief(value, 3));
}

/// Where the uncertainties come from, beside rounding; empty where nobody knows.
std::string uncertainty_source(const CurveSet& set, const ImportRecipe& recipe, double relative,
                               std::size_t pairs) {
    const bool own = set.curves.front().points.front().uncertainty > 0;
    if (own) return "as the file states it, column " + spectral::in_quotes(recipe.values.front().uncertainty);
    if (recipe.relative_uncertainty > 0)
        return spectral::brief(relative, 3) + " of the value, as the recipe states";
    if (relative == 0) return "";
    return spectral::brief(relative, 3) + " of the value, from " + std::to_string(pairs) +
           " reciprocal pairs of the data themselves";
}

/// Of all points, from what the file, the recipe or the data themselves say, and from rounding.
void add_uncertainty(CurveSet& set, const ImportRecipe& recipe) {
    const Reciprocity pairs = recipe.uncertainty_from_reciprocity ? reciprocity(set) : Reciprocity{};
    if (recipe.uncertainty_from_reciprocity && pairs.pairs == 0)
        set.notes.emplace_back("no uncertainties from reciprocity: no two points swap light and viewer");
    const double relative = std::max(recipe.relative_uncertainty, pairs.relative_uncertainty());
    const double rounding = recipe.resolution / std::sqrt(12.0);
    const std::string source = uncertainty_source(set, recipe, relative, pairs.pairs);
    if (source.empty() && rounding > 0)
        set.notes.push_back("values printed in steps of " + spectral::brief(recipe.resolution) +
                            "; how far they can be trusted beyond that is not known, so no uncertainties");
    if (source.empty()) return;
    set.uncertainty = "one standard deviation: " + source;
    if (rounding > 0)
        set.uncertainty += ", and values printed in steps of " + spectral::brief(recipe.resolution);
    const double floor = std::max(rounding, relative > 0 ? set.noise_floor.value_or(0) : 0);
    for (Curve& curve : set.curves) {
        for (CurvePoint& p : curve.points)
            p.uncertainty = rounded(std::hypot(p.uncertainty, relative * p.value, floor));
    }
}

/// The least value that may be noise about 0: not more than 5 % of the largest below it.
double lowest_noise(const std::vector<ImportedPoint>& points) {
    double largest = 0;
    for (const ImportedPoint& p : points) largest = std::max(largest, p.point.value);
    return -0.05 * largest;
}

/// Standard deviation of noise about 0 that values below 0 show; none if there are none.
std::optional<double> noise_of(const std::vector<ImportedPoint>& points) {
    double squares = 0;
    std::size_t count = 0;
    for (const ImportedPoint& p : points) {
        if (!(p.point.value < 0)) continue;
        squares += p.point.value * p.point.value;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(count));
}

/// The points that the recipe keeps; bad ones are errors only where it would keep them.
std::vector<ImportedPoint> selected(const std::vector<ImportedPoint>& points, const ImportRecipe& recipe,
                                    const fs::path& path, CurveSet& head) {
    Filter filter{recipe.selection};
    const bool stated = head.noise_floor.has_value();
    if (!stated && !recipe.selection.positive_only) head.noise_floor = noise_of(points);
    const double lowest = stated ? -std::numeric_limits<double>::infinity() : lowest_noise(points);
    const bool uncertain = !recipe.values.empty() && !recipe.values.front().uncertainty.empty();
    std::size_t negative = 0;
    std::vector<ImportedPoint> kept;
    std::map<std::array<double, 6>, std::size_t> lines;
    for (const ImportedPoint& p : points) {
        spectral::located(path.string() + ":" + std::to_string(p.line), [&] {
            if (p.point.value <= 0 && recipe.selection.positive_only) {
                static_cast<void>(filter.keeps(p.point));
                return;
            }
            check_value(p.point, lowest, uncertain);
            if (!filter.keeps(p.point)) return;
            const CurvePoint& q = p.point;
            const double turn = std::abs(std::remainder(q.phi_r - q.phi_i, 360));
            if (recipe.sweep != Sweep::scattered && turn != 0 && turn != 180) {
                throw Error{
                    "azimuth " + shortest(turn) +
                    " deg from the light, out of the plane of incidence: the recipe's key \"sweep\" must be "
                    "scattered, or \"keep.in_plane_only\" true"};
            }
            const std::array place{p.band.first, p.band.last, q.theta_i, q.phi_i, q.theta_r, q.phi_r};
            const auto [first, fresh] = lines.emplace(place, p.line);
            if (!fresh)
                throw Error{"the same directions as on line " + std::to_string(first->second) +
                            ": must stand once"};
            kept.push_back(p);
            negative += p.point.value < 0 ? 1U : 0U;
        });
    }
    if (kept.empty())
        throw Error{path.string() + ": the recipe keeps none of its " + std::to_string(points.size()) +
                    " values: must keep one"};
    if (negative == 0 && !stated) head.noise_floor.reset();
    if (head.noise_floor)
        head.notes.push_back(std::to_string(negative) +
                             " values below 0 kept as noise about 0 of standard deviation " +
                             spectral::brief(*head.noise_floor, 3) +
                             (stated ? ", as the recipe states" : ", their own root mean square"));
    for (std::string& note : filter.notes()) head.notes.push_back(std::move(note));
    return kept;
}

bool brighter_towards_light(const CurveSet& set) {
    if (set.quantity == Quantity::hemispherical_reflectance) return false;
    tables::TwoSides sides;
    for (const Curve& curve : set.curves) {
        if (curve.sweep == Sweep::scattered) continue;
        for (const CurvePoint& point : curve.points)
            sides.add(point.theta_i, point.theta_r, point.side() < 0, point.value);
    }
    return sides.brighter_towards_light();
}

}  // namespace

CurveSet imported_curves(const fs::path& path, const ImportRecipe& recipe, const std::string& how) {
    CurveSet set = recipe.head;
    set.stem = path.stem().string();
    set.how = how;
    if (recipe.format == ImportFormat::digitised) {
        set.curves = digitised_curves(path);
        set.uncertainty = "one standard deviation: the reading of a pixel along the axis of values";
        return checked(std::move(set), path.string());
    }
    if (recipe.emissivity) set.notes.emplace_back("values are 1 less the emissivities of the file");
    if (!recipe.row_column.empty())
        set.notes.push_back("rows whose " + recipe.row_column + " is " + recipe.row_text);
    set.curves = grouped(selected(points_in(path, recipe), recipe, path, set), recipe.sweep);
    add_uncertainty(set, recipe);
    if (brighter_towards_light(set))
        set.notes.emplace_back(
            "more than twice as bright on the light's side of the normal as on the mirror's: "
            "is mirror_sign, or mirror_azimuth_deg, right?");
    set = checked(std::move(set), path.string());
    const std::size_t before = set.point_count();
    for (Curve& curve : set.curves) curve = thinned(curve, recipe.selection);
    if (set.point_count() < before)
        set.notes.push_back("thinned: " + std::to_string(set.point_count()) + " of " +
                            std::to_string(before) + " values kept");
    return checked(std::move(set), path.string());
}

}  // namespace hts::validation
