#include "spectral/models/reflectance.hpp"

#include <filesystem>
#include <vector>

#include <catch2/catch.hpp>

#include "spectral/models/reflectance.hpp"

namespace {

using namespace hts;
using namespace hts::tables;

spectral::Material material(const char* file) {
    return spectral::read_material(std::filesystem::path{HTS_SOURCE_DIR} / "cli/data" / file);
}

const spectral::WavelengthGrid grid = spectral::WavelengthGrid::from_micrometres({0.46, 0.55, 0.62});

}  // namespace

TEST_CASE("a He-Torrance surface as a spectral BRDF is the model itself") {
    const spectral::Material aluminium = material("rough-aluminium.json");
    const auto brdf = model_brdf(aluminium, grid);
    const spectral::SpectralReflectance exact{*aluminium.he_torrance(), grid};
    const DirectionPair pair{Direction::from_degrees(30, 10), Direction::from_degrees(50, 170)};
    std::vector<double> values(grid.size()), mirror(grid.size());
    std::vector<Mueller> matrices(grid.size());
    brdf->brdf(pair, values);
    brdf->specular_reflectance(pair.in, mirror);
    brdf->mueller(pair, matrices);
    CHECK(brdf.name() == "roughened aluminium");
    CHECK(values == exact.brdf(pair));
    CHECK(brdf->polarised());
    for (std::size_t i = 0; i < grid.size(); ++i) {
        CHECK(mirror[i] == exact.specular_reflectance(pair.in)[i].value());
        CHECK(matrices[i].elements() == exact.mueller(pair)[i].elements());
    }
}

TEST_CASE("isotropy is found out") {
    CHECK(is_isotropic(*model_brdf(material("rough-aluminium.json"), grid)));
    CHECK(is_isotropic(*model_brdf(material("rough-gold.json"), grid)));
    const auto satin = model_brdf(material("purple-satin.json"), grid);
    CHECK_FALSE(is_isotropic(*satin));
    CHECK_FALSE(satin->polarised());
    CHECK(anisotropy(*satin) > 0.01);
}
