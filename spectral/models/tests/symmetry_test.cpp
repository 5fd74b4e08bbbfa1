#include "spectral/models/symmetry.hpp"

#include <filesystem>

#include <catch2/catch.hpp>

#include "spectral/models/material.hpp"

namespace {

using namespace hts::spectral;

Reflectance reflectance(const char* file) {
    return read_material(std::filesystem::path{HTS_SOURCE_DIR} / "cli/data" / file)
        .at(WavelengthGrid::from_micrometres({0.46, 0.55, 0.62}));
}

}  // namespace

TEST_CASE("isotropy is found out") {
    CHECK(is_isotropic(reflectance("rough-aluminium.json").evaluator()));
    CHECK(is_isotropic(reflectance("rough-gold.json").evaluator()));
    CHECK(reflectance("rough-gold.json").properties().isotropic);
    const Reflectance satin = reflectance("purple-satin.json");
    CHECK_FALSE(is_isotropic(satin.evaluator()));
    CHECK_FALSE(satin.properties().isotropic);
    CHECK_FALSE(satin.properties().polarised);
    CHECK(anisotropy(satin.evaluator()) > 0.01);
}
