#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "database_folder.hpp"
#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "temporary_folder.hpp"

using hts::Wavelength;
using hts::spectral::OpticalConstants;
using hts::spectral::read_optical_constants;
using hts::testing::complaint;
using hts::testing::database_folder;
using hts::testing::TemporaryFolder;

namespace {

Wavelength micrometres(double um) {
    return Wavelength::from_micrometres(um);
}

std::string yaml(const std::string& data) {
    return "REFERENCES: |\n    Somebody\nDATA:\n" + data;
}

std::string complaint_about(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
    const auto path = folder.write(name, text);
    return complaint(folder, [&path] { static_cast<void>(read_optical_constants(path)); });
}

}  // namespace

TEST_CASE("every file of the database sample is read and evaluates over its range", "[.database]") {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator{database_folder()}) {
        const OpticalConstants material = read_optical_constants(entry.path());
        const auto [shortest, longest] = material.range();
        for (const double um : {shortest, std::sqrt(shortest * longest), longest}) {
            CHECK(material.index(micrometres(um)).n() > 0);
        }
        CHECK_FALSE(material.source().empty());
        CHECK(material.source().find_first_of("<\n") == std::string::npos);
        ++count;
    }
    CHECK(count >= 19);
}

TEST_CASE("tabulated nk, n and k and formulas are read and put together") {
    const TemporaryFolder folder;
    const auto read = [&folder](const std::string& data) {
        return read_optical_constants(folder.write("m.yml", yaml(data)));
    };
    const auto nk = read("  - type: tabulated nk\n    data: |\n        0.4 1.4 0.1\n        0.6 1.6 0.3\n");
    CHECK(nk.index(micrometres(0.5)).n() == Approx(1.5).epsilon(1e-14));
    CHECK(nk.index(micrometres(0.5)).k() == Approx(0.2).epsilon(1e-14));
    CHECK(nk.name() == (folder.path() / "m.yml").string());
    CHECK(nk.source() == "Somebody");

    const auto separate = read(
        "  - type: tabulated k\n    data: |\n        0.5 0.1\n        0.7 0.3\n"
        "  - type: tabulated n\n    data: |\n        0.4 1.4\n        0.6 1.6\n");
    CHECK(separate.range().shortest == 0.5);
    CHECK(separate.range().longest == 0.6);
    CHECK(separate.index(micrometres(0.5)).k() == 0.1);

    const auto formula = read(
        "  - type: formula 5\n    wavelength_range: 0.3 2.5\n    coefficients: 1.5 0.25 2\n"
        "  - type: tabulated k\n    data: |\n        0.2 0.1\n        1.0 0.1\n");
    CHECK(formula.range().shortest == 0.3);
    CHECK(formula.range().longest == 1.0);
    CHECK(formula.index(micrometres(1)).n() == 1.75);

    const auto old = read("  - type: formula 3\n    range: 0.3 2.5\n    coefficients: 2.25\n");
    CHECK(old.index(micrometres(1)).n() == 1.5);
    CHECK(old.index(micrometres(1)).k() == 0);

    const auto both = read(
        "  - type: formula 5\n    wavelength_range: 0.4 0.6\n    coefficients: 1.7\n"
        "  - type: tabulated nk\n    data: |\n        0.4 1.4 0.1\n        0.6 1.6 0.3\n");
    CHECK(both.index(micrometres(0.4)).n() == 1.7);
    CHECK(both.index(micrometres(0.4)).k() == 0.1);
    REQUIRE(both.warnings().size() == 1);
    CHECK_THAT(both.warnings()[0], Catch::EndsWith(": n stands in an item before: that one counts"));
    CHECK(formula.warnings().empty());

    const auto passed_over = read(
        "  - type: tabulated n2\n    data: |\n        0.5 1e-20\n"
        "  - type: tabulated n2\n    data: |\n        0.6 1e-20\n"
        "  - type: tabulated n\n    data: |\n        0.4 1.4\n");
    CHECK(passed_over.index(micrometres(0.4)).n() == 1.4);
}

TEST_CASE("formula entries outside DATA are passed over") {
    const TemporaryFolder folder;
    const auto material = read_optical_constants(folder.write(
        "m.yml",
        yaml("  - type: formula 5\n    wavelength_range: 0.3 2.5\n    coefficients: 1.5\n") +
            "PROPERTIES:\n    thermal_dispersion:\n      - type: formula A\n        coefficients: 1\n"));
    CHECK(material.index(micrometres(1)).n() == 1.5);
}

TEST_CASE("rows may be unsorted, double, with tabs, blank lines and CR LF") {
    const TemporaryFolder folder;
    const auto material = read_optical_constants(folder.write(
        "m.yml",
        yaml("  - type: tabulated nk\r\n    data: |\r\n        0.6 1.6 0.3\r\n\r\n        0.5\t1.4 0.1  \r\n"
             "        0.4 1.4 0.1\r\n        0.5 1.6 0.3\r\n")));
    CHECK(material.range().shortest == 0.4);
    CHECK(material.range().longest == 0.6);
    CHECK(material.index(micrometres(0.5)).n() == Approx(1.5).epsilon(1e-14));
    CHECK(material.index(micrometres(0.5)).k() == Approx(0.2).epsilon(1e-14));
}

TEST_CASE("the source is one line without HTML") {
    const TemporaryFolder folder;
    const std::string data = "DATA:\n  - type: tabulated n\n    data: |\n        0.5 1.5\n";
    const auto source = [&](const std::string& references) {
        return read_optical_constants(folder.write("m.yml", references + data)).source();
    };
    CHECK(source("REFERENCES: |\n    1) A. Raki\xC4\x87.<br>Title\n    <a "
                 "href=\"https://x.org/a>b\"></a><i>Opt.</i> <b>2</b>, 1&ndash;2 (k &lt; 1, n<2)\n") ==
          "1) A. Raki\xC4\x87. Title b\">Opt. 2, 1\xE2\x80\x93"
          "2 (k < 1, n<2)");
    CHECK(source("") == (folder.path() / "m.yml").string());
}

TEST_CASE("one row of a page that is no refractive index is refused where it is asked for alone") {
    const TemporaryFolder folder;
    const auto page = read_optical_constants(folder.write(
        "m.yml", yaml("  - type: tabulated nk\n    data: |\n        0.4 1.4 0.1\n        0.5 1.5 0.1\n"
                      "        0.6 1.6 -0.2\n        0.7 1.7 0.3\n        0.8 1.8 0.4\n")));
    const std::string row = (folder.path() / "m.yml").string() +
                            ":8: extinction coefficient k -0.2: must be >= 0 and at most 1e+24";
    REQUIRE(page.warnings() == std::vector<std::string>{row});
    const auto at = [&](double um) { return page.index(Wavelength::from_micrometres(um)); };
    CHECK(at(0.45).k() == Approx(0.1));
    CHECK(at(0.5).k() == 0.1);
    CHECK(at(0.7).k() == 0.3);
    CHECK(at(0.75).k() == Approx(0.35));
    for (const double um : {0.51, 0.6, 0.69})
        CHECK_THROWS_WITH(at(um), Catch::Contains("no index beside a row that has none: " + row));
}

TEST_CASE("YAML that cannot be is refused with path and line") {
    const TemporaryFolder folder;
    const std::string table = "  - type: tabulated nk\n    data: |\n        0.4 1.4 0.1\n";
    // DATA's first item stands in line 4, its first row in line 6.
    const std::pair<std::string, std::string> cases[] = {
        {table + "        0.5 1.5\n", "m.yml:7: 2 numbers in a row of a table of nk: must be 3"},
        {table + "\n        0.5 1.5 0 0\n", "m.yml:8: 4 numbers in a row of a table of nk: must be 3"},
        {table + "        0.5 abc 0\n", "m.yml:7: \"abc\" is not a number"},
        {table + "        0.5 nan 0\n", "m.yml:7: \"nan\" is not a finite number"},
        {"  - type: tabulated nk\n    data: |\n        0.5 1.5 -1e-9\n",
         "m.yml:6: extinction coefficient k -1e-09: must be >= 0 and at most 1e+24"},
        {"  - type: tabulated n\n    data: |\n        0.5 0\n        0.6 -1\n",
         "m.yml:6: refractive index n 0: must be > 0 and at most 1e+24"},
        {"  - type: tabulated kn\n    data: |\n        0.5 0.1 1\n",
         "m.yml:4: type \"tabulated kn\": not known; must be formula 1 to formula 9, tabulated nk, tabulated "
         "n, tabulated k or tabulated n2"},
        {"  - type: Formula 1\n    wavelength_range: 0.3 2.5\n    coefficients: 1\n",
         "m.yml:4: type \"Formula 1\": not known; must be formula 1 to formula 9, tabulated nk, tabulated n, "
         "tabulated k or tabulated n2"},
        {table + "    data: |\n        0.4 1.5 0.1\n", "m.yml:7: key \"data\": stands twice"},
        {"  - type: tabulated nk\n    type: tabulated k\n    data: |\n        0.4 1.4 0.1\n",
         "m.yml:5: key \"type\": stands twice"},
        {table + "DATA:\n" + table, "m.yml:7: key \"DATA\": stands twice"},
        {"  - type: formula 2\n    wavelength_range: 0.3 2.5\n    coefficients: 0 1.03961212 0.00600069867 "
         "0.231792344\n",
         "m.yml:4: formula 2 with 4 coefficients: C5 is missing: must end with a whole term"},
        {table + "        0 1.5 0\n", "m.yml:7: wavelength 0 um: must be > 0 (from 1e-24 to 1e+24 um)"},
        {"  - type: tabulated k\n    data: |\n        0.5 0.1 1\n",
         "m.yml:6: 3 numbers in a row of a table of k: must be 2"},
        {"  - type: tabulated k\n    data: 0.5\n", "m.yml:5: 1 numbers in a row of a table of k: must be 2"},
        {"  - type: tabulated nk\n    data: |\n", "m.yml:4: table without a row: must have at least one"},
        {"  - type: tabulated nk\n", "m.yml:4: key \"data\": missing"},
        {"  - type: tabulated nk\n    data:\n      - 1\n", "m.yml:6: key \"data\": must be text or numbers"},
        {"  - data: 1\n", "m.yml:4: key \"type\": missing"},
        {"  - just text\n", "m.yml:4: item of DATA: must be a mapping with a type"},
        {"  - type: tabulated k\n    data: |\n        0.5 0.1\n",
         "m.yml: key \"DATA\": no refractive index n: must have a formula or a table"},
        {"  - type: formula 5\n    coefficients: 1.5\n", "m.yml:4: key \"wavelength_range\": missing"},
        {"  - type: formula 5\n    wavelength_range: 0.3 2.5\n", "m.yml:4: key \"coefficients\": missing"},
        {"  - type: formula 5\n    wavelength_range: 0.3\n    coefficients: 1.5\n",
         "m.yml:5: key \"wavelength_range\": must be two wavelengths"},
        {"  - type: formula 5\n    wavelength_range: 2.5 0.3\n    coefficients: 1.5\n",
         "m.yml:4: end of the wavelength range 0.3 um: must be >= its beginning, 2.5 um"},
        {"  - type: formula 5\n    wavelength_range: 0.3 2.5\n    coefficients: 1.5 x\n",
         "m.yml:6: key \"coefficients\": \"x\" is not a number"},
        {"  - type: formula 10\n    wavelength_range: 0.3 2.5\n    coefficients: 1.5\n",
         "m.yml:4: dispersion formula 10: must be from 1 to 9"},
        {"  - type: formula A\n    wavelength_range: 0.3 2.5\n    coefficients: 1.5\n",
         "m.yml:4: \"formula A\": must be formula 1 to formula 9"},
        {table + "  - type: formula 1\n    wavelength_range: [1, 2\n",
         "m.yml:9: not valid YAML: end of sequence flow not found"},
        {"  - type: formula 5\n    wavelength_range: 0.3 0.4\n    coefficients: 1.5\n"
         "  - type: tabulated k\n    data: |\n        0.5 0\n",
         "m.yml: n is known from 0.3 to 0.4 um, k from 0.5 to 0.5 um: the two ranges must overlap"},
    };
    for (const auto& [data, message] : cases) CHECK(complaint_about(folder, "m.yml", yaml(data)) == message);
}

TEST_CASE("lines are counted right after text that is not ASCII") {
    const TemporaryFolder folder;
    const std::string text =
        "# \xC2\xB5m \xE2\x82\xAC\nDATA:\n  - type: tabulated n\n    data: |\n        0.5 x\n";
    CHECK(complaint_about(folder, "m.yml", text) == "m.yml:5: \"x\" is not a number");
    CHECK(complaint_about(folder, "m.yml", "\xEF\xBB\xBF" + text) == "m.yml:5: \"x\" is not a number");
}
