#include "validation/curves/comparison_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using spectral::brief;
using spectral::gnuplot_string;

constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"};
constexpr const char* measured_style = "pt 7 ps 0.34 lw 0.7 lc rgb '#444444'";
constexpr const char* model_style = "lw 2.2 lc rgb '#d55e00'";

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
            const bool has_log = model > 0 && p.value > 0;
            table.rows.push_back({static_cast<double>(number), curve.fixed_angle(), curve.swept_angle(p),
                                  facet_tilt(p), p.value, p.uncertainty, model,
                                  has_log ? std::log(model / p.value) : std::nan("")});
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

std::string files(const ComparisonPicture& picture) {
    return "points = " + gnuplot_string(picture.stem + "-points.csv") +
           "\nlines = " + gnuplot_string(picture.stem + "-lines.csv") + "\n";
}

std::string swept_label(const CurveSet& set) {
    if (scattered(set)) return "tilt of the mirroring facet [deg]";
    return set.curves.front().sweep == Sweep::incident ? "incidence [deg], mirror side > 0"
                                                       : "view [deg], mirror side > 0";
}

std::string value_label(const CurveSet& set) {
    const std::string names[] = {"BRDF", "BRDF cos θ_r", "reflectance factor"};
    if (set.scale == Scale::specular)
        return names[static_cast<int>(set.quantity)] + " over that in the mirror direction";
    return names[static_cast<int>(set.quantity)] + " [" + unit(set.quantity) + "]";
}

std::string fixed_name(const Curve& curve) {
    return curve.sweep == Sweep::incident ? "viewer at " : "light at ";
}

/// Title and legend of a page.
std::string frame(const ComparisonPicture& picture, const std::string& legend) {
    return page_label(picture.set.surface + ", " + picture.by(), 0.03, 0.965, 15) +
           page_label(picture.model, 0.03, 0.92, 11) + page_label(legend, 0.03, 0.025, 11);
}

/// Powers of ten around all positive values.
struct Decades {
    int first = 0, last = 0;

    [[nodiscard]] std::string range() const {
        return "[1e" + std::to_string(first) + ":1e" + std::to_string(last) + "]";
    }
};

/// Around what was measured of a curve, within eight decades of the largest.
Decades decades_of(const Curve& curve) {
    double least = HUGE_VAL, most = 0;
    for (const CurvePoint& p : curve.points) {
        most = std::max(most, p.value);
        if (p.value > 0) least = std::min(least, p.value);
    }
    if (!(most > 0)) return {-1, 1};
    const int last = static_cast<int>(std::ceil(std::log10(most) + 0.05));
    const int first = static_cast<int>(std::floor(std::log10(least) - 0.05));
    return {std::max(first, last - 8), last};
}

/// Where a panel stands on the page: `count` of them in rows below the title.
struct Grid {
    explicit Grid(std::size_t count)
        : columns{count == 1
                      ? 1
                      : static_cast<std::size_t>(std::ceil(std::sqrt(1.3 * static_cast<double>(count))))},
          rows{(count + columns - 1) / columns} {}
    void place(std::ostream& script, std::size_t i) const {
        const double width = 0.97 / static_cast<double>(columns), height = 0.82 / static_cast<double>(rows);
        script << "set size " << width << ',' << height << "\nset origin "
               << 0.015 + width * static_cast<double>(i % columns) << ','
               << 0.895 - height * static_cast<double>(i / columns + 1) << '\n';
    }
    std::size_t columns, rows;
};

void panel(std::ostream& script, const ComparisonPicture& picture, std::size_t number) {
    const Curve& curve = picture.set.curves[number];
    const bool uncertain = !picture.set.uncertainty.empty(), lines = curve.sweep != Sweep::scattered;
    const std::string of_curve = "($1==" + std::to_string(number) + " ? $" + (lines ? "3" : "4") + " : NaN)";
    const std::string title = lines ? fixed_name(curve) + brief(curve.fixed_angle()) + "°" : "";
    script << "set title " << gnuplot_string(title) << " offset 0,-0.7 font ',11'\nset yrange "
           << decades_of(curve).range() << "\nplot ";
    if (lines) {
        script << "lines every ::1 using ($1==" << number << " ? $3 : NaN):4 with lines " << model_style;
    } else {
        script << "points every ::1 using " << of_curve << ":7 with points pt 2 ps 0.6 " << model_style;
    }
    script << " notitle, \\\n     ";
    // bars and dots apart: gnuplot's own error bars wipe out what lies about each dot
    if (uncertain)
        script << "points every ::1 using " << of_curve
               << ":($5 > $6 ? $5 - $6 : $5 / 100):(0):($5 > $6 ? 2*$6 : $5 + $6) "
               << "with vectors nohead lw 0.8 lc rgb '#999999' notitle, \\\n     ";
    script << "points every ::1 using " << of_curve << ":5 with points " << measured_style
           << " notitle\nunset label\n";
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
    const std::size_t few = std::min(candidates.size(), colours.size());
    for (std::size_t i = 0; i < few; ++i)
        result.push_back(candidates[few == 1 ? 0 : i * (candidates.size() - 1) / (few - 1)]);
    return result;
}

/// How values become radii, 1 at the outermost circle; larger ones, of a model's peak, are cut off just
/// outside.
struct Radius {
    double largest = 0;
    int decades = 0;  // 0: linear

    static constexpr int rings = 4;
    [[nodiscard]] std::string function() const {
        const std::string over = "(v / " + shortest(largest) + ")";
        const std::string linear =
            decades == 0 ? over : "(v > 0 ? 1 + log10" + over + " / " + std::to_string(decades) + " : 0)";
        return "L(v) = " + linear + "\nR(v) = L(v) < 0 ? 0 : L(v) > 1.08 ? 1.08 : L(v)\n";
    }
    [[nodiscard]] std::string label(int ring) const {
        const double part = static_cast<double>(ring) / rings;
        return brief(decades == 0 ? largest * part : largest * std::pow(10, decades * (part - 1)), 2);
    }
    [[nodiscard]] std::string text() const {
        return decades == 0 ? "" : ", logarithmic, " + std::to_string(decades) + " decades";
    }
};

/// Linear where the largest value is less than thirty times the middle one.
Radius radius_of(const CurveSet& set, const std::vector<std::size_t>& shown) {
    std::vector<double> values;
    for (const std::size_t number : shown)
        for (const CurvePoint& p : set.curves[number].points)
            if (p.value > 0) values.push_back(p.value);
    if (values.empty()) return {1, 0};
    std::sort(values.begin(), values.end());
    const double most = values.back(), low = values[values.size() / 20];
    if (most < 30 * values[values.size() / 2]) return {most, 0};
    return {most, std::clamp(static_cast<int>(std::ceil(std::log10(most / low))) + 1, 1, 8)};
}

void polar_frame(std::ostream& script, const Radius& radius) {
    script << "unset border\nunset tics\nunset grid\nset angles degrees\nset size ratio -1\nset samples 181\n"
           << "set xrange [-1.2:1.2]\nset yrange [-0.12:1.12]\nset lmargin at screen 0.03\nset rmargin at "
              "screen 0.97\n"
           << "set tmargin at screen 0.89\nset bmargin at screen 0.13\n";
    for (int angle = -90; angle <= 90; angle += 15) {
        script << "set arrow from 0,0 to sin(" << angle << "),cos(" << angle
               << ") nohead lc rgb '#dddddd' back\n"
               << "set label '" << angle << "°' at 1.06*sin(" << angle << "),1.06*cos(" << angle
               << ") center tc rgb '#555555' font ',12'\n";
    }
    for (int ring = 1; ring <= Radius::rings; ++ring)
        script << "set label '" << radius.label(ring) << "' at " << 0.25 * ring
               << ",-0.05 center tc rgb '#555555' font ',12'\n";
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
    std::ostringstream script;
    script << figure_style << files(picture)
           << frame(picture, std::string{"dots: "} + name(set.kind) + "     " +
                                 (pairs ? "crosses" : "lines") + ": model     x: " + swept_label(set) +
                                 "     y: " + value_label(set))
           << "set multiplot\nset logscale y\nset format y '10^{%L}'\nset xtics 30\nunset mytics"
           << "\nset tics font ',10'\nset bmargin 1.8\nset tmargin 1.6\nset lmargin 5\nset rmargin 1\n";
    const Grid grid{set.curves.size()};
    for (std::size_t i = 0; i < set.curves.size(); ++i) {
        grid.place(script, i);
        panel(script, picture, i);
    }
    script << "unset multiplot\n";
    return {picture.stem + "-log",
            {points_table(picture), lines_table(picture)},
            script.str(),
            set.surface + ": points " + picture.by() + " (" + set.source + "), " +
                (pairs ? "crosses " : "lines ") + picture.model + "."};
}

Figure polar_overlay(const ComparisonPicture& picture) {
    const auto shown = few_curves(picture.set);
    const Radius radius = radius_of(picture.set, shown);
    std::ostringstream script;
    script << figure_style << files(picture) << radius.function()
           << frame(picture, std::string{"dots: "} + name(picture.set.kind) +
                                 "     lines: model     radius: " + value_label(picture.set) + radius.text());
    polar_frame(script, radius);
    script << "set key at screen 0.5,0.075 bottom center horizontal samplen 2 font ',12'\nplot sample \\\n";
    for (int ring = 1; ring <= Radius::rings; ++ring)
        script << "  [a=0:180] '+' using (" << 0.25 * ring << "*cos(a)):(" << 0.25 * ring
               << "*sin(a)) with lines lc rgb '#dddddd' notitle, \\\n";
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const Curve& curve = picture.set.curves[shown[i]];
        const std::string pick = "($1==" + std::to_string(shown[i]) + " ? R(";
        script << "  points every ::1 using " << pick
               << "$5)*sin($3) : NaN):(R($5)*cos($3)) with points pt 7 ps 0.42 lc rgb '" << colours[i]
               << "' notitle, \\\n  lines every ::1 using " << pick
               << "$4)*sin($3) : NaN):(R($4)*cos($3)) with lines lw 2 lc rgb '" << colours[i] << "' title '"
               << fixed_name(curve) << brief(curve.fixed_angle()) << "°'"
               << (i + 1 < shown.size() ? ", \\\n" : "\n");
    }
    return {picture.stem + "-polar",
            {points_table(picture), lines_table(picture)},
            script.str(),
            picture.set.surface + ", in the plane of incidence: points " + picture.by() + ", lines " +
                picture.model + "."};
}

Figure residual_plot(const ComparisonPicture& picture) {
    const bool pairs = scattered(picture.set);
    std::ostringstream script;
    script << figure_style << files(picture)
           << frame(picture, "above 0 where the model is too bright; beyond ±3 drawn at the edge")
           << "set tmargin at screen 0.88\nset bmargin at screen 0.2\nset lmargin at screen 0.09\nset "
              "rmargin at screen "
           << (pairs ? 0.97 : 0.86) << "\nset xlabel " << gnuplot_string(swept_label(picture.set))
           << "\nset ylabel 'ln(model / measured)'\nset xzeroaxis lc rgb '#444444' lw 1\n"
           << "set palette defined (0 '#0072b2', 0.5 '#009e73', 1 '#e69f00')\nset cblabel '"
           << (picture.set.curves.front().sweep == Sweep::incident ? "viewer" : "light") << " [deg]'\n"
           << "set yrange [-3.1:3.1]\nr(v) = v > 3 ? 3 : v < -3 ? -3 : v\nf(x) = 0.25\ng(x) = -0.25\nplot "
              "f(x) with lines dt 2 lc rgb '#999999' title '±0.25', g(x) "
              "with lines dt 2 lc rgb '#999999' notitle, \\\n"
           << "     points every ::1 using "
           << (pairs ? "4:(r($8)) with points pt 7 ps 0.6 lc rgb '#0072b2'"
                     : "3:(r($8)):2 with points pt 7 ps 0.45 lc palette")
           << " notitle\n";
    return {picture.stem + "-residuals",
            {points_table(picture), lines_table(picture)},
            script.str(),
            "ln(model / measured) of every point; " + picture.set.surface + ", " + picture.by() + "."};
}

}  // namespace hts::validation
