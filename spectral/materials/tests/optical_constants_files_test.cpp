#include "spectral/materials/optical_constants_files.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "hts/error.hpp"
#include "temporary_folder.hpp"

using hts::Wavelength;
using hts::spectral::read_optical_constants;
using hts::testing::complaint;
using hts::testing::TemporaryFolder;

namespace {

Wavelength micrometres(double um) {
    return Wavelength::from_micrometres(um);
}

std::string complaint_about(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
    const auto path = folder.write(name, text);
    return complaint(folder, [&path] { static_cast<void>(read_optical_constants(path)); });
}

}  // namespace

TEST_CASE("files that hold no material are refused") {
    const TemporaryFolder folder;
    const std::string no_data = ": key \"DATA\": missing; must be a file of refractiveindex.info";
    CHECK(complaint_about(folder, "m.yml", "") == "m.yml: file is empty");
    CHECK(complaint_about(folder, "m.yml", "# nothing\n") == "m.yml" + no_data);
    CHECK(complaint_about(folder, "m.yml", "just text\n") == "m.yml" + no_data);
    CHECK(complaint_about(folder, "m.yml", "- 1\n- 2\n") == "m.yml" + no_data);
    CHECK(complaint_about(folder, "m.yml", "REFERENCES: x\n") == "m.yml" + no_data);
    CHECK(complaint_about(folder, "m.yml", "DATA: 3\n") == "m.yml:1: key \"DATA\": must be a list");
    CHECK(complaint_about(folder, "m", "0.5 1 0\n") ==
          "m: ending \"\": must be .yml, .yaml, .csv, .txt, .spd or .json");
    CHECK(complaint(folder, [&] { static_cast<void>(read_optical_constants(folder.path() / "none.yml")); }) ==
          "none.yml: no such file");
}

TEST_CASE("CSV materials in micrometres and nanometres are read") {
    const TemporaryFolder folder;
    const auto um = read_optical_constants(
        folder.write("m.csv", "# mine\nwavelength_um,n,k\n0.6,1.6,0.3\n0.4,1.4,0.1\n0.6,1.8,0.5\n"));
    CHECK(um.index(micrometres(0.4)).n() == 1.4);
    CHECK(um.index(micrometres(0.6)).n() == Approx(1.7).epsilon(1e-14));
    CHECK(um.index(micrometres(0.5)).k() == Approx(0.25).epsilon(1e-14));
    CHECK(um.name() == (folder.path() / "m.csv").string());
    CHECK(um.warnings() ==
          std::vector<std::string>{um.name() + ": n at 0.6 um: rows differ there, and their mean is taken",
                                   um.name() + ": k at 0.6 um: rows differ there, and their mean is taken"});
    CHECK(read_optical_constants(folder.write("s.csv", "wavelength_um,n\n0.4,1.4\n0.4,1.4\n0.5,1.5\n"))
              .warnings()
              .empty());
    const auto nm =
        read_optical_constants(folder.write("m.CSV", "n,wavelength_nm\r\n1.4,400\r\n1.6,600\r\n"));
    CHECK(nm.range().shortest == 0.4);
    CHECK(nm.index(micrometres(0.5)).n() == Approx(1.5).epsilon(1e-14));
    CHECK(nm.index(micrometres(0.5)).k() == 0);
}

TEST_CASE("what the database's website writes is read") {
    const TemporaryFolder folder;
    const std::string csv = "wl,n\n0.4,1.4\n0.6,1.6\n\nwl,k\n0.4,0.1\n0.5,0.2\n";
    std::string txt = csv;
    std::replace(txt.begin(), txt.end(), ',', '\t');
    for (const auto& [name, text] : {std::pair{"m.csv", csv}, {"m.txt", txt}}) {
        const auto metal = read_optical_constants(folder.write(name, text));
        CHECK(metal.index(micrometres(0.45)).n() == Approx(1.45).epsilon(1e-14));
        CHECK(metal.index(micrometres(0.45)).k() == Approx(0.15).epsilon(1e-14));
        CHECK(metal.range().longest == 0.5);
    }
    const auto both = read_optical_constants(folder.write("b.csv", "wl;n;k\n0,4;1,4;0,1\n0,6;1,6;0,3\n"));
    CHECK(both.index(micrometres(0.5)).n() == Approx(1.5).epsilon(1e-14));
    CHECK(both.index(micrometres(0.5)).k() == Approx(0.2).epsilon(1e-14));
    const auto glass = read_optical_constants(folder.write("g.csv", "wl,n\n0.4,1.4\n0.6,1.6\n"));
    CHECK(glass.index(micrometres(0.5)).k() == 0);
    CHECK(complaint_about(folder, "m.csv", "wl,n\n0.4,1.4\nwl,k\n0.4,-1\n") ==
          "m.csv:4: extinction coefficient k -1: must be >= 0 and at most 1e+24");
}

TEST_CASE("text tables and .spd pairs are read, and refused with path and line") {
    const TemporaryFolder folder;
    for (const std::string text :
         {"0.4 1.4 0.1\n0.6 1.6 0.3\n", "# um n k\n0.4 (1.4,0.1)\n0.6 (1.6,0.3)\n",
          "0.4\t1.4\t0.1\n0.6\t1.6\t0.3\n", "wavelength_nm n k\n400 1.4 0.1\n600 1.6 0.3\n",
          "wavelength_nm;n;k\n400;1,4;0,1\n600;1,6;0,3\n"}) {
        const auto metal = read_optical_constants(folder.write("m.txt", text));
        CHECK(metal.index(micrometres(0.5)).n() == Approx(1.5).epsilon(1e-14));
        CHECK(metal.index(micrometres(0.5)).k() == Approx(0.2).epsilon(1e-14));
    }
    CHECK(complaint_about(folder, "m.txt", "400 1.4\n") ==
          "m.txt:1: wavelength without a unit 400: must be at most 100 um; a header \"wavelength_nm n k\" "
          "says that they are nm");
    CHECK(complaint_about(folder, "m.txt", "0.4 1.4\n0.5 1.5 0\n") ==
          "m.txt:2: 3 numbers: must be 2 as above");
    CHECK(complaint_about(folder, "m.spd", "400 1.4\n500\n") ==
          "m.spd: a wavelength without a value at the end: must be pairs");
    CHECK(complaint_about(folder, "m.spd", "400 1.4\n400 1.5\n") ==
          "m.spd:2: wavelength 400 nm: must be > the one before it");
    CHECK(complaint_about(folder, "Au.k.spd", "400 1.4\n").find("Au.k.spd: holds k alone") == 0);
    const auto alone = read_optical_constants(folder.write("Ag.eta.spd", "# nm\n400 1.4\n600 1.6\n"));
    CHECK(alone.index(micrometres(0.5)).k() == 0);
    REQUIRE(alone.warnings().size() == 1);
    CHECK(alone.warnings().front().find("holds n alone, and there is no ") != std::string::npos);
    folder.write("Ag.k.spd", "400 2\n600 4\n");
    const auto silver = read_optical_constants(folder.path() / "Ag.eta.spd");
    CHECK(silver.index(micrometres(0.5)).n() == Approx(1.5));
    CHECK(silver.index(micrometres(0.5)).k() == Approx(3));
    CHECK(silver.warnings().empty());
}

TEST_CASE("CSV materials that cannot be are refused with path and line") {
    const TemporaryFolder folder;
    const std::pair<std::string, std::string> cases[] = {
        {"wavelength_um,n\n", "m.csv: table without a row: must have at least one"},
        {"n,k\n1,2\n", "m.csv:1: column \"wavelength_um\": missing"},
        {"wavelength_um,k\n1,2\n", "m.csv:1: column \"n\": missing"},
        {"wavelength_um,wavelength_nm,n\n1,1000,2\n",
         "m.csv:1: columns \"wavelength_um\" and \"wavelength_nm\": must be one of the two"},
        {"wavelength_um,n,K\n1,2,3\n",
         "m.csv:1: column \"K\": not known; must be one of wavelength_um, wavelength_nm, n, k; did you mean "
         "\"k\"?"},
        {"wavelength_um,n,k\n0.5,1.5,abc\n", "m.csv:2: column \"k\": \"abc\" is not a number"},
        {"wavelength_um,n,k\n0.5,1.5\n", "m.csv:2: 2 fields: must be 3 as in the header"},
        {"wavelength_um,n,k\n0.5,1.5,0\n0.6,1.5,-1\n",
         "m.csv:3: extinction coefficient k -1: must be >= 0 and at most 1e+24"},
        {"wavelength_um,n\n0.5,-1.5\n", "m.csv:2: refractive index n -1.5: must be > 0 and at most 1e+24"},
        {"wavelength_nm,n\n-500,1.5\n", "m.csv:2: wavelength -0.5 um: must be > 0 (from 1e-24 to 1e+24 um)"},
    };
    for (const auto& [text, message] : cases) CHECK(complaint_about(folder, "m.csv", text) == message);
}

TEST_CASE("JSON materials are read, and refused with path and key") {
    const TemporaryFolder folder;
    const auto material = read_optical_constants(folder.write(
        "m.json", R"({"name": "glass", "source": "me", "table": [[0.6, 1.6, 0.3], [0.4, 1.4, 0.1]]})"));
    CHECK(material.name() == "glass");
    CHECK(material.source() == "me");
    CHECK(material.index(micrometres(0.5)).n() == Approx(1.5).epsilon(1e-14));
    const auto nameless = read_optical_constants(folder.write("m.json", R"({"table": [[0.6, 1.6, 0.3]]})"));
    CHECK(nameless.name() == (folder.path() / "m.json").string());
    CHECK(nameless.source() == (folder.path() / "m.json").string());
    const std::pair<std::string, std::string> cases[] = {
        {"[]", "m.json: must be an object, not an array"},
        {"{}", "m.json: key \"table\": missing"},
        {R"({"table": [[0.6, 1.6, 0.3]], "nome": 1})",
         "m.json: key \"nome\": not known; must be one of table, name, source; did you mean \"name\"?"},
        {R"({"table": [[0.6, 1.6, 0.3]], "name": 1})",
         "m.json: key \"name\": must be a string, not a number"},
        {R"({"table": [[0.6, 1.6]]})", "m.json: key \"table\": row 1: must be 3 numbers, [um, n, k]"},
        {R"({"table": [[0.6, -1.6, 0]]})",
         "m.json: key \"table\": row 1: refractive index n -1.6: must be > 0 and at most 1e+24"},
    };
    for (const auto& [text, message] : cases) CHECK(complaint_about(folder, "m.json", text) == message);
}
