#include "bench/charts/chart.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/charts/chart_script.hpp"
#include "bench/charts/chart_tables.hpp"

using namespace hts::bench;
using Real = boost::multiprecision::cpp_bin_float_50;

namespace {

const ChartMethod& method(const std::string& title, bool batch = false) {
    for (const ChartMethod& each : chart_methods()) {
        if (each.title() == title && each.batch == batch) return each;
    }
    FAIL("no method " << title);
    return chart_methods().front();
}

/// Everything measured, on few points.
const ChartData& small_chart() {
    static const ChartData data = measured_charts({60, 256, {12, 8}, 2e-4, 5}, [](const std::string&) {});
    return data;
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream in{line};
    for (std::string cell; std::getline(in, cell, ',');) result.push_back(cell);
    return result;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("the charts' reference agrees with 80 digits to all the digits it states") {
    std::ifstream file{HTS_SOURCE_DIR "/hts/tests/reference/phi.csv"};
    double worst = 0;
    int rows = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#') || line.starts_with("g,")) continue;
        const auto row = cells(line);
        const double g = std::stod(row[0]), t = std::stod(row[1]);
        const Real expected{row[3]};
        if (!(g > 0) || expected < least_phi) continue;
        const PhiReference computed = phi_reference(g, t);
        INFO("g = " << row[0] << ", t = " << row[1]);
        const double error =
            abs((Real{computed.value} + Real{computed.remainder}) / expected - 1).convert_to<double>();
        CHECK(error <= 5.01e-25);  // half of the last of the 25 digits written
        worst = std::max(worst, error);
        ++rows;
    }
    std::cout << "phi_reference: worst " << worst << " of " << rows << ", bound 5e-25\n";
    CHECK(rows > 400);
}

TEST_CASE("relative errors keep what a double would round away and know failures") {
    const PhiReference phi{1, 0x1p-60};
    CHECK(phi.relative_error(1) == 0x1p-60);
    CHECK(phi.relative_error(1.5) == Approx(0.5));
    CHECK(phi.relative_error(0) == HUGE_VAL);
    CHECK(phi.relative_error(HUGE_VAL) == HUGE_VAL);
    CHECK(phi.relative_error(NAN) == HUGE_VAL);
}

TEST_CASE("every regime's inputs are what it says, and the same again") {
    for (const Regime regime : regimes) {
        INFO(key(regime));
        const PhiInputs inputs = random_inputs(regime, 500, 3);
        CHECK(inputs.t == random_inputs(regime, 500, 3).t);
        CHECK(inputs.t != random_inputs(regime, 500, 4).t);
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            CHECK(inputs.g[i] > 0);
            CHECK(inputs.t[i] <= most_ratio * inputs.g[i]);
            if (regime == Regime::far_tail) CHECK(inputs.t[i] >= 50 * inputs.g[i]);
        }
    }
}

TEST_CASE("this project's Phi keeps its tolerance in every regime and over the whole plane") {
    std::size_t checked = 0;
    for (const AccuracyPoint& point : small_chart().accuracy) {
        if (!point.method->ours) continue;
        INFO(point.method->title() << " in " << key(point.regime) << " at g = " << point.errors.worst_g
                                   << ", t = " << point.errors.worst_t);
        CHECK(point.errors.worst <= point.method->error);
        CHECK(point.errors.energy <= point.errors.worst);
        CHECK(point.errors.quantile <= point.errors.worst);
        CHECK(point.nanoseconds > 0);
        ++checked;
    }
    CHECK(checked == 6 * 6);
    for (const ErrorMap& map : small_chart().maps) {
        if (!map.method->ours) continue;
        for (const double error : map.errors) CHECK((std::isnan(error) || error <= map.method->error));
    }
}

TEST_CASE("methods that fail are marked where they fail, and only there") {
    const auto fails = [](const std::string& title, Regime regime) {
        for (const AccuracyPoint& point : small_chart().accuracy) {
            if (point.method == &method(title) && point.regime == regime) return point.errors.fails();
        }
        return false;
    };
    CHECK(fails("series, fixed, 200 terms", Regime::very_rough));
    CHECK_FALSE(fails("series, fixed, 200 terms", Regime::smooth));
    CHECK(fails("series, adaptive", Regime::very_rough));
    CHECK_FALSE(fails("series, adaptive", Regime::moderate));
    CHECK(fails("saddle point, order 2", Regime::smooth));
    CHECK_FALSE(fails("saddle point, order 2", Regime::rough));
    CHECK(fails("rough limit", Regime::far_tail));
    CHECK(fails("GGX lobe", Regime::far_tail));
    CHECK(fails("float series, adaptive", Regime::very_rough));
    CHECK_FALSE(fails("series, windowed, ratios", Regime::very_rough));
}

TEST_CASE("GGX is a lobe of the same energy as the rough limit's") {
    double integral = 0;  // over t/g, by t/g = y/(1 - y)
    for (int i = 0; i < 1000; ++i) {
        const double y = (i + 0.5) / 1000;
        integral += 5 * phi_ggx(5, 5 * y / (1 - y)) / ((1 - y) * (1 - y)) / 1000;
    }
    CHECK(integral == Approx(1).epsilon(1e-9));
}

TEST_CASE("the tables hold every method and name the machine") {
    const ChartTable table = accuracy_table(small_chart());
    const std::string csv = table.csv();
    CHECK(csv.find("# processor: ") != std::string::npos);
    CHECK(csv.find("\nregime,method,setting,") != std::string::npos);
    CHECK(count(csv, "\nfar-tail,") == chart_methods().size());
    const auto json = nlohmann::json::parse(table.json());
    CHECK(json["seed"] == "5");
    CHECK(json["flags"].is_string());
    CHECK(json["rows"].size() == 6 * chart_methods().size());
    CHECK(nlohmann::json::parse(map_table(small_chart()).json())["rows"].size() ==
          12 * 8 * small_chart().maps.size());
    CHECK(nlohmann::json::parse(cost_table(small_chart()).json())["rows"].size() ==
          small_chart().cost.size());
}

TEST_CASE("the scripts draw every method and print machine, commit and seed") {
    for (const std::string& script :
         {error_time_script(small_chart()), error_map_script(small_chart()), cost_script(small_chart())}) {
        CHECK(script.find("set multiplot") != std::string::npos);
        CHECK(script.find(small_chart().machine.compiler) != std::string::npos);
        CHECK(script.find("commit " + small_chart().machine.commit + ", seed 5") != std::string::npos);
        CHECK(script.find("inf ") == std::string::npos);
    }
    const std::string maps = error_map_script(small_chart());
    for (const ErrorMap& map : small_chart().maps) {
        CHECK(maps.find(hts::output::gnuplot_string(map.method->title())) != std::string::npos);
    }
}
