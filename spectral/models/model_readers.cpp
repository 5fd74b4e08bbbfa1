#include "spectral/models/model_readers.hpp"

#include <numbers>
#include <optional>

#include "hts/error.hpp"
#include "hts/microfacet/cook_torrance.hpp"
#include "hts/microfacet/cosine_lobes.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/walter.hpp"
#include "hts/microfacet/ward.hpp"
#include "spectral/materials/coated_constants.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

struct MakeAshikhminShirley {
    [[nodiscard]] AshikhminShirley operator()(double rd, double ks, double f0, double nx, double ny) const {
        return {rd, {f0, nx, ny}, ks};
    }
};

FacetDistribution facets_from(const JsonValue& file) {
    const JsonValue shape = file["distribution"];
    const auto make = [&](const char* key, FacetDistribution (*of)(double, SmithForm)) {
        const double value = file[key].number();
        return located(file[key].place(), [&] { return of(value, SmithForm::exact); });
    };
    const auto unknown = shape.text() == "phong" ? "alpha" : "exponent";
    if (const auto other = file.find(unknown)) {
        throw other->error("must not be there for distribution " + in_quotes(shape.text()));
    }
    if (shape.text() == "phong") return make("exponent", FacetDistribution::phong);
    if (shape.text() == "beckmann") return make("alpha", FacetDistribution::beckmann);
    if (shape.text() == "ggx") {
        return make("alpha", [](double alpha, SmithForm) { return FacetDistribution::ggx(alpha); });
    }
    throw shape.error(in_quotes(shape.text()) + " is not known; must be beckmann, phong or ggx");
}

}  // namespace

Material read_walter(const MaterialFile& file) {
    file.json.require_keys_among({"name", "model", "distribution", "alpha", "exponent", "index", "films",
                                  "exterior_index", "diffuse_albedo"});
    const FacetDistribution facets = facets_from(file.json);
    const CoatedConstants constants = coated_constants_from(file.json, file.folder);
    const SpectralNumber exterior{file.json, "exterior_index", 1, [](double n) {
                                      return RefractiveIndex{n, 0}.n();
                                  }};
    const SpectralNumber diffuse{file.json, "diffuse_albedo", 0,
                                 [](double a) { return checked_reflectance("diffuse albedo", a); }};
    return material_of(
        [=](const Wavelength& wavelength, OutsideRange policy) {
            const double albedo = diffuse(wavelength, policy);
            return ModelAtWavelength{WalterInterface{facets, constants.index(wavelength, policy),
                                                     exterior(wavelength, policy), albedo},
                                     albedo * std::numbers::inv_pi};
        },
        constants.warnings());
}

Material read_kurt(const MaterialFile& file) {
    file.json.require_keys_among({"name", "model", "kd", "lobes", "coupled"});
    const LobesOfNumbers<KurtLobe, 4> parts{
        file.json, std::array<NumberKey, 4>{{{"f0", 1}, {"mx", 1}, {"my", 1}, {"alpha", 0}}}};
    const bool coupled = truth_or(file.json, "coupled", false);
    if (coupled && file.json["lobes"].items().size() != 1) {
        throw file.json["coupled"].error("true: must come with one lobe");
    }
    return material_of([=](const Wavelength& wavelength, OutsideRange policy) {
        const double kd = parts.kd(wavelength, policy);
        auto lobes = parts.lobes(wavelength, policy);
        if (coupled) return ModelAtWavelength{Kurt::coupled(kd, lobes.front())};
        return ModelAtWavelength{Kurt{kd, std::move(lobes)}, kd * std::numbers::inv_pi};
    });
}

const std::vector<ModelEntry>& built_in_models() {
    static const std::vector<ModelEntry> models{
        {"he", "He, Torrance, Sillion, Greenberg 1991", read_he_torrance},
        {"he_unified", "hts, successor of He, Torrance, Sillion, Greenberg 1991", read_he_unified},
        {"walter", "Walter, Marschner, Li, Torrance 2007", read_walter},
        {"ashikhmin", "Ashikhmin, Premoze, Shirley 2000", read_ashikhmin},
        {"kurt", "Kurt, Szirmay-Kalos, Krivanek 2010", read_kurt},
        model_of_numbers<LambertianModel>("lambert", "Lambert", {{"diffuse_albedo", 0}}),
        model_of_numbers<OrenNayar>("oren_nayar", "Oren, Nayar 1994",
                                    {{"diffuse_albedo", 0}, {"slope_angle_deg", 0, degree}}),
        model_of_lobes<WardLobe>("ward", "Ward 1992", {{"mx", 1}, {"my", 1}}),
        model_of_lobes<WardDuerLobe>("ward_duer", "Duer 2005", {{"mx", 1}, {"my", 1}}),
        model_of_lobes<CookTorranceLobe>("cook_torrance", "Cook, Torrance 1981", {{"f0", 1}, {"m", 1}}),
        model_of_lobes<BlinnPhongLobe>("blinn_phong", "Blinn 1977", {{"exponent", 1}}),
        model_of_lobes<LafortuneLobe>("lafortune", "Lafortune, Foo, Torrance, Greenberg 1997",
                                      {{"cx", -1}, {"cy", -1}, {"exponent", 1}}),
        model_made_by<MakeAshikhminShirley, 5>(
            "ashikhmin_shirley", "Ashikhmin, Shirley 2000",
            {{{"rd", 0}, {"ks", 1, 1, 1.0}, {"f0", 1}, {"nx", 1}, {"ny", 1}}}),
    };
    return models;
}

}  // namespace hts::spectral
