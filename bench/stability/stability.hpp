/// The stability suite: the thirteen places where methods for the He-Torrance model fail, each met by this
/// project's engine and by the naive methods that suffer there, all against references of 80 digits or exact
/// limits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hts::bench {

/// How a method fared in a row, from best to worst.
enum class Verdict {
    ok,              ///< within its bound everywhere
    model,           ///< not arithmetic: what the model itself does
    too_slow,        ///< right, but with more work than `limit_of_terms` or `limit_of_steps`
    wrong,           ///< relative error above its bound
    underflow,       ///< 0 where the value is not 0
    no_convergence,  ///< an iteration that never stood still
    infinite,        ///< an infinity where the value is finite
    not_a_number,    ///< NaN
    silent           ///< bad input answered with a number
};

/// More terms of a sum, or steps of an iteration, are too slow for a renderer's inner loop.
inline constexpr double limit_of_terms = 1000;
inline constexpr double limit_of_steps = 20;

/// One method in one row: its worst case.
struct StabilityResult {
    int row;              ///< 1 ... 13
    std::string problem;  ///< what breaks there
    std::string method;
    bool engine;  ///< ours
    Verdict verdict;
    double error;          ///< worst relative error seen; infinity for NaN
    double bound;          ///< at which the method counts as wrong
    std::size_t cases;     ///< how many inputs were tried
    std::size_t failures;  ///< how many of them failed
    std::string detail;    ///< "wrong by 3e-2", "NaN", "too slow: 17000 terms, 0.3 ms"
    std::string where;     ///< the inputs of the worst case
    std::string why;       ///< one sentence: why it fails, or what the engine does instead
};

/// Runs everything, in a few seconds. In order of rows, the engine first in each.
[[nodiscard]] std::vector<StabilityResult> stability_suite();

/// Whether every engine's result is `ok` or `model`, and every row has one.
[[nodiscard]] bool engine_passes(const std::vector<StabilityResult>& results);

/// How many results of rivals are failures.
[[nodiscard]] std::size_t rival_failures(const std::vector<StabilityResult>& results);

[[nodiscard]] constexpr bool is_failure(Verdict verdict) noexcept {
    return verdict != Verdict::ok && verdict != Verdict::model;
}

/// "ok", "too slow", "NaN" …
[[nodiscard]] const char* name(Verdict verdict) noexcept;

}  // namespace hts::bench
