#include "bench/stability/stability_row.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "hts/error.hpp"
#include "hts/tests/support/comparison.hpp"

namespace hts::bench {
namespace {

std::string whole(double value) {
    std::array<char, 400> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 0).ptr;
    return {text.data(), end};
}

Outcome of_error(double error, double bound) {
    if (std::isnan(error)) return {Verdict::not_a_number, INFINITY, "NaN"};
    if (error <= bound) return {Verdict::ok, error, "error " + brief(error)};
    return {Verdict::wrong, error, "wrong by " + brief(error)};
}

Outcome of_value(double computed, double expected, double bound) {
    const double error = testing::relative_error(computed, expected);
    if (error <= bound) return of_error(error, bound);
    if (std::isnan(computed)) return of_error(computed, bound);
    if (std::isinf(computed)) return {Verdict::infinite, error, "infinity"};
    if (computed == 0) return {Verdict::underflow, error, "0, should be " + brief(expected)};
    const std::string both = error > 0.5 ? ": " + brief(computed) + " for " + brief(expected) : "";
    return {Verdict::wrong, error, "wrong by " + brief(error) + both};
}

bool worse(const Outcome& a, const StabilityResult& b) {
    return a.verdict != b.verdict ? a.verdict > b.verdict : a.error > b.error;
}

}  // namespace

void StabilityRow::compare(const Contestant& method, double computed, double expected,
                           const std::string& where, const Effort& effort) {
    Outcome outcome = of_value(computed, expected, method.bound);
    if (outcome.verdict == Verdict::ok && effort.amount > effort.limit) {
        outcome = {Verdict::too_slow, effort.amount, "too slow"};
    }
    if (effort.amount > 0) outcome.detail += ", " + whole(effort.amount);
    if (!effort.unit.empty()) outcome.detail += (effort.amount > 0 ? " " : ", ") + effort.unit;
    judge(method, outcome, where);
}

void StabilityRow::compare_error(const Contestant& method, double error, const std::string& where) {
    judge(method, of_error(error, method.bound), where);
}

void StabilityRow::judge(const Contestant& method, const Outcome& outcome, const std::string& where) {
    StabilityResult& result = entry(method);
    if (is_failure(outcome.verdict)) ++result.failures;
    if (result.cases++ > 0 && !worse(outcome, result)) return;
    result.verdict = outcome.verdict;
    result.error = outcome.error;
    result.detail = outcome.detail;
    result.where = where;
}

StabilityResult& StabilityRow::entry(const Contestant& method) {
    const auto found = std::find_if(results_.begin(), results_.end(),
                                    [&](const auto& r) { return r.method == method.name; });
    if (found != results_.end()) return *found;
    return results_.emplace_back(StabilityResult{number_, problem_, method.name, method.engine, Verdict::ok,
                                                 0, method.bound, 0, 0, "", "", method.why});
}

std::vector<StabilityResult> StabilityRow::results() const {
    std::vector<StabilityResult> sorted = results_;
    std::stable_partition(sorted.begin(), sorted.end(), [](const auto& result) { return result.engine; });
    return sorted;
}

std::string place(const std::vector<Named>& inputs) {
    std::string text;
    for (const Named& input : inputs) {
        text.append(text.empty() ? "" : ", ").append(input.name).append(" = ").append(shortest(input.value));
        if (!input.unit.empty()) text.append(" ").append(input.unit);
    }
    return text;
}

}  // namespace hts::bench
