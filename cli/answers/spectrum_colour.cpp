#include "cli/answers/spectrum_colour.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "spectral/colour/display_colour.hpp"

namespace hts::cli {
namespace {

using spectral::DisplayRgb;
using spectral::Illuminant;
using spectral::LinearRgb;
using spectral::Xyz;

std::string line(const char* part, const Xyz& colour, Illuminant illuminant) {
    const auto [x, y] = chromaticity(colour);
    const LinearRgb rgb = linear_srgb(colour, illuminant);
    const DisplayRgb display = DisplayRgb::from_linear(rgb);
    std::array<char, 320> text{};
    static_cast<void>(std::snprintf(
        text.data(), text.size(),
        "  %-22s luminance factor %.5g   XYZ %.5g %.5g %.5g   xy %.4f %.4f   linear sRGB %.5g %.5g %.5g   "
        "display %s%s\n",
        part, colour.Y, colour.X, colour.Y, colour.Z, x, y, rgb.red, rgb.green, rgb.blue,
        display.hex().c_str(), display.in_gamut() ? "" : " (clipped)"));
    return text.data();
}

nlohmann::ordered_json object(const Xyz& colour, Illuminant illuminant) {
    const auto [x, y] = chromaticity(colour);
    const LinearRgb rgb = linear_srgb(colour, illuminant);
    const DisplayRgb display = DisplayRgb::from_linear(rgb);
    nlohmann::ordered_json result;
    result["XYZ"] = {colour.X, colour.Y, colour.Z};
    result["xy"] = {x, y};
    result["luminance_factor"] = colour.Y;
    result["linear_srgb"] = {rgb.red, rgb.green, rgb.blue};
    result["display"] = display.hex();
    result["in_gamut"] = display.in_gamut();
    return result;
}

}  // namespace

std::string SpectrumColour::text() const {
    return std::string{"colour under "} + name(illuminant) + '\n' +
           line("diffuse terms (pi f)", diffuse, illuminant) +
           line("specular reflectance", specular, illuminant);
}

std::string SpectrumColour::json() const {
    nlohmann::ordered_json result;
    result["illuminant"] = name(illuminant);
    result["diffuse"] = object(diffuse, illuminant);
    result["specular"] = object(specular, illuminant);
    return result.dump();
}

}  // namespace hts::cli
