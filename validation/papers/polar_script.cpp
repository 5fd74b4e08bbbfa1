#include "validation/papers/polar_script.hpp"

#include <algorithm>
#include <cmath>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using spectral::brief;

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

}  // namespace

output::Script& set_curves(output::Script& script, const std::vector<PolarCurve>& curves) {
    std::vector<double> angles;
    std::vector<std::size_t> first, last;
    std::size_t record = 1;  // 0 is the header
    for (const PolarCurve& curve : curves) {
        angles.push_back(curve.theta_i);
        first.push_back(record);
        record += curve.points.size();
        last.push_back(record - 1);
    }
    return script.set("theta_i", angles).set("first", first).set("last", last);
}

std::string polar_script(const std::vector<PolarCurve>& curves, const PolarStyle& style) {
    const double largest = largest_radius(curves), step = ring_step(largest);
    const auto rings = style.logarithmic ? decade_rings(largest, style.decades) : linear_rings(largest);
    std::vector<double> radii;
    std::vector<std::string> labels;
    for (const Ring& ring : rings) {
        radii.push_back(ring.radius);
        labels.push_back(ring.label);
    }
    output::Script script;
    script.set("title", style.title).set("captions", style.captions).set("data", style.data_file);
    script.set("ring", radii).set("ring_label", labels);
    if (style.logarithmic) {
        const int top = top_decade(largest);
        script.set("decades", style.decades).set("top", top);
        script.set("middle", "≤ " + power_of_ten(top - style.decades));
    } else {
        script.set("decades", 0).set("middle", "0");
        script.set("largest", std::ceil(largest / step * (1 - 1e-9)) * step);
    }
    return set_curves(script, curves).with("polar");
}

std::string sine_script(const std::vector<SineCurve>& curves, const std::string& title,
                        const std::string& data_file) {
    std::vector<double> angles;
    std::vector<std::size_t> first, middle, last;
    std::size_t record = 1;  // 0 is the header
    double largest = 0;
    for (const SineCurve& curve : curves) {
        angles.push_back(curve.theta_i);
        first.push_back(record);
        middle.push_back(record + curve.beyond.size());
        last.push_back(middle.back() + curve.within.size() - 1);
        record = last.back() + 1;
        double most = 0;
        for (const auto* side : {&curve.beyond, &curve.within})
            for (const SinePoint& point : *side) most = std::max(most, point.brdf());
        if (curve.beyond.empty() || !(most > 0)) {
            throw Error{"BRDF at theta_i " + shortest(curve.theta_i) +
                        " deg is 0: nothing to draw on a logarithmic axis"};
        }
        largest = std::max(largest, most);
    }
    const double top = std::pow(10, top_decade(largest));
    output::Script script;
    script.set("title", title).set("data", data_file).set("theta_i", angles).set("top", top);
    return script.set("first", first).set("middle", middle).set("last", last).with("sine");
}

}  // namespace hts::validation
