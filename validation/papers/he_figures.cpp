#include "validation/papers/he_figures.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/text/text.hpp"
#include "validation/papers/polar_script.hpp"

namespace hts::validation {
namespace {

using spectral::built_in_optical_constants;
using spectral::DiffuseAlbedo;
using spectral::he_torrance_material;
using spectral::Material;

constexpr double paper_solid_angle = std::numbers::pi / 1024;  // sr
constexpr auto theory_only = "Theory only: the paper's measured curves are not available.";

Material roughened_aluminium() {
    return he_torrance_material("roughened aluminium, σ₀ = 0.28 µm, τ = 1.77 µm", {0.28, 1.77},
                                built_in_optical_constants("Al"));
}

Material ceramic() {
    return he_torrance_material("magnesium-oxide ceramic, σ₀ = 1.45 µm, τ = 13.2 µm, a = 0.9", {1.45, 13.2},
                                built_in_optical_constants("MgO"), DiffuseAlbedo{0.9});
}

Material sandpaper() {
    return he_torrance_material("220-grit sandpaper, σ₀/τ = 4.4", {44, 10},
                                built_in_optical_constants("Al2O3"));
}

Material plastic() {
    return he_torrance_material("smooth blue plastic, a = 0.15", {0, 1},
                                spectral::OpticalConstants::constant({1.54, 0}), DiffuseAlbedo{0.15});
}

std::string stem(const HeFigure& figure) {
    return "he-figure-" + std::to_string(figure.number);
}

FigureTable table(const HeFigure& figure, const std::vector<PolarCurve>& curves) {
    FigureTable numbers{stem(figure),
                        {"theta_i_deg", "view_angle_deg", "directional_diffuse", "uniform_diffuse",
                         "specular_average_per_sr", "radius"},
                        {}};
    for (const PolarCurve& curve : curves) {
        for (const PolarPoint& point : curve.points) {
            numbers.rows.push_back({curve.theta_i, point.view_angle, point.directional_diffuse,
                                    point.uniform_diffuse, point.specular, point.radius});
        }
    }
    return numbers;
}

std::string title(const HeFigure& figure) {
    return "Fig. " + std::to_string(figure.number) + ": " + figure.material.name() +
           ", λ = " + shortest(figure.wavelength) + " µm";
}

std::string polar_figure(const HeFigure& figure, const std::vector<PolarCurve>& curves) {
    return polar_script(curves,
                        {title(figure),
                         {"radius: BRDF / BRDF in the specular direction, eq. 11; peaks averaged over "
                          "cones of π/1024 sr",
                          theory_only},
                         stem(figure) + ".csv"});
}

/// BRDF against the view angle, as in Fig. 11.
std::string semilogarithmic_figure(const HeFigure& figure, const std::vector<PolarCurve>& curves) {
    output::Script script;
    script.set("title", title(figure)).set("data", stem(figure) + ".csv");
    script.set("caption", std::string{"Peaks averaged over cones of π/1024 sr. "} + theory_only);
    return set_curves(script, curves).with("he-figure-11");
}

Figure drawn(const HeFigure& figure) {
    std::vector<PolarCurve> curves;
    for (const double theta_i : figure.theta_i) curves.push_back(figure.curve(theta_i));
    return {stem(figure),
            {table(figure, curves)},
            figure.radius == PolarRadius::normalised ? polar_figure(figure, curves)
                                                     : semilogarithmic_figure(figure, curves),
            "After Fig. " + std::to_string(figure.number) + " of He et al. 1991: " + figure.material.name() +
                ". " + theory_only};
}

}  // namespace

spectral::Reflectance HeFigure::reflectance() const {
    return material.at(Wavelength::from_micrometres(wavelength),
                       {.tolerance = Tolerance{hts::accuracy::finest_tolerance}});
}

PolarCurve HeFigure::curve(double degrees) const {
    return polar_curve(reflectance(), degrees, 0, EqualCones{paper_solid_angle}, radius);
}

HeFigure he_figure(int number) {
    switch (number) {
        case 7:
            return {7, roughened_aluminium(), 2.0, {10, 45, 75}, PolarRadius::normalised};
        case 8:
            return {8, roughened_aluminium(), 0.5, {10, 30, 45, 60, 75}, PolarRadius::normalised};
        case 9:
            return {9, ceramic(), 0.5, {10, 45, 60, 75}, PolarRadius::normalised};
        case 10:
            return {10, sandpaper(), 0.55, {0}, PolarRadius::normalised};
        case 11:
            return {11, plastic(), 0.46, {15, 30, 45, 60}, PolarRadius::absolute};
        default:
            throw out_of_range("figure of He et al. 1991", number, "", "from 7 to 11");
    }
}

std::vector<Figure> he_figures() {
    std::vector<Figure> figures;
    for (const int number : {7, 8, 9, 10, 11}) figures.push_back(drawn(he_figure(number)));
    return figures;
}

}  // namespace hts::validation
