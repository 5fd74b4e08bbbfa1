#include "validation/curves/digitised.hpp"

#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "validation/curves/curve_json.hpp"

namespace hts::validation {
namespace {

using spectral::JsonValue;

Pixel operator-(Pixel a, Pixel b) {
    return {a.x - b.x, a.y - b.y};
}

double cross(Pixel a, Pixel b) {
    return a.x * b.y - a.y * b.x;
}

double length(Pixel a) {
    return std::hypot(a.x, a.y);
}

void require_apart(const char* axis, const FigureAxes::Mark& a, const FigureAxes::Mark& b) {
    if (length(a.at - b.at) > 0 && a.value != b.value) return;
    throw Error{
        std::string{axis}.append(" axis: two marks at the same pixel or of the same value: must differ")};
}

void require_positive(bool logarithmic, double value) {
    if (logarithmic && !(value > 0)) throw out_of_range("value on a logarithmic axis", value, "", "> 0");
}

/// Clockwise from straight up [deg].
double bearing(Pixel from, Pixel to) {
    return std::atan2(to.x - from.x, from.y - to.y) * 180 / std::numbers::pi;
}

std::vector<double> numbers(const JsonValue& list, const std::string& shape, std::size_t count) {
    std::vector<double> result;
    for (const JsonValue& item : list.items()) result.push_back(item.number());
    if (result.size() != count) throw list.error("must be " + shape);
    return result;
}

std::vector<FigureAxes::Mark> marks(const JsonValue& axis) {
    std::vector<FigureAxes::Mark> result;
    for (const auto& row : axis.rows({"px", "py", "value"}))
        result.push_back({{row.values[0], row.values[1]}, row.values[2]});
    if (result.size() != 2) throw axis.error(std::to_string(result.size()) + " marks: must be 2");
    return result;
}

bool is_logarithmic(const JsonValue& axes) {
    const JsonValue scale = axes["value_scale"];
    if (scale.text() != "linear" && scale.text() != "log")
        throw scale.error(spectral::in_quotes(scale.text()) + ": must be linear or log");
    return scale.text() == "log";
}

FigureAxes cartesian_axes(const JsonValue& axes) {
    axes.require_keys_among({"type", "angle", "value", "value_scale"});
    const auto angle = marks(axes["angle"]), value = marks(axes["value"]);
    return spectral::located(axes.place(), [&] {
        return FigureAxes::cartesian(angle[0], angle[1], value[0], value[1], is_logarithmic(axes));
    });
}

FigureAxes polar_axes(const JsonValue& axes) {
    axes.require_keys_among({"type", "centre", "centre_value", "reference", "value_scale"});
    const auto centre = numbers(axes["centre"], "[px, py]", 2);
    const auto at = numbers(axes["reference"], "[px, py, deg, value]", 4);
    return spectral::located(axes.place(), [&] {
        return FigureAxes::polar({{centre[0], centre[1]}, axes["centre_value"].number()}, {at[0], at[1]},
                                 {at[2], at[3]}, is_logarithmic(axes));
    });
}

FigureAxes axes_from(const JsonValue& axes) {
    const JsonValue type = axes["type"];
    if (type.text() == "cartesian") return cartesian_axes(axes);
    if (type.text() == "polar") return polar_axes(axes);
    throw type.error(spectral::in_quotes(type.text()) + ": must be cartesian or polar");
}

Curve curve_from(const JsonValue& curve, const FigureAxes& axes, double reading_px) {
    curve.require_keys_among({"wavelength_um", "band_um", "theta_i_deg", "pixels"});
    Curve result{band_from(curve), Sweep::outgoing, {}};
    const double theta_i = curve["theta_i_deg"].number();
    for (const auto& row : curve["pixels"].rows({"px", "py"})) {
        const Pixel pixel{row.values[0], row.values[1]};
        const auto [angle, value] = axes(pixel);
        if (!(std::abs(angle) <= 90))
            throw Error{row.place + ": " + out_of_range("angle", angle, "deg", "-90 ... 90 deg").what()};
        if (!(value >= 0)) throw Error{row.place + ": " + out_of_range("value", value, "", ">= 0").what()};
        result.points.push_back(
            in_plane_point(Sweep::outgoing, theta_i, angle, value, reading_px * axes.value_per_pixel(pixel)));
    }
    return result;
}

}  // namespace

FigureAxes FigureAxes::cartesian(const Mark& angle_1, const Mark& angle_2, const Mark& value_1,
                                 const Mark& value_2, bool logarithmic) {
    require_apart("angle", angle_1, angle_2);
    require_apart("value", value_1, value_2);
    const Pixel across = angle_2.at - angle_1.at, up = value_2.at - value_1.at;
    if (!(std::abs(cross(across, up)) > 1e-3 * length(across) * length(up)))
        throw Error{"angle and value axes: parallel: must not be"};
    for (const Mark& mark : {value_1, value_2}) require_positive(logarithmic, mark.value);
    FigureAxes axes;
    axes.logarithmic_ = logarithmic;
    axes.angle_1_ = angle_1;
    axes.angle_2_ = angle_2;
    axes.value_1_ = value_1;
    axes.value_2_ = value_2;
    return axes;
}

FigureAxes FigureAxes::polar(const Mark& centre, Pixel reference, const FigureReading& at_reference,
                             bool logarithmic) {
    const Mark value{reference, at_reference.value};
    require_apart("value", centre, value);
    require_positive(logarithmic, centre.value);
    require_positive(logarithmic, value.value);
    FigureAxes axes;
    axes.polar_ = true;
    axes.logarithmic_ = logarithmic;
    axes.value_1_ = centre;
    axes.value_2_ = value;
    axes.angle_1_ = {reference, at_reference.angle};
    return axes;
}

double FigureAxes::value_at(double position) const noexcept {
    const double a = value_1_.value, b = value_2_.value;
    return logarithmic_ ? a * std::pow(b / a, position) : a + (b - a) * position;
}

FigureReading FigureAxes::operator()(Pixel pixel) const noexcept {
    if (polar_) {
        const double position = length(pixel - value_1_.at) / length(value_2_.at - value_1_.at);
        const double turn = bearing(value_1_.at, pixel) - bearing(value_1_.at, angle_1_.at);
        return {std::remainder(angle_1_.value + turn, 360), value_at(position)};
    }
    // the pixel in the frame of both axes, which may be askew
    const Pixel across = angle_2_.at - angle_1_.at, up = value_2_.at - value_1_.at;
    const double determinant = cross(across, up);
    const double right = cross(pixel - angle_1_.at, up) / determinant;
    const double high = cross(across, pixel - value_1_.at) / determinant;
    return {angle_1_.value + right * (angle_2_.value - angle_1_.value), value_at(high)};
}

double FigureAxes::value_per_pixel(Pixel pixel) const noexcept {
    const double span = length(value_2_.at - value_1_.at);
    const double slope = logarithmic_ ? (*this)(pixel).value * std::log(value_2_.value / value_1_.value)
                                      : value_2_.value - value_1_.value;
    return std::abs(slope) / span;
}

std::vector<Curve> digitised_curves(const std::filesystem::path& path) {
    const JsonValue file = JsonValue::read(path);
    file.require_keys_among({"axes", "reading_px", "curves"});
    const FigureAxes axes = axes_from(file["axes"]);
    const JsonValue reading = file["reading_px"];
    if (!(reading.number() > 0)) throw reading.error(shortest(reading.number()) + ": must be > 0");
    std::vector<Curve> curves;
    for (const JsonValue& curve : file["curves"].items())
        curves.push_back(curve_from(curve, axes, reading.number()));
    return curves;
}

}  // namespace hts::validation
