#include "validation/scattering/twins/model_distances.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <string>

#include "validation/scattering/further_studies.hpp"

using namespace hts::validation;

namespace {

const ReportTable& table_named(const GroundTruth& truth, const std::string& stem) {
    return *std::find_if(truth.section.tables.begin(), truth.section.tables.end(),
                         [&](const ReportTable& table) { return table.stem == stem; });
}

using Row = std::vector<std::string>;

}  // namespace

TEST_CASE("the kept rows of he beside he_unified are those that were found before the model was built") {
    const GroundTruth truth = model_distance_study(Effort::full);
    const ReportTable& table = table_named(truth, "model-summary");
    const auto has = [&](const Row& row) {
        return std::find(table.rows.begin(), table.rows.end(), row) != table.rows.end();
    };
    const std::string first = "conductor, first set", gentle = "of these gentle", glass = "glass 1.5, mixing";
    CHECK(has({first, "76", "te", "4.16", "0.64", "1.31", "30", "1.69", "0.16", "0.43", "62", "75", "73"}));
    CHECK(has({first, "76", "tm", "3.55", "1.20", "1.51", "16", "0.90", "0.23", "0.35", "64", "76", "76"}));
    CHECK(has({first, "76", "unpolarised", "2.72", "0.62", "0.96", "35", "0.98", "0.18", "0.32", "66", "64",
               "57"}));
    CHECK(has({gentle, "36", "te", "0.89", "0.32", "0.44", "27", "0.46", "0.09", "0.18", "36", "35", "34"}));
    CHECK(has({gentle, "36", "tm", "1.60", "0.75", "0.83", "16", "0.35", "0.15", "0.19", "36", "36", "36"}));
    CHECK(has({gentle, "36", "unpolarised", "1.07", "0.26", "0.49", "24", "0.31", "0.11", "0.14", "36", "27",
               "22"}));
    CHECK(has({glass, "12", "te", "0.81", "0.49", "0.51", "8", "0.57", "0.33", "0.35", "11", "10", "7"}));
    CHECK(has({glass, "12", "tm", "3.00", "0.56", "1.30", "6", "1.42", "0.27", "0.66", "8", "12", "11"}));
    CHECK(has(
        {glass, "12", "unpolarised", "0.87", "0.40", "0.49", "8", "0.45", "0.29", "0.30", "12", "10", "10"}));
    // profiles of 120 wavelengths, of which less light near the horizon passes the ends: no loss is left
    const std::string longer = "conductor, long profiles";
    CHECK(has({longer, "6", "te", "0.80", "0.54", "0.58", "2", "0.10", "0.06", "0.07", "6", "6", "6"}));
    CHECK(has(
        {longer, "6", "unpolarised", "0.45", "0.24", "0.30", "6", "0.19", "0.14", "0.14", "6", "6", "3"}));
    const std::string metal = "metal 0.16 + 3.6i";
    CHECK(has({metal, "9", "te", "0.76", "0.49", "0.50", "5", "0.45", "0.25", "0.30", "9", "9", "9"}));
    CHECK(has({metal, "9", "tm", "1.14", "0.57", "0.71", "3", "1.05", "0.41", "0.63", "5", "8", "7"}));
    CHECK(
        has({metal, "9", "unpolarised", "0.75", "0.40", "0.46", "7", "0.68", "0.33", "0.42", "7", "5", "7"}));
    CHECK(has({"metal, conductor_shortcut", "9", "unpolarised", "0.75", "0.40", "0.46", "7", "0.48", "0.41",
               "0.37", "9", "6", "2"}));
    // surfaces that were drawn by a seed before anything was evaluated on them
    const std::string drawn = "conductor, drawn by a seed";
    CHECK(has({drawn, "42", "te", "2.11", "0.58", "0.84", "15", "0.95", "0.26", "0.36", "37", "42", "42"}));
    CHECK(has({drawn, "42", "tm", "2.24", "1.18", "1.21", "6", "0.55", "0.26", "0.30", "41", "42", "42"}));
    CHECK(has({drawn, "42", "unpolarised", "1.61", "0.74", "0.82", "11", "0.64", "0.19", "0.25", "41", "42",
               "31"}));
    // K-correlated: nu 3/2 is met, the exponential is not
    const std::string exponential = "of these nu = 0.5", smoother = "of these nu = 1.5";
    CHECK(
        has({exponential, "12", "te", "3.42", "1.37", "1.70", "0", "1.79", "0.61", "0.98", "5", "12", "12"}));
    CHECK(
        has({exponential, "12", "tm", "2.36", "1.61", "1.70", "0", "2.46", "0.95", "1.14", "2", "11", "11"}));
    CHECK(has({exponential, "12", "unpolarised", "1.33", "0.68", "0.78", "2", "2.11", "0.58", "0.98", "6",
               "6", "5"}));
    CHECK(has({smoother, "12", "te", "0.82", "0.26", "0.45", "8", "0.22", "0.05", "0.09", "12", "12", "12"}));
    CHECK(has({smoother, "12", "tm", "1.14", "0.44", "0.68", "8", "0.35", "0.10", "0.19", "12", "12", "12"}));
    CHECK(has({smoother, "12", "unpolarised", "0.36", "0.10", "0.19", "12", "0.22", "0.07", "0.12", "12",
               "11", "12"}));
    const ReportTable& mirrors = table_named(truth, "model-mirrors");
    CHECK(mirrors.rows == std::vector<Row>{{"te", "0.062", "0.350", "0.013", "0.066"},
                                           {"tm", "0.051", "0.199", "0.006", "0.020"}});
}

TEST_CASE("distances of he, Kirchhoff and correlated Smith are those of the maps") {
    double worst = 0;
    std::size_t rows = 0;
    for (const CaseDistances& each : case_distances()) {
        const KeptSet& set = kept_sets()[each.set];
        const FigureTable map = kept_table(std::string{set.stem} + "-map");
        for (const auto& row : map.rows) {
            if (row[0] != each.surface.rms_roughness || row[1] != each.surface.correlation_length ||
                row[2] != each.theta_i_deg)
                continue;
            ++rows;
            const auto note = [&](const char* column, double value) {
                worst = std::fmax(worst, std::fabs(row[column_of(map, column)] - value));
            };
            note("he_torrance_te_db", each.he.te);
            note("he_torrance_tm_db", each.he.tm);
            note("he_torrance_db", each.he.unpolarised);
            note("smith_te_db", each.smith.te);
            note("smith_tm_db", each.smith.tm);
            note("smith_db", each.smith.unpolarised);
        }
    }
    std::printf("distances from tables of five digits against those of the study: %.1e dB at worst\n", worst);
    CHECK(rows == case_distances().size());
    CHECK(worst < 0.02);  // maps of the first set count bins without light, `least_light`
}

TEST_CASE("K-correlated surfaces drawn by a seed are the same on every machine, and within their ranges") {
    const auto drawn = drawn_k_correlated(2027, 8);
    REQUIRE(drawn.size() == 8);
    CHECK(drawn[0].surface.rms_roughness == 0.143);
    CHECK(drawn[0].surface.correlation_length == 2.582);
    CHECK(drawn[0].theta_i_deg[0] == 29.7);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto& [surface, angles] = drawn[i];
        CHECK(surface.nu == (i % 2 == 0 ? 0.5 : 1.5));
        CHECK(surface.rms_roughness >= 0.05);
        CHECK(surface.rms_roughness <= 0.25);
        CHECK(surface.correlation_length >= 0.5);
        CHECK(surface.correlation_length <= 4);
        CHECK(std::is_sorted(angles.begin(), angles.end()));
    }
}

TEST_CASE(
    "surfaces drawn by a seed are the same on every machine, within their ranges, and none of them is of the "
    "first set") {
    const auto drawn = drawn_surfaces(2026, 14);
    REQUIRE(drawn.size() == 14);
    CHECK(drawn[0].surface.rms_roughness == 0.2015);
    CHECK(drawn[0].surface.correlation_length == 0.528);
    CHECK(drawn[0].theta_i_deg[0] == 11.8);
    for (const auto& [surface, angles] : drawn) {
        const double slope = surface.rms_roughness / surface.correlation_length;
        CHECK(slope > 0.0499);
        CHECK(slope < 0.4001);
        CHECK(surface.correlation_length >= 0.5);
        CHECK(surface.correlation_length <= 6);
        REQUIRE(angles.size() == 3);
        CHECK(angles.front() >= 10);
        CHECK(angles.back() <= 75);
        CHECK(std::is_sorted(angles.begin(), angles.end()));
        for (const RoughnessStatistics& other : moment_grid(Effort::full))
            CHECK_FALSE((other.rms_roughness == surface.rms_roughness &&
                         other.correlation_length == surface.correlation_length));
    }
}
