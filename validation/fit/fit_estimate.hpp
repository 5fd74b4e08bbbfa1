/// The least-squares estimate at a minimum, and the limit of a very rough surface beside
/// it. Private to the fits.
#pragma once

#include <optional>
#include <vector>

#include "validation/fit/fit_problem.hpp"
#include "validation/fit/fit_uncertainty.hpp"

namespace hts::validation {

[[nodiscard]] bool at_bound(double coordinate, const Bounds& bounds);

/// The least-squares estimate and how sure it is.
struct Estimate {
    std::vector<std::size_t> places;  // of the parameters that are free of bounds, in their order
    std::vector<FreeParameter> parameters;
    Scatter scatter;
    Noise noise;
    Uncertainty uncertainty;
};

[[nodiscard]] Estimate estimate(const FitProblem& problem, const FitData& data,
                                const std::vector<double>& coordinates);

/// Where sigma0 and tau stand, where both are sought.
struct RoughPlaces {
    std::size_t sigma0, tau;
};

[[nodiscard]] std::optional<RoughPlaces> rough_places(const FitProblem& problem);

/// The best fit whose sigma0 is so large that only sigma0/tau matters.
struct RoughLimit {
    double cost;                 // as Minimum::cost
    std::vector<double> values;  // of all parameters
    Estimate estimate;
    Ratio slope;
};

///   from   values of all parameters where the search begins, but for sigma0 and tau in their ratio
[[nodiscard]] RoughLimit rough_limit(const FitProblem& problem, const RoughPlaces& at,
                                     const FitRequest& request, const FitData& data,
                                     const std::vector<double>& from);

/// Whether what the rough limit misses more than the best fit is within three standard deviations of the
/// noise that it shows, and that noise, errors of gain aside, is no larger than the best fit's, by three
/// standard deviations of either: a limit that misses the shape of the curves is no alternative.
///   cost   of the best fit, whose estimate is `best`
[[nodiscard]] bool within_noise(const RoughLimit& rough, double cost, const Estimate& best);

}  // namespace hts::validation
