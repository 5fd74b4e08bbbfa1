// Pictures of the microfacet papers: Ashikhmin, Premoze and Shirley 2000, Kurt, Szirmay-Kalos and Krivanek
// 2010. Densities, widths and Kurt's parameters are the papers'; colours that they do not give, shapes and
// lights are chosen here.

#include <cmath>
#include <limits>
#include <numbers>

#include "hts/microfacet/ashikhmin.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/ward.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/model_evaluator.hpp"
#include "validation/pictures/scene_builders.hpp"

namespace hts::validation {
namespace {

using spectral::OutsideRange;
using Rgb = std::array<double, 3>;

constexpr double endless = std::numeric_limits<double>::infinity();

/// A material from what makes its model at a wavelength [um].
template <class Make>
Appearance appearance_of(const Make& make) {
    return Appearance{spectral::material_of([make](const Wavelength& wavelength, OutsideRange /*policy*/) {
        return make(wavelength.micrometres());
    })};
}

/// Reflectance of smooth gold at normal incidence.
double gold(double um) {
    static const spectral::OpticalConstants constants = spectral::built_in_optical_constants("Au");
    return FacetFresnel::exact(constants.index(Wavelength::from_micrometres(um))).at_normal();
}

/// Paint of the colour of gold.
const Rgb golden{0.75, 0.50, 0.10};

Appearance ashikhmin_metal(const NormalDensity& normals) {
    const AshikhminFacets facets{normals};
    return appearance_of([=](double um) { return AshikhminBrdf::metal(facets, gold(um)); });
}

Appearance ashikhmin_dielectric(const NormalDensity& normals, double f0, const Rgb& albedo,
                                FacetShadowing shadowing = FacetShadowing::uncorrelated) {
    const AshikhminFacets facets{normals, shadowing};
    return appearance_of([=, table = from_rgb(albedo)](double um) {
        return AshikhminBrdf{facets, FacetFresnel::schlick(f0), table(um)};
    });
}

Appearance kurt(const Rgb& kd, const Rgb& ks, const KurtLobe& lobe) {
    return appearance_of([lobe, diffuse = from_rgb(kd), specular = from_rgb(ks)](double um) {
        return Kurt{diffuse(um), {{specular(um), lobe}}};
    });
}

std::vector<Scene> spheres(const std::vector<Appearance>& materials) {
    std::vector<Scene> scenes;
    scenes.reserve(materials.size());
    for (const Appearance& material : materials) scenes.push_back(sphere_scene(material));
    return scenes;
}

/// A picture of normals, a value for each |h_x|, |h_y| <= 1 in units of its extent.
template <class Value>
NormalDensity pictured(double sigma, double extent, const Value& value) {
    constexpr std::size_t edge = 129;
    ValueGrid grid{edge, edge, {}};
    for (std::size_t row = 0; row < edge; ++row) {
        for (std::size_t column = 0; column < edge; ++column) {
            // on a sphere the facet that mirrors the light leans away from the highlight's centre: half a
            // turn makes it upright
            const auto from_centre = [](std::size_t i) {
                return 2 * (static_cast<double>(i) + 0.5) / edge - 1;
            };
            grid.values.push_back(value(-from_centre(column), from_centre(row)));
        }
    }
    return NormalDensity::image(sigma, sigma, std::move(grid), extent);
}

/// A flower of six petals, even about n; and a face, which is not.
std::vector<Scene> unusual_normals() {
    const auto flower = [](double x, double y) {
        return std::hypot(x, y) < 0.45 + 0.4 * std::cos(6 * std::atan2(y, x)) ? 1.0 : 0.0;
    };
    const auto face = [](double x, double y) {
        const bool eyes = std::hypot(std::abs(x) - 0.32, y - 0.3) < 0.14;
        const bool mouth = std::abs(std::hypot(x, y) - 0.62) < 0.09 && y < -0.12;
        const bool rim = std::abs(std::hypot(x, y) - 0.9) < 0.06;
        return eyes || mouth || rim ? 1.0 : 0.0;
    };
    constexpr double sigma = 0.6, extent = 0.42, f0 = 0.3;
    const Rgb blue{0.08, 0.10, 0.30}, green{0.06, 0.20, 0.10};
    return spheres({ashikhmin_dielectric(pictured(sigma, extent, flower), f0, blue),
                    ashikhmin_dielectric(pictured(sigma, extent, face), f0, green)});
}

std::vector<Scene> brushed_gold() {
    const Appearance ward = appearance_of([](double um) { return Ward{0, {{gold(um), WardLobe{0.1, 1}}}}; });
    return spheres({ward, ashikhmin_metal(NormalDensity::gaussian(0.1, 1))});
}

std::vector<Scene> golden_plastic() {
    constexpr double f0 = 0.05;
    const Appearance ward = appearance_of([table = from_rgb(golden)](double um) {
        return Ward{(1 - f0) * table(um), {{f0, WardLobe{0.1, 0.2}}}};
    });
    return spheres({ward, ashikhmin_dielectric(NormalDensity::gaussian(0.1, 0.2), f0, golden)});
}

std::vector<Scene> grooved_metal() {
    const Appearance metal = ashikhmin_metal(NormalDensity::grooves(40 * std::numbers::pi / 180, 0.1));
    std::vector<Scene> scenes{plate_scene(metal), plate_scene(metal)};
    scenes.front().objects.front().turn = std::numbers::pi / 2;
    return scenes;
}

std::vector<Scene> cloths() {
    const auto satin = NormalDensity::mixture(
        {{0.7, NormalDensity::gaussian(0.1, endless)}, {0.3, NormalDensity::gaussian(0.3, endless)}});
    const Rgb red{0.16, 0.012, 0.02}, dark_red{0.08, 0.005, 0.01};
    return {cloth_scene(ashikhmin_dielectric(satin, 0.1, red)),
            cloth_scene(ashikhmin_dielectric(NormalDensity::inverse_gaussian(0.5), 0.05, dark_red,
                                             FacetShadowing::correlated))};
}

std::vector<Scene> kurt_materials() {
    std::vector<Appearance> materials;
    for (const KurtPreset& preset : kurt_presets())
        materials.push_back(kurt(preset.kd, preset.ks, preset.lobe));
    std::vector<Scene> scenes = spheres(materials);
    constexpr std::array exposures{3.0, 10.0, 10.0, 10.0};
    for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].exposure *= exposures[i];
    return scenes;
}

std::vector<Scene> kurt_anisotropic() {
    const auto sphere = [](double mx, double my) {
        return kurt({0.15, 0.15, 0.15}, {0.85, 0.85, 0.85}, {0.75, mx, my, 0.2});
    };
    return spheres({sphere(0.1, 0.5), sphere(0.5, 0.1)});
}

}  // namespace

spectral::PiecewiseLinear from_rgb(const Rgb& rgb) {
    return spectral::PiecewiseLinear{
        {{0.38, rgb[2]}, {0.49, rgb[2]}, {0.53, rgb[1]}, {0.56, rgb[1]}, {0.61, rgb[0]}, {0.78, rgb[0]}}};
}

Appearance matt(const Rgb& rgb) {
    return appearance_of([table = from_rgb(rgb)](double um) { return LambertianModel{table(um)}; });
}

Scene sphere_scene(const Appearance& material) {
    Scene scene{{}, {}, Spectrum::grey(0), Camera{{0, -6, 0}, {0, 0, 0}, 22}};
    scene.objects.push_back({Sphere{{0, 0, 0}, 1}, {material}});
    scene.lights.push_back({Sphere{{-3.2, -7, 3.6}, 0.25}, Spectrum::grey(1600)});
    return scene;
}

Scene cloth_scene(const Appearance& material) {
    Scene scene{{}, {}, Spectrum::grey(0.05), Camera{{0.3, -6.2, 3.2}, {0, -0.1, 0}, 27}};
    scene.objects.push_back(
        {Cloth{
             {0, 0, 0},
             2,
             {{0.13, 4.4, 0.5, 0.4}, {0.08, 3.1, 2.2, 1.1}, {0.035, 8.3, -1.7, 2.0}, {0.12, 0.9, -2.4, 0.2}}},
         {material}});
    scene.lights.push_back({Sphere{{-4, 4, 5.5}, 0.5}, Spectrum::grey(480)});
    return scene;
}

Scene plate_scene(const Appearance& material) {
    Scene scene{{}, {}, Spectrum::grey(0.02), Camera{{0, -2.4, 6.5}, {0, 0, 0.6}, 34}};
    scene.objects.push_back({Cloth{{0, 0, -1.2}, 1.5, {{1.1, 1.15, 0, 0}, {1.1, 0, 1.15, 0}}}, {material}});
    scene.lights.push_back({Sphere{{1, 0.3, 10}, 0.35}, Spectrum::grey(250)});
    return scene;
}

std::vector<Gallery> microfacet_galleries() {
    return {{"ashikhmin1",
             "Pictures as densities of normals, after Fig. 1 of Ashikhmin et al. 2000: a flower and a face, "
             "each times a Gaussian.",
             2, 1, unusual_normals},
            {"ashikhmin5",
             "Brushed gold, sigma 0.1 and 1, after Fig. 5 of Ashikhmin et al. 2000: left Ward's model, right "
             "theirs.",
             2, 1, brushed_gold},
            {"ashikhmin7",
             "Golden plastic, sigma 0.1 and 0.2, after Fig. 7 of Ashikhmin et al. 2000: left Ward's model, "
             "right theirs.",
             2, 1, golden_plastic},
            {"ashikhmin9",
             "Grooves of 40 deg in gold under one light, after Fig. 9 of Ashikhmin et al. 2000, on a bulging "
             "plate: left running across, right running towards the viewer.",
             2, 1, grooved_metal},
            {"ashikhmin11", "Satin and velvet, after Fig. 11 of Ashikhmin et al. 2000.", 2, 1, cloths},
            {"kurt4",
             "Brushed aluminium, purple satin, red velvet and yellow satin by the parameters of Table 2 of "
             "Kurt et al. 2010; the last three are shown 3 times as bright as the first.",
             4, 1, kurt_materials},
            {"kurt13",
             "kd 0.15, ks 0.85, f0 0.75, alpha 0.2, after Fig. 13 of Kurt et al. 2010, which does not give "
             "the widths: here 0.1 and 0.5.",
             2, 1, kurt_anisotropic}};
}

}  // namespace hts::validation
