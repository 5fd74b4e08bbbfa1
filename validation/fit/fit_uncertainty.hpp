/// How sure fitted parameters are, and what data cannot tell, in words. Private to the fits.
#pragma once

#include <string>
#include <vector>

#include "validation/fit/fit_model.hpp"
#include "validation/fit/least_squares.hpp"

namespace hts::validation {

/// A parameter that a fit moved freely.
struct FreeParameter {
    std::string name;
    ParameterRange range;
    double value;
};

struct Uncertainty {
    std::vector<double> standard_errors;  ///< in the values' units; infinity where the data say nothing
    std::vector<std::vector<double>> correlation;
    std::vector<std::string> statements;
};

/// From the derivatives of residuals after the coordinates (logarithms for Motion::factors) and the
/// residuals' variance. A direction in the space of parameters is not determined when one standard error
/// along it is 30 % or more of the parameters; of one that is determined only together with another, their
/// ratio or product is given with its own error.
[[nodiscard]] Uncertainty uncertainty(const std::vector<FreeParameter>& parameters, const Columns& jacobian,
                                      double variance);

}  // namespace hts::validation
