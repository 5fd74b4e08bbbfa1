/// Collects the cases of one row of the stability suite and keeps each method's worst.
#pragma once

#include <functional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "bench/stability/stability.hpp"
#include "spectral/text/text.hpp"

namespace hts::bench {

/// A contestant: `bound` is the relative error at which it counts as wrong.
struct Contestant {
    std::string name;
    bool engine;
    double bound;
    std::string why;
};

/// The bound of rivals. Lenient: a naive formula may lose ten digits before it counts as wrong.
inline constexpr double rival_bound = 1e-6;

/// What a method did in one case.
struct Outcome {
    Verdict verdict;
    double error;
    std::string detail;
};

/// Effort of a case: how many of what, and how many that may be.
struct Effort {
    double amount = 0;
    double limit = 0;
    std::string unit;
};

class StabilityRow {
  public:
    StabilityRow(int number, std::string problem) : number_{number}, problem_{std::move(problem)} {}

    /// A value beside the true one.
    void compare(const Contestant& method, double computed, double expected, const std::string& where,
                 const Effort& effort = {});
    /// An error that was measured elsewhere; NaN if the method gave NaN.
    void compare_error(const Contestant& method, double error, const std::string& where);
    /// A verdict of another kind.
    void judge(const Contestant& method, const Outcome& outcome, const std::string& where);

    /// The engine's results first.
    [[nodiscard]] std::vector<StabilityResult> results() const;

  private:
    StabilityResult& entry(const Contestant& method);

    int number_;
    std::string problem_;
    std::vector<StabilityResult> results_;
};

/// "3.2e-05", two digits or as many as asked for.
[[nodiscard]] inline std::string brief(double value, int digits = 2) {
    return spectral::brief(value, digits);
}

/// "sigma0/tau = 0.1, theta = 89 deg" from {{"sigma0/tau", 0.1}, …}.
struct Named {
    std::string_view name;
    double value;
    std::string_view unit{};
};
[[nodiscard]] std::string place(const std::vector<Named>& inputs);

}  // namespace hts::bench
