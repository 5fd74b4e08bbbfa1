// The pictures of the papers' scenes for the report, and what the text of He et al. 1991 says one sees in
// them.

#include "validation/pictures/renders_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "spectral/text/text.hpp"
#include "validation/pictures/gallery.hpp"
#include "validation/pictures/picture.hpp"
#include "validation/report/prose.hpp"

namespace hts::validation {
namespace {

using spectral::brief;

constexpr std::size_t blue = 5, green = 15, red = 25;  // 0.45, 0.55, 0.65 um
constexpr std::uint32_t rays = 16;                     // per point that is measured

std::vector<Scene> scenes(const std::string& name) {
    const auto& all = galleries();
    return std::find_if(all.begin(), all.end(), [&](const Gallery& each) { return each.name == name; })
        ->scenes();
}

bool falls(const std::vector<double>& values) {
    return std::is_sorted(values.rbegin(), values.rend()) && values.front() > values.back();
}

/// The light that the camera gets from a point.
Spectrum light_from(const Scene& scene, Vector3 point) {
    return radiance(scene, scene.camera.towards(point), rays);
}

/// Contrast of the bricks' image in the top face: (largest - smallest)/(their sum) along a line across it.
double image_contrast(const Scene& scene) {
    double least = 1e300, most = 0;
    for (int i = 0; i <= 40; ++i) {
        const double value = light_from(scene, {-0.8 + 0.04 * i, 0.2, cylinder_height}).values[green];
        least = std::min(least, value);
        most = std::max(most, value);
    }
    return (most - least) / (most + least);
}

/// How the front face shines from left to right at half its height.
std::vector<Spectrum> front(const Scene& scene) {
    std::vector<Spectrum> profile;
    for (int degrees = -70; degrees <= 70; degrees += 2) {
        const double angle = degrees * std::numbers::pi / 180;
        profile.push_back(light_from(scene, {cylinder_radius * std::sin(angle),
                                             -cylinder_radius * std::cos(angle), cylinder_height / 2}));
    }
    return profile;
}

/// Width of the light's image there, the part that is brighter than half the brightest [deg].
double highlight_width(const Scene& scene) {
    const auto profile = front(scene);
    double brightest = 0;
    for (const Spectrum& each : profile) brightest = std::max(brightest, each.values[green]);
    return 2.0 * static_cast<double>(std::count_if(profile.begin(), profile.end(), [&](const Spectrum& each) {
               return each.values[green] > brightest / 2;
           }));
}

/// Blue over red of all the light from the front face, in units of what the smooth metal does.
double blueness(const Scene& scene, const Spectrum& smooth) {
    Spectrum sum;
    for (const Spectrum& each : front(scene)) sum += each;
    return sum.values[blue] / sum.values[red] * smooth.values[red] / smooth.values[blue];
}

double redness_of_mirror(const Scene& scene, double degrees) {
    const Spectrum mirror =
        scene.objects.front().appearances.front().specular_reflectance(Direction::from_degrees(degrees, 0));
    return mirror.values[red] / mirror.values[blue];
}

std::vector<Check> cylinder_checks() {
    std::vector<Scene> cylinders = scenes("fig12");
    cylinders.pop_back();  // (f), of another correlation length
    const Spectrum smooth = scenes("fig13")[1].objects.front().appearances.front().specular_reflectance(
        Direction::from_degrees(45, 0));
    std::vector<double> contrasts, widths, blues, reds;
    for (const Scene& scene : cylinders) {
        contrasts.push_back(image_contrast(scene));
        widths.push_back(highlight_width(scene));
    }
    for (const std::size_t k : {0u, 1u}) {
        blues.push_back(blueness(cylinders[k], smooth));
        reds.push_back(redness_of_mirror(cylinders[k], 78));
    }
    return {{"Fig. 12: the specular image in the top faces diminishes from (a) to (e): contrast of the "
             "bricks' image",
             brief(contrasts), falls(contrasts)},
            {"Fig. 12: the image of the light on the front face spreads out from (a) to (e): its width in "
             "degrees about the axis",
             brief(widths) + " deg",
             std::is_sorted(widths.begin(), widths.end()) && widths.front() < widths.back()},
            {"Fig. 12: a slight blue shift on the front faces of (a) and (b): 0.45 over 0.65 um is more than "
             "that of the smooth metal",
             brief(blues, 4) + " times", *std::min_element(blues.begin(), blues.end()) > 1},
            {"Fig. 12: a red shift of the specular images of (a) and (b), at 78 deg: 0.65 over 0.45 um is "
             "above 1",
             brief(reds), *std::min_element(reds.begin(), reds.end()) > 1}};
}

/// How much more a surface of the still life mirrors at 80 than at 60 deg.
double growth(const Object& object) {
    const Appearance& material = object.appearances.front();
    const auto mirror = [&](double degrees) {
        return material.specular_reflectance(Direction::from_degrees(degrees, 0)).values[green];
    };
    return mirror(80) / mirror(60);
}

Check still_life_check() {
    const Scene scene = scenes("fig14").front();
    const double cube = growth(scene.objects[2]), table = growth(scene.objects[3]);
    return {
        "Fig. 14: specular images on the cube vary with angle by Fresnel alone, on the table mainly by "
        "roughness: from 60 to 80 deg they grow, on the table more than ten times as much",
        "cube " + brief(cube) + " times, table " + brief(table) + " times", cube > 1 && table > 10 * cube};
}

}  // namespace

Section renders_section(Effort effort) {
    Section section{"renders", "The scenes of the papers", {}, cylinder_checks(), {}, {}, {}, {}};
    section.text = prose("renders");
    section.checks.push_back(still_life_check());
    RenderSettings settings;
    settings.samples = effort == Effort::quick ? 4 : 16;
    const std::size_t panel = effort == Effort::quick ? 160 : 400;
    for (const Gallery& gallery : galleries()) {
        settings.width = gallery.columns * panel;
        section.images.push_back({gallery.name, gallery.caption, png(picture_of(gallery, settings))});
    }
    section.not_available = {"The papers' pictures as data, to compare with pixel by pixel."};
    return section;
}

}  // namespace hts::validation
