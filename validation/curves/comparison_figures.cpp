#include "validation/curves/comparison_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spectral/output/script.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using spectral::brief;

constexpr std::size_t most_polar_curves = 5;

/// Tilt of the facet that mirrors light into view [deg].
double facet_tilt(const CurvePoint& point) {
    const DirectionPair pair = point.pair();
    const Vector3 half = pair.in.vector() + pair.out.vector();
    return std::atan2(std::hypot(half.x, half.y), half.z) * 180 / std::numbers::pi;
}

bool scattered(const CurveSet& set) {
    return std::all_of(set.curves.begin(), set.curves.end(),
                       [](const Curve& curve) { return curve.sweep == Sweep::scattered; });
}

/// Every point with what was computed of it.
FigureTable points_table(const ComparisonPicture& picture) {
    FigureTable table{
        picture.stem + "-points",
        {"curve", "fixed_deg", "swept_deg", "tilt_deg", "measured", "uncertainty", "model", "log_ratio"},
        {}};
    std::size_t i = 0, number = 0;
    for (const Curve& curve : picture.set.curves) {
        for (const CurvePoint& p : curve.points) {
            const double model = picture.result.model[i++];
            const auto log = log_ratio(model, p.value, picture.set.noise_floor.value_or(0));
            table.rows.push_back({static_cast<double>(number), curve.fixed_angle(), curve.swept_angle(p),
                                  facet_tilt(p), p.value, p.uncertainty, model, log.value_or(std::nan(""))});
        }
        ++number;
    }
    return table;
}

FigureTable lines_table(const ComparisonPicture& picture) {
    FigureTable table{picture.stem + "-lines", {"curve", "fixed_deg", "swept_deg", "model"}, {}};
    double number = 0;
    for (const Curve& curve : picture.lines) {
        for (const CurvePoint& p : curve.points)
            table.rows.push_back({number, curve.fixed_angle(), curve.swept_angle(p), p.value});
        ++number;
    }
    return table;
}

std::string swept_label(const CurveSet& set) {
    if (scattered(set)) return "tilt of the mirroring facet [deg]";
    return set.curves.front().sweep == Sweep::incident ? "incidence [deg], mirror side > 0"
                                                       : "view [deg], mirror side > 0";
}

std::string value_label(const CurveSet& set) {
    const std::string names[] = {"BRDF", "BRDF cos θ_r", "reflectance factor", "hemispherical reflectance"};
    if (set.scale == Scale::specular)
        return names[static_cast<int>(set.quantity)] + " over that in the mirror direction";
    return names[static_cast<int>(set.quantity)] + " [" + unit(set.quantity) + "]";
}

std::string fixed_name(const Curve& curve) {
    return curve.sweep == Sweep::incident ? "viewer at " : "light at ";
}

std::string band_name(const Band& band) {
    return band.single() ? brief(band.first) + " µm" : brief(band.first) + "–" + brief(band.last) + " µm";
}

/// What tells a curve from the others of its set: the angle that stands still, and the wavelength where there
/// are several.
std::string curve_name(const CurveSet& set, const Curve& curve) {
    const auto other = [&](const Curve& c) {
        return c.band.first != curve.band.first || c.band.last != curve.band.last;
    };
    const bool bands = std::ranges::any_of(set.curves, other);
    if (curve.sweep == Sweep::scattered) return bands ? band_name(curve.band) : "";
    return fixed_name(curve) + brief(curve.fixed_angle()) + "°" + (bands ? ", " + band_name(curve.band) : "");
}

/// Where the numbers are, and title and legend of a page.
output::Script begun(const ComparisonPicture& picture, const std::string& legend) {
    output::Script script;
    script.set("points", picture.stem + "-points.csv").set("lines", picture.stem + "-lines.csv");
    script.set("surface", picture.set.surface + ", " + picture.by());
    script.set("model", picture.model).set("legend", legend);
    return script;
}

/// Powers of ten around all positive values.
struct Decades {
    int first = 0, last = 0;
};

/// Largest and least positive value.
struct Extremes {
    double least = HUGE_VAL, most = 0;

    void hold(double value) {
        most = std::max(most, value);
        if (value > 0) least = std::min(least, value);
    }
};

/// Around what was measured of a curve and its line, which may leave the points by three decades, within
/// eight decades of the largest.
Decades decades_of(const Curve& curve, const Curve* line) {
    constexpr double far = 1e3;
    Extremes values;
    for (const CurvePoint& p : curve.points) values.hold(p.value);
    if (!(values.most > 0)) return {-1, 1};
    if (line != nullptr) {
        const auto [least, most] = values;
        for (const CurvePoint& p : line->points)
            if (p.value > 0) values.hold(std::clamp(p.value, least / far, most * far));
    }
    const int last = static_cast<int>(std::ceil(std::log10(values.most) + 0.05));
    const int first = static_cast<int>(std::floor(std::log10(values.least) - 0.05));
    return {std::max(first, last - 8), last};
}

// ---- polar

/// Up to five curves, from the first to the last; those at grazing angles, whose peaks dwarf all else, only
/// if there are no others.
std::vector<std::size_t> few_curves(const CurveSet& set) {
    constexpr double grazing = 75;
    std::vector<std::size_t> candidates, result;
    for (std::size_t i = 0; i < set.curves.size(); ++i)
        if (set.curves[i].fixed_angle() < grazing) candidates.push_back(i);
    if (candidates.empty()) candidates.push_back(0);
    const std::size_t few = std::min(candidates.size(), most_polar_curves);
    for (std::size_t i = 0; i < few; ++i)
        result.push_back(candidates[few == 1 ? 0 : i * (candidates.size() - 1) / (few - 1)]);
    return result;
}

/// How values become radii, 1 at the outermost circle, where larger ones, of a model's peak, are cut off.
struct Radius {
    double largest = 0;
    int decades = 0;  // 0: linear

    static constexpr int rings = 4;
    [[nodiscard]] std::string label(int ring) const {
        const double part = static_cast<double>(ring) / rings;
        return brief(decades == 0 ? largest * part : largest * std::pow(10, decades * (part - 1)), 2);
    }
    [[nodiscard]] std::string text() const {
        return decades == 0 ? "" : ", logarithmic, " + std::to_string(decades) + " decades";
    }
};

/// Linear where the largest value is less than thirty times the middle one. The lines may be three times as
/// large as what was measured.
Radius radius_of(const ComparisonPicture& picture, const std::vector<std::size_t>& shown) {
    std::vector<double> values;
    for (const std::size_t number : shown)
        for (const CurvePoint& p : picture.set.curves[number].points)
            if (p.value > 0) values.push_back(p.value);
    if (values.empty()) return {1, 0};
    std::sort(values.begin(), values.end());
    double most = values.back();
    const double low = values[values.size() / 20];
    for (const std::size_t number : shown) {
        if (number >= picture.lines.size()) continue;
        for (const CurvePoint& p : picture.lines[number].points)
            most = std::max(most, std::min(p.value, 3 * values.back()));
    }
    if (most < 30 * values[values.size() / 2]) return {most, 0};
    return {most, std::clamp(static_cast<int>(std::ceil(std::log10(most / low))) + 1, 1, 8)};
}

}  // namespace

std::string ComparisonPicture::by() const {
    return (set.kind == CurveKind::theory ? "computed by " : std::string{name(set.kind)} + " by ") + set.by;
}

std::vector<Curve> model_lines(const CurveSet& set, const spectral::Material& material,
                               const AveragingNodes& nodes, spectral::OutsideRange policy, double scale) {
    constexpr double step = 0.5;
    CurveSet fine = set;
    fine.curves.clear();
    for (const Curve& curve : set.curves) {
        Curve line{curve.band, curve.sweep, {}};
        double first = 90, last = -90;
        for (const CurvePoint& p : curve.points) {
            first = std::min(first, curve.swept_angle(p));
            last = std::max(last, curve.swept_angle(p));
        }
        for (int i = 0; curve.sweep != Sweep::scattered && first + i * step <= last; ++i)
            line.points.push_back(in_plane_point(curve.sweep, curve.fixed_angle(), first + i * step, 0, 0));
        fine.curves.push_back(std::move(line));
    }
    if (fine.point_count() == 0) return {};
    const std::vector<double> values = Prediction{fine, nodes}.values(material, policy);
    std::size_t next = 0;
    for (Curve& curve : fine.curves)
        for (CurvePoint& p : curve.points) p.value = scale * values[next++];
    return fine.curves;
}

Figure log_overlay(const ComparisonPicture& picture) {
    const CurveSet& set = picture.set;
    const bool pairs = scattered(set);
    auto script = begun(picture, std::string{"dots: "} + name(set.kind) + "     " +
                                     (pairs ? "crosses" : "lines") + ": model");
    script.set("across", swept_label(set)).set("upwards", value_label(set));
    std::vector<std::string> panels;
    std::vector<int> scattered_curves, least, most;
    for (std::size_t i = 0; i < set.curves.size(); ++i) {
        const Curve& curve = set.curves[i];
        scattered_curves.push_back(curve.sweep == Sweep::scattered ? 1 : 0);
        panels.push_back(curve_name(set, curve));
        const Decades decades = decades_of(curve, i < picture.lines.size() ? &picture.lines[i] : nullptr);
        least.push_back(decades.first);
        most.push_back(decades.last);
    }
    script.set("scattered", scattered_curves);
    script.set("uncertain", static_cast<int>(!set.uncertainty.empty()));
    script.set("panel", panels).set("least", least).set("most", most);
    return {picture.stem + "-log",
            {points_table(picture), lines_table(picture)},
            script.with("comparison-log"),
            set.surface + ": points " + picture.by() + " (" + set.source + "), " +
                (pairs ? "crosses " : "lines ") + picture.model + "."};
}

Figure polar_overlay(const ComparisonPicture& picture) {
    const auto shown = few_curves(picture.set);
    const Radius radius = radius_of(picture, shown);
    auto script =
        begun(picture, std::string{"dots: "} + name(picture.set.kind) +
                           "     lines: model     radius: " + value_label(picture.set) + radius.text());
    std::vector<std::string> names, rings;
    std::vector<double> angles;
    for (const std::size_t number : shown) {
        names.push_back(curve_name(picture.set, picture.set.curves[number]));
        angles.push_back(picture.set.curves[number].fixed_angle());
    }
    for (int ring = 1; ring <= Radius::rings; ++ring) rings.push_back(radius.label(ring));
    script.set("curve", shown).set("name", names).set("theta_i", angles).set("ring", rings);
    script.set("largest", radius.largest).set("decades", radius.decades);
    return {picture.stem + "-polar",
            {points_table(picture), lines_table(picture)},
            script.with("comparison-polar"),
            picture.set.surface + ", in the plane of incidence: points " + picture.by() + ", lines " +
                picture.model + "."};
}

Figure residual_plot(const ComparisonPicture& picture) {
    auto script = begun(picture, "above 0 where the model is too bright; beyond ±3 drawn at the edge");
    script.set("scattered", static_cast<int>(scattered(picture.set))).set("swept", swept_label(picture.set));
    script.set("fixed", picture.set.curves.front().sweep == Sweep::incident ? "viewer [deg]" : "light [deg]");
    return {picture.stem + "-residuals",
            {points_table(picture), lines_table(picture)},
            script.with("comparison-residuals"),
            "ln(model / measured) of every point; " + picture.set.surface + ", " + picture.by() + "."};
}

}  // namespace hts::validation
