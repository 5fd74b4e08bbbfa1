/// The schema of BiRD files, as far as hts writes them.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace hts::tables::testing {

/// What of BiRD's schema 1.0 a file must be.
inline void check_bird(const nlohmann::json& file) {
    using nlohmann::json;
    CHECK(file.size() == 2);
    const json &metadata = file.at("metadata"), &data = file.at("data");
    const auto has = [](const json& object, std::initializer_list<const char*> keys) {
        for (const char* key : keys) {
            INFO(key);
            CHECK(object.contains(key));
        }
    };
    has(metadata, {"schema", "id", "type", "timestamp", "provenance", "method", "instrumentation", "software",
                   "sample", "environment"});
    CHECK(metadata["type"] == "BRDF");
    CHECK(metadata["method"] == "simulation");
    for (const char* key : {"instrumentation", "environment"}) CHECK(metadata[key] == "NA");
    const std::regex uri{R"((https|urn):\S+)"}, time{R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00)"};
    for (const char* key : {"schema", "id"}) CHECK(std::regex_match(metadata[key].get<std::string>(), uri));
    CHECK(std::regex_match(metadata["timestamp"].get<std::string>(), time));
    has(metadata["provenance"], {"organization", "location", "email", "contact_person"});
    has(metadata["provenance"]["location"], {"country", "city", "street", "building_nr", "postal_code"});
    has(metadata.at("license"), {"type", "rights_holder"});
    has(metadata["software"], {"name"});
    has(metadata["software"].at("simulation_model"), {"name", "description"});
    for (const json& parameter : metadata["software"]["simulation_model"].at("parameters")) {
        has(parameter, {"name", "description", "value", "unit"});
        CHECK(parameter["value"].is_number());
    }
    has(metadata["sample"], {"name", "type", "dimensions", "shape", "zero_azimuth_location"});

    const std::size_t count = data.at("BRDF").at("values").size();
    CHECK(count > 0);
    const auto check_variable = [&](const char* name, const std::set<std::string>& units, double least,
                                    double below) {
        INFO(name);
        const json& variable = data.at(name);
        CHECK(units.contains(variable.at("unit").get<std::string>()));
        const auto values = variable.at("values").get<std::vector<double>>();
        CHECK(values.size() == count);
        CHECK(std::ranges::all_of(values, [&](double v) { return v >= least && v < below; }));
        for (const auto& [key, value] : variable.items())
            CHECK(std::set<std::string>{"unit", "values", "uncertainty", "comments"}.contains(key));
    };
    for (const char* name : {"theta_i", "theta_r"}) check_variable(name, {"deg"}, 0, 90);
    for (const char* name : {"phi_i", "phi_r"}) check_variable(name, {"deg"}, 0, 360);
    check_variable("wavelength_i", {"nm", "\u03bcm"}, 0, 1e9);
    check_variable("BRDF", {"1/sr", "sr^-1"}, 0, HUGE_VAL);
    CHECK(data["BRDF"].at("uncertainty").at("value").get<double>() > 0);
    CHECK(data["BRDF"]["uncertainty"].at("unit") == "%");
    CHECK(data.size() == 6);
}

}  // namespace hts::tables::testing
