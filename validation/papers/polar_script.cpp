#include "validation/papers/polar_script.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using spectral::brief;
using spectral::gnuplot_string;

/// Okabe and Ito's colours that stand out on white, for all kinds of colour vision; then greys.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#aa4499",
                             "#000000", "#e69f00", "#56b4e9", "#777777"};

const char* colour(std::size_t curve) {
    return colours[curve % colours.size()];
}

double largest_radius(const std::vector<PolarCurve>& curves) {
    double largest = 0;
    for (const PolarCurve& curve : curves) {
        for (const PolarPoint& point : curve.points) largest = std::max(largest, point.radius);
    }
    return largest > 0 ? largest : 1;
}

/// A circle of the grid: radius in units of the outermost, and what to write at it.
struct Ring {
    double radius;
    std::string label;
};

/// The smallest step 1, 2 or 5 x 10^n that needs at most eight rings.
double ring_step(double largest) {
    const double power = std::pow(10, std::floor(std::log10(largest)) - 1);
    for (const double step : {1.0, 2.0, 5.0, 10.0}) {
        if (largest <= 8 * step * power * (1 + 1e-9)) return step * power;
    }
    return 20 * power;
}

std::vector<Ring> linear_rings(double largest) {
    const double step = ring_step(largest);
    const int count = static_cast<int>(std::ceil(largest / step * (1 - 1e-9)));
    std::vector<Ring> rings;
    for (int i = 1; i <= count; ++i) rings.push_back({static_cast<double>(i) / count, brief(i * step)});
    return rings;
}

/// The power of ten at the outermost circle.
int top_decade(double largest) {
    return static_cast<int>(std::ceil(std::log10(largest) - 1e-9));
}

std::string power_of_ten(int exponent) {
    return "10^{" + std::to_string(exponent) + "}";
}

std::vector<Ring> decade_rings(double largest, int decades) {
    std::vector<Ring> rings;
    for (int i = 1; i <= decades; ++i) {
        rings.push_back({static_cast<double>(i) / decades, power_of_ten(top_decade(largest) - decades + i)});
    }
    return rings;
}

std::string centre_decade(double largest, int decades) {
    return "≤ " + power_of_ten(top_decade(largest) - decades);
}

/// R(v): from a value to the distance on paper, 1 at the outermost circle.
std::string radius_function(double largest, const PolarStyle& style) {
    std::ostringstream text;
    if (style.logarithmic) {
        text << "log_radius(v) = 1 + (log10(v) - (" << top_decade(largest) << ")) / " << style.decades << "\n"
             << "R(v) = v > 0 && log_radius(v) > 0 ? log_radius(v) : 0\n";
    } else {
        const double step = ring_step(largest);
        text << "R(v) = v / " << shortest(std::ceil(largest / step * (1 - 1e-9)) * step) << "\n";
    }
    return text.str();
}

void draw_frame(std::ostream& script, const std::vector<Ring>& rings, const std::string& centre) {
    script << "unset border\nunset tics\nset angles degrees\nset size ratio -1\n"
           << "set xrange [-1.32:1.32]\nset yrange [-0.44:1.44]\n"
           << "set lmargin at screen 0.02\nset rmargin at screen 0.98\n"
           << "set tmargin at screen 0.99\nset bmargin at screen 0.01\n";
    for (const Ring& ring : rings) {
        for (const int side : {-1, 1}) {
            script << "set label \"" << ring.label << "\" at " << side * ring.radius
                   << ",-0.045 center tc rgb '#444444' font ',13'\n";
        }
    }
    script << "set label \"" << centre << "\" at 0,-0.045 center tc rgb '#444444' font ',13'\n";
}

void draw_spokes(std::ostream& script) {
    for (int angle = -90; angle <= 90; angle += 15) {
        const bool axis = angle % 90 == 0;
        script << "set arrow from 0,0 to sin(" << angle << "),cos(" << angle << ") nohead lc rgb '"
               << (axis ? "#888888" : "#d8d8d8") << "' lw 1 back\n";
        if (std::abs(angle) == 90) continue;
        script << "set label '" << angle << "°' at 1.055*sin(" << angle << "),1.055*cos(" << angle
               << ") center tc rgb '#444444' font ',13'\n";
    }
    script << "set label 'light side' at -1.32,0.03 left tc rgb '#666666' font ',13'\n"
           << "set label 'mirror side' at 1.32,0.03 right tc rgb '#666666' font ',13'\n";
}

/// An arrow from the light for each curve, outside the circle.
void draw_lights(std::ostream& script, const std::vector<PolarCurve>& curves) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::string angle = shortest(-curves[i].theta_i);
        script << "set arrow from 1.29*sin(" << angle << "),1.29*cos(" << angle << ") to 1.17*sin(" << angle
               << "),1.17*cos(" << angle << ") head filled size 0.035,20,60 lc rgb '" << colour(i)
               << "' lw 2.2\n";
    }
}

void draw_texts(std::ostream& script, const PolarStyle& style) {
    script << "set label " << gnuplot_string(style.title)
           << " at -1.3,1.39 left noenhanced tc rgb '#000000' font ',17'\n";
    double height = -0.145;
    for (const std::string& caption : style.captions) {
        script << "set label " << gnuplot_string(caption) << " at 0," << height
               << " center tc rgb '#222222' font ',14'\n";
        height -= 0.075;
    }
    script << "set key at screen 0.5,0.02 bottom center horizontal width 1 samplen 2 tc rgb '#000000'\n";
}

void draw_curves(std::ostream& script, const std::vector<PolarCurve>& curves, const std::vector<Ring>& rings,
                 const PolarStyle& style) {
    script << "set datafile separator comma\nset samples 361\ndata = " << gnuplot_string(style.data_file)
           << "\nplot sample \\\n";
    for (const Ring& ring : rings) {
        script << "  [a=0:180] '+' using (" << ring.radius << "*cos(a)):(" << ring.radius
               << "*sin(a)) with lines lw 1 lc rgb '" << (ring.radius == 1 ? "#888888" : "#d8d8d8")
               << "' notitle, \\\n";
    }
    std::size_t first = 1;  // record 0 is the header
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::size_t last = first + curves[i].points.size() - 1;
        script << "  data every ::" << first << "::" << last
               << " using (R($6)*sin($2)):(R($6)*cos($2)) with lines lw 2.4 lc rgb '" << colour(i)
               << "' title 'θ_i = " << shortest(curves[i].theta_i) << "°'"
               << (i + 1 < curves.size() ? ", \\\n" : "\n");
        first = last + 1;
    }
}

}  // namespace

std::string polar_script(const std::vector<PolarCurve>& curves, const PolarStyle& style) {
    const double largest = largest_radius(curves);
    std::ostringstream script;
    script << radius_function(largest, style);
    const auto rings = style.logarithmic ? decade_rings(largest, style.decades) : linear_rings(largest);
    draw_frame(script, rings, style.logarithmic ? centre_decade(largest, style.decades) : "0");
    draw_spokes(script);
    draw_lights(script, curves);
    draw_texts(script, style);
    draw_curves(script, curves, rings, style);
    return script.str();
}

}  // namespace hts::validation
