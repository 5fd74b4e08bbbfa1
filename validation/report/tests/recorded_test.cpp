#include "validation/report/recorded.hpp"

#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "validation/papers/he_figures.hpp"
#include "validation/scattering/dielectric_scattering.hpp"
#include "validation/scattering/exact_scattering.hpp"
#include "validation/scattering/ground_truth.hpp"

namespace {

using namespace hts::validation;

Section with(std::string stem, std::vector<Check> checks) {
    return {std::move(stem), "A mirror", "", std::move(checks), {}, {}, {}, {}};
}

const std::vector<Section> sections{with("mirror", {{"reflectance <= 1", "0.980 at 45 deg", true},
                                                    {"peak within 6 deg", "9 deg", false, "slopes too steep"},
                                                    {"quick: noise", "1.2e-15", true}}),
                                    with("lamp", {{"fitted", "0.50 (430 points)", true, "", 0.1}})};

const Record recorded = Record{}.with(sections, Effort::quick).with(sections, Effort::full);

/// Contradictions when one check of the mirror is another.
std::vector<std::string> after(std::size_t place, const Check& check) {
    auto changed = sections;
    changed[0].checks[place] = check;
    return recorded.contradictions(changed, Effort::quick);
}

}  // namespace

TEST_CASE("texts agree but for their numbers, and those within a tolerance") {
    CHECK(agree("0.31 dB at 45 deg", "0.3103 dB at 45 deg", 0.01));
    CHECK_FALSE(agree("0.31 dB at 45 deg", "0.32 dB at 45 deg", 0.01));
    CHECK(agree("0.31 dB at 45 deg", "0.32 dB at 45 deg", 0.05));
    CHECK_FALSE(agree("9 of 76", "10 of 76", 0.01));
    CHECK_FALSE(agree("0.31 dB", "0.31 deg", 1));
    CHECK_FALSE(agree("0.31", "0.31, 0.32", 1));
    CHECK_FALSE(agree("0.31", "", 1));
    CHECK(agree("", "", 0));
    CHECK(agree("-2.5e-05 and 7.", "-2.50001e-05 and 7.", 1e-4));
    CHECK_FALSE(agree("-2.5e-05", "2.5e-05", 0.5));
    CHECK_FALSE(agree("2.5e-05", "2.5e-06", 0.5));
    CHECK(agree("off by 1.4e-17", "off by 0", 0));
    CHECK(agree("3e-36", "-7e-12", 0));
    CHECK_FALSE(agree("0.9", "nan", 0.5));
    CHECK_FALSE(agree("inf", "0.9", 0.5));
}

TEST_CASE("what is as recorded contradicts nothing, met or missed") {
    CHECK(recorded.contradictions(sections, Effort::quick).empty());
    CHECK(recorded.contradictions(sections, Effort::full).empty());
    CHECK(recorded.contradictions({}, Effort::full).empty());  // what was not asked for
    CHECK(after(0, {"reflectance <= 1", "0.981 at 45 deg", true}).empty());
}

TEST_CASE("a changed value, verdict or claim is caught") {
    using Lines = std::vector<std::string>;
    CHECK(after(0, {"reflectance <= 1", "0.960 at 45 deg", true}) ==
          Lines{"mirror: reflectance <= 1: met with 0.960 at 45 deg, recorded met with 0.980 at 45 deg"});
    CHECK(after(1, {"peak within 6 deg", "9 deg", true}) ==
          Lines{"mirror: peak within 6 deg: met with 9 deg, recorded missed with 9 deg"});
    CHECK(after(2, {"quick: sound", "0", true}) ==
          Lines{"mirror: quick: sound: 0, of which nothing is recorded",
                "mirror: quick: noise: recorded, and not computed"});
    auto fewer = sections;
    fewer[0].checks.erase(fewer[0].checks.begin() + 1);
    CHECK(recorded.contradictions(fewer, Effort::full) ==
          Lines{"mirror: peak within 6 deg: recorded, and not computed"});
    CHECK(recorded.contradictions(fewer, Effort::quick).empty());  // of the other effort
}

TEST_CASE("a record is read as it was written, with the tolerance of each quantity") {
    const Record read = Record::parse(recorded.text(), "r.json");
    CHECK(read.text() == recorded.text());
    auto changed = sections;
    changed[1].checks[0].measured = "0.54 (430 points)";
    CHECK(read.contradictions(changed, Effort::full).empty());
    changed[1].checks[0].measured = "0.56 (430 points)";
    CHECK(read.contradictions(changed, Effort::full).size() == 1);

    const auto fresh = Record::parse(read.with(changed, Effort::full).text(), "r.json");
    CHECK(fresh.contradictions(changed, Effort::full).empty());
    CHECK(fresh.contradictions(sections, Effort::full).size() == 1);
    CHECK(nlohmann::json::parse(fresh.text())["results"].size() == 4);  // none is lost, none stands twice
}

TEST_CASE("what is no record is refused") {
    const auto problem = [](const std::string& result) {
        return [text = R"({"results": [)" + result + "]}"] { return Record::parse(text, "r.json"); };
    };
    using Catch::Contains;
    CHECK_THROWS_WITH(Record::parse("[]", "r.json"), Contains("r.json"));
    CHECK_THROWS_WITH(
        problem(R"({"section": "a", "claim": "b", "verdict": "passed", "measured": "1", "tolerance": 0})")(),
        Contains("\"results[1].verdict\": \"passed\": must be met or missed"));
    CHECK_THROWS_WITH(
        problem(R"({"section": "a", "claim": "b", "verdict": "met", "measured": "1", "tolerance": -1})")(),
        Contains("\"results[1].tolerance\": must be >= 0"));
}

TEST_CASE("figures of the paper and kept exact scattering come out as recorded with the program") {
    std::vector<Section> computed{paper_figures_section(Effort::full)};
    Section conductors = with("exact-scattering", {}), glass = with("dielectric-scattering", {});
    conductors.checks = moment_checks({kept_table("moment-method-map"), kept_table("moment-method-lobes")});
    glass.checks = dielectric_checks({kept_table("dielectric-map"), kept_table("dielectric-lobes")});
    computed.push_back(conductors);
    computed.push_back(glass);
    CHECK(Record::kept().contradictions(computed, Effort::full) == std::vector<std::string>{});
    computed[0].checks[0].passed = !computed[0].checks[0].passed;
    CHECK(Record::kept().contradictions(computed, Effort::full).size() == 1);
}
