#include "spectral/models/reflected_terms.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "hts/microfacet/diffuse.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/he_torrance_material.hpp"
#include "spectral/models/model_evaluator.hpp"

using hts::Direction;
using hts::spectral::DirectionPair;
using hts::spectral::Material;
using hts::spectral::Reflectance;
using hts::spectral::reflected_terms;
using hts::spectral::WavelengthGrid;

namespace {

constexpr double albedo = 0.3, uniform = albedo / std::numbers::pi;
const auto grid = WavelengthGrid::linear(0.4, 0.7, 3);
const DirectionPair above{Direction::from_degrees(30, 0), Direction::from_degrees(40, 170)};
const DirectionPair grazing{Direction::from_degrees(30, 0), Direction::from_degrees(90, 170)};

Reflectance rough() {
    return hts::spectral::he_torrance_material("aluminium", {0.28, 1.77},
                                               hts::spectral::built_in_optical_constants("Al"),
                                               hts::spectral::DiffuseAlbedo{albedo})
        .at(grid);
}

Reflectance matt() {
    const auto model = [](const hts::Wavelength&, hts::spectral::OutsideRange) {
        return hts::spectral::ModelAtWavelength{hts::LambertianModel{albedo}, uniform};
    };
    return hts::spectral::material_of(model).at(grid);
}

}  // namespace

TEST_CASE("the terms of a pair are those of the reflectance and add up to its BRDF") {
    for (const Reflectance& reflectance : {rough(), matt()}) {
        const auto terms = reflected_terms(reflectance, above);
        const auto brdf = reflectance.brdf(above);
        const auto specular = reflectance.specular_reflectance(above.in);
        for (std::size_t i = 0; i < grid.size(); ++i) {
            CHECK(terms.uniform_diffuse[i] == Approx(uniform).epsilon(1e-15));
            CHECK(terms.directional_diffuse[i] + terms.uniform_diffuse[i] == Approx(brdf[i]).epsilon(1e-15));
            CHECK(terms.specular_reflectance[i] == specular[i].value());
        }
    }
}

TEST_CASE("on the horizon the uniform-diffuse term stays of rough surfaces alone") {
    CHECK(reflected_terms(rough(), grazing).uniform_diffuse[0] == Approx(uniform).epsilon(1e-15));
    CHECK(reflected_terms(matt(), grazing).uniform_diffuse[0] == 0);
    CHECK(reflected_terms(rough(), grazing).directional_diffuse[0] == 0);
    CHECK(reflected_terms(matt(), {grazing.out, grazing.in}).uniform_diffuse[0] == 0);
}
