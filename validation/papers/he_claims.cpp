// What the text of He et al. 1991 says of its Figs 7 to 11, and what comes out.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/energy/energy.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/text/text.hpp"
#include "validation/papers/he_figures.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

using spectral::brief;

/// The point of a curve at a view angle that it has.
const PolarPoint& at(const PolarCurve& curve, double view_angle) {
    return *std::min_element(
        curve.points.begin(), curve.points.end(), [=](const PolarPoint& a, const PolarPoint& b) {
            return std::abs(a.view_angle - view_angle) < std::abs(b.view_angle - view_angle);
        });
}

const PolarPoint& specular_point(const PolarCurve& curve) {
    return at(curve, curve.theta_i);
}

/// Where a term is largest.
template <class Term>
const PolarPoint& maximum(const PolarCurve& curve, const Term& term) {
    return *std::max_element(curve.points.begin(), curve.points.end(),
                             [&](const PolarPoint& a, const PolarPoint& b) { return term(a) < term(b); });
}

double brdf(const PolarPoint& point) {
    return point.brdf();
}

/// Share of the specular term in the light that the first surface reflects.
double specular_share(const spectral::Material& material, double um, double degrees) {
    const auto terms =
        material.at(Wavelength::from_micrometres(um)).albedo(Direction::from_degrees(degrees, 0), 0);
    return terms.specular / (terms.specular + terms.directional_diffuse);
}

bool rises(const std::vector<double>& values) {
    return std::is_sorted(values.begin(), values.end()) && values.front() < values.back();
}

Check both_components() {
    const PolarCurve curve = he_figure(7).curve(10);
    const PolarPoint& peak = specular_point(curve);
    const PolarPoint& lobe = maximum(
        curve, [&](const PolarPoint& point) { return point.specular > 0 ? 0 : point.directional_diffuse; });
    const double share = specular_share(he_figure(7).material, 2, 10);
    return {
        "Fig. 7, 10 deg: specular and directional diffuse components both show: the peak is mostly specular, "
        "and the lobe beside it reaches 5 % of its radius",
        "specular " + brief(peak.specular) + ", directional diffuse " + brief(peak.directional_diffuse) +
            " 1/sr at the peak, lobe " + brief(100 * lobe.radius, 3) + " % of the radius; " +
            brief(100 * share, 3) + " % of the reflected light is specular",
        peak.specular > peak.directional_diffuse && lobe.radius >= 0.05};
}

Check strong_specular() {
    std::vector<double> ratios;
    for (const double theta_i : he_figure(7).theta_i) {
        const PolarCurve curve = he_figure(7).curve(theta_i);
        const PolarPoint& peak = specular_point(curve);
        ratios.push_back(peak.specular / peak.directional_diffuse);
    }
    return {
        "Fig. 7: strong specular reflection at 2 um: in the peak the specular term exceeds the lobe at 10, "
        "45 and 75 deg",
        "by factors of " + brief(ratios), *std::min_element(ratios.begin(), ratios.end()) > 1};
}

Check off_specular_maxima() {
    std::vector<double> maxima;
    bool larger = true;
    for (const double theta_i : {10.0, 30.0, 45.0, 60.0}) {
        maxima.push_back(maximum(he_figure(8).curve(theta_i), brdf).view_angle);
        larger = larger && maxima.back() > theta_i;
    }
    return {
        "Fig. 8: for 10, 30, 45 and 60 deg the reflected intensity is maximal at larger-than-specular angles",
        "at " + brief(maxima, 4) + " deg", larger};
}

Check specular_peak_at_75() {
    const PolarCurve curve = he_figure(8).curve(75);
    const PolarPoint& peak = specular_point(curve);
    const double maximal = maximum(curve, brdf).view_angle;
    return {"Fig. 8, 75 deg: a specular peak emerges: it exceeds the lobe there and is the maximum",
            "specular " + brief(peak.specular) + ", directional diffuse " + brief(peak.directional_diffuse) +
                " 1/sr, maximum at " + brief(maximal) + " deg",
            peak.specular > peak.directional_diffuse && std::abs(maximal - 75) <= 1};
}

Check strong_lobe() {
    std::vector<double> shares;
    for (const double theta_i : {10.0, 30.0, 45.0, 60.0}) {
        shares.push_back(100 * (1 - specular_share(he_figure(8).material, 0.5, theta_i)));
    }
    return {
        "Fig. 8: a strong directional diffuse pattern at 0.5 um: at 10 to 60 deg it carries 95 % of the "
        "reflected light",
        brief(shares) + " %", *std::min_element(shares.begin(), shares.end()) >= 95};
}

Check nearly_uniform() {
    const PolarCurve curve = he_figure(9).curve(10);
    const auto within = [](const PolarPoint& point) { return std::abs(point.view_angle) <= 75; };
    const double largest =
        maximum(curve, [&](const PolarPoint& p) { return within(p) ? p.brdf() : 0; }).brdf();
    const double smallest =
        maximum(curve, [&](const PolarPoint& p) { return within(p) ? 1 / p.brdf() : 0; }).brdf();
    const double uniform = 100 * specular_point(curve).uniform_diffuse / specular_point(curve).brdf();
    return {
        "Fig. 9, 10 deg: nearly uniform diffuse: within 75 deg the BRDF varies by less than a factor of 1.5",
        "largest/smallest " + brief(largest / smallest) + "; the uniform term is " + brief(uniform, 3) +
            " % in the specular direction",
        largest / smallest < 1.5};
}

Check emerging_peak() {
    std::vector<double> heights, angles;
    for (const double theta_i : he_figure(9).theta_i) {
        const PolarCurve curve = he_figure(9).curve(theta_i);
        const PolarPoint& peak = maximum(curve, brdf);
        heights.push_back(peak.brdf() / peak.uniform_diffuse);
        angles.push_back(peak.view_angle);
    }
    return {
        "Fig. 9: a peak emerges for larger angles: the maximum over the uniform level grows from 10 to 75 "
        "deg, beyond 2",
        "maximum/uniform " + brief(heights) + " at view angles of " + brief(angles, 4) + " deg",
        rises(heights) && heights.back() > 2};
}

Check peak_is_specular() {
    const PolarCurve curve = he_figure(9).curve(75);
    const PolarPoint& point = specular_point(curve);
    const double maximal = maximum(curve, brdf).view_angle;
    return {
        "Fig. 9: that peak is specular: at 75 deg the specular term exceeds the lobe, and the maximum is "
        "within 5 deg of 75",
        "specular " + brief(point.specular, 2) + ", directional diffuse " + brief(point.directional_diffuse) +
            " 1/sr; maximum at " + brief(maximal) + " deg",
        point.specular > point.directional_diffuse && std::abs(maximal - 75) <= 5,
        "With the paper's best fit the surface is too rough for its delta, sigma_0 = 2.9 wavelengths: the "
        "peak is directional diffuse and stands beyond the specular direction, as in Fig. 8. The paper's "
        "word for it may mean no more."};
}

Check grazing_rise() {
    const PolarCurve curve = he_figure(10).curve(0);
    std::vector<double> radii;
    for (const double angle : {45.0, 60.0, 75.0, 85.0}) radii.push_back(at(curve, angle).radius);
    return {
        "Fig. 10: large reflected intensities at grazing angles: the radius grows at 45, 60, 75, 85 deg, "
        "beyond that of the specular direction",
        brief(radii) + "; largest at " + brief(std::abs(maximum(curve, brdf).view_angle)) + " deg",
        rises(radii) && radii.back() > 1,
        "From the normal it falls first, to " + brief(at(curve, 15).radius, 3) + " at 15 and " +
            brief(at(curve, 30).radius, 3) + " at 30 deg. The paper's axis ends at 1."};
}

Check specular_and_uniform() {
    const HeFigure figure = he_figure(11);
    double lobe = 0, off = 0;
    const double level = 0.15 / std::numbers::pi;
    std::vector<double> peaks;
    for (const double theta_i : figure.theta_i) {
        const PolarCurve curve = figure.curve(theta_i);
        for (const PolarPoint& point : curve.points) {
            lobe = std::max(lobe, point.directional_diffuse);
            if (point.specular == 0 && std::abs(point.view_angle) < 90)
                off = std::max(off, std::abs(point.brdf() - level));
        }
        peaks.push_back(specular_point(curve).brdf());
    }
    return {
        "Fig. 11: smooth plastic: specular and uniform diffuse alone, 0.15/pi = 0.04775 1/sr beside the "
        "peaks",
        "directional diffuse " + brief(lobe) + ", off the level by at most " + brief(off, 2) +
            " 1/sr; peaks " + brief(peaks) + " 1/sr at 15, 30, 45, 60 deg",
        lobe == 0 && off < 1e-12};
}

double albedo_of_plastic(const spectral::OpticalConstants& constants) {
    const auto blue = Wavelength::from_micrometres(0.46);
    return spectral::diffuse_albedo_from(0.195, *he_figure(11).material.properties().surface,
                                         constants.index(blue), blue, Direction::from_degrees(0, 0));
}

Check albedo_from_hemisphere() {
    const double acrylic = albedo_of_plastic(spectral::built_in_optical_constants("PMMA"));
    const double polycarbonate = albedo_of_plastic(spectral::built_in_optical_constants("polycarbonate"));
    const double chosen = albedo_of_plastic(spectral::OpticalConstants::constant({1.54, 0}));
    return {
        "Fig. 11: rho_dh(0 deg) = 0.195 yields a = 0.15: for an index between those of acrylic and "
        "polycarbonate",
        "acrylic " + brief(acrylic) + ", polycarbonate " + brief(polycarbonate) + ", n = 1.54 " +
            brief(chosen),
        polycarbonate < 0.15 && 0.15 < acrylic, "The paper gives no index."};
}

Check emergence(const std::string& claim, const std::vector<double>& shares) {
    std::vector<double> percent;
    percent.reserve(shares.size());
    for (const double share : shares) percent.push_back(100 * share);
    return {claim, brief(percent) + " %", rises(shares)};
}

std::vector<Check> emergences() {
    const spectral::Material aluminium = he_figure(8).material;
    std::vector<double> wavelengths, angles, roughnesses;
    for (const double um : {0.5, 1.0, 2.0, 4.0, 8.0})
        wavelengths.push_back(specular_share(aluminium, um, 45));
    for (const double degrees : {10.0, 30.0, 45.0, 60.0, 75.0, 85.0}) {
        angles.push_back(specular_share(aluminium, 0.5, degrees));
    }
    for (const double rms_roughness : {0.28, 0.2, 0.1, 0.05, 0.0}) {
        const auto smoother = spectral::he_torrance_material("smoother", {rms_roughness, 1.77},
                                                             spectral::built_in_optical_constants("Al"));
        roughnesses.push_back(specular_share(smoother, 0.5, 45));
    }
    return {
        emergence("Conclusion 3: specular reflection emerges with wavelength: its share at 45 deg grows at "
                  "0.5, 1, 2, 4, 8 um",
                  wavelengths),
        emergence(
            "Conclusion 3: and with the angle of incidence: at 0.5 um it grows at 10, 30, 45, 60, 75, 85 deg",
            angles),
        emergence("Conclusion 3: and with decreasing roughness: it grows at 0.28, 0.2, 0.1, 0.05, 0 um",
                  roughnesses)};
}

Check three_kinds_of_maxima() {
    const double specular = maximum(he_figure(7).curve(45), brdf).view_angle;
    const double off =
        maximum(he_figure(8).curve(45), [](const PolarPoint& p) { return p.directional_diffuse; }).view_angle;
    const double grazing = std::abs(maximum(he_figure(10).curve(0), brdf).view_angle);
    return {"Conclusion 4: maxima at specular, off-specular or grazing angles, depending on roughness",
            "Fig. 7 at 45 deg: " + brief(specular) + " deg; Fig. 8 at 45 deg: " + brief(off) +
                " deg; Fig. 10 at 0 deg: " + brief(grazing) + " deg",
            std::abs(specular - 45) <= 1 && off > 46 && off < 85 && grazing >= 80};
}

}  // namespace

Section paper_figures_section(Effort /*effort*/) {
    Section section{"he-1991-figures", "The figures of He et al. 1991", {}, {}, he_figures(), {}, {}, {}};
    section.text = prose("he-1991-figures");
    section.checks = {both_components(),      strong_specular(),       off_specular_maxima(),
                      specular_peak_at_75(),  strong_lobe(),           nearly_uniform(),
                      emerging_peak(),        peak_is_specular(),      grazing_rise(),
                      specular_and_uniform(), albedo_from_hemisphere()};
    for (const Check& check : emergences()) section.checks.push_back(check);
    section.checks.push_back(three_kinds_of_maxima());
    section.not_available = {
        "The measured (dashed) curves of Figs 7 to 11: not published as numbers, and not at hand."};
    return section;
}

}  // namespace hts::validation
