#include "tables/formats/sidecar.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "materials.hpp"
#include "tables/formats/whole_file.hpp"
#include "temporary_folder.hpp"

using namespace hts;
using namespace hts::tables;

TEST_CASE("the sidecar says what the file holds and keeps the specular term") {
    const auto plastic =
        tables::testing::brdf_of("smooth-plastic.json", spectral::WavelengthGrid::linear(0.45, 0.7, 4));
    const hts::testing::TemporaryFolder folder;
    const auto file = folder / "hts-sidecar-test.bsdf";
    write_with_sidecar(file, plastic,
                       {{{file.string(), "content"}},
                        {.format = "a format",
                         .value = "f cos(theta_o)",
                         .normalisation = "none",
                         .suggested_alpha = 0.1,
                         .notes = {"front side only"}}});
    const auto json = nlohmann::json::parse(read_whole_file(file.string() + ".json"));
    CHECK(read_whole_file(file) == "content");
    CHECK(json["file"] == "hts-sidecar-test.bsdf");
    CHECK(json["value"] == "f cos(theta_o)");
    CHECK(json["units"] == "1/sr");
    CHECK(json["wavelengths_um"].size() == 4);
    CHECK(json["suggested_alpha"] == 0.1);
    const auto& specular = json["specular"];
    REQUIRE(specular["theta_i_deg"].size() == 37);
    std::vector<double> expected(4);
    for (const std::size_t row : {0U, 12U, 36U}) {
        plastic.specular_reflectance(Direction::from_degrees(specular["theta_i_deg"][row], 0), expected);
        CHECK(specular["reflectance"][row].get<std::vector<double>>() == expected);
    }
    CHECK_THROWS_WITH(write_with_sidecar("/nowhere/x.bsdf", plastic, {}),
                      Catch::Contains("/nowhere/x.bsdf.json: cannot be written"));
    CHECK_THROWS_WITH(read_whole_file("/nowhere/x"), Catch::Contains("/nowhere/x: no such file"));
}
