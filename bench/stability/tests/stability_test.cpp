#include "bench/stability/stability.hpp"

#include <iostream>
#include <sstream>

#include <catch2/catch.hpp>

#include "bench/stability/stability_report.hpp"
#include "bench/stability/stability_row.hpp"

using hts::bench::Contestant;
using hts::bench::is_failure;
using hts::bench::StabilityResult;
using hts::bench::StabilityRow;
using hts::bench::Verdict;

namespace {

const std::vector<StabilityResult>& suite() {
    static const std::vector<StabilityResult> results = hts::bench::stability_suite();
    return results;
}

}  // namespace

TEST_CASE("the engine passes every row of the stability suite, where naive methods fail") {
    hts::bench::write_stability_text(std::cout, suite());
    for (const StabilityResult& result : suite()) {
        if (!result.engine) continue;
        INFO(result.row << " " << result.method << ": " << result.detail << " at " << result.where);
        CHECK_FALSE(is_failure(result.verdict));
    }
    CHECK(hts::bench::engine_passes(suite()));
    CHECK(hts::bench::rival_failures(suite()) >= 10);
    CHECK(suite().front().row == 1);
    CHECK(suite().back().row == 13);

    std::ostringstream html;
    hts::bench::write_stability_html(html, suite());
    CHECK(html.str().find("prefers-color-scheme: dark") != std::string::npos);
    CHECK(html.str().find("http") == std::string::npos);
    std::ostringstream csv;
    hts::bench::write_stability_csv(csv, suite());
    CHECK(csv.str().starts_with(
        "row,problem,method,engine,verdict,error,bound,cases,failures,detail,where,why\n1,"));
    for (const StabilityResult& result : suite()) {
        CHECK_FALSE(result.why.empty());
        CHECK_FALSE(result.where.empty());
    }
}

TEST_CASE("a row keeps each method's worst case") {
    StabilityRow row{1, "problem"};
    const Contestant rival{"rival", false, 1e-3, "why"};
    row.compare(rival, 1.0001, 1, "first");
    CHECK(row.results().front().verdict == Verdict::ok);
    row.compare(rival, 1.5, 1, "second");
    row.compare(rival, 1.2, 1, "third");
    CHECK(row.results().front().where == "second");
    row.compare(rival, std::numeric_limits<double>::quiet_NaN(), 1, "fourth");
    row.compare(rival, 0, 1, "fifth");
    CHECK(row.results().size() == 1);
    CHECK(row.results().front().verdict == Verdict::not_a_number);
    CHECK(row.results().front().where == "fourth");
    CHECK(row.results().front().cases == 5);
    CHECK(row.results().front().failures == 4);
}

TEST_CASE("a row tells zeros, infinities and slowness apart and puts the engine first") {
    StabilityRow row{1, "problem"};
    row.compare({"zero", false, 1e-3, "why"}, 0, 1, "");
    row.compare({"infinity", false, 1e-3, "why"}, std::numeric_limits<double>::infinity(), 1, "");
    row.compare({"slow", false, 1e-3, "why"}, 1, 1, "", {5000, 1000, "terms"});
    row.compare({"engine", true, 1e-3, "why"}, 1, 1, "");
    const auto results = row.results();
    CHECK(results[0].engine);
    CHECK(results[1].verdict == Verdict::underflow);
    CHECK(results[2].verdict == Verdict::infinite);
    CHECK(results[3].verdict == Verdict::too_slow);
    CHECK_FALSE(hts::bench::engine_passes(results));  // not all thirteen rows
    CHECK(hts::bench::rival_failures(results) == 3);
}
