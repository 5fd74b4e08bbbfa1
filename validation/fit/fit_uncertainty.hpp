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

/// Residuals at a minimum, and what makes some of them err together.
struct Scatter {
    std::vector<double> residuals;
    std::vector<double> by_gain;      ///< derivative of each by ln(gain) of its curve
    std::vector<std::size_t> curves;  ///< of each, from 0
};

/// What residuals are made of: noise of each, and an error of gain that the data of a curve share.
struct Noise {
    double variance = 0;       ///< of each residual
    double gain_variance = 0;  ///< of ln(gain), from curve to curve
    double freedom = 0;        ///< degrees of freedom behind the variance
    double gain_freedom = 0;   ///< behind that of gains; 0 where curves cannot tell it

    /// Variance along a direction in the space of residuals, of length 1.
    [[nodiscard]] double along(const std::vector<double>& direction, const Scatter& scatter) const;
};

/// Both variances from their moments: the expected sums of squares of all residuals and of the curves' means,
/// with what the parameters took of either. Without two curves of more than one datum there are no gains.
[[nodiscard]] Noise noise(const Columns& jacobian, const Scatter& scatter);

/// Of an estimated variance: that of Student's t over that of the normal distribution, for at least 2.5
/// degrees of freedom.
[[nodiscard]] double student_variance(double freedom) noexcept;

struct Uncertainty {
    std::vector<double> standard_errors;  ///< in the values' units; infinity where the data say nothing
    std::vector<std::vector<double>> correlation;
    std::vector<std::vector<double>> of_ratios;  ///< relative standard errors of value i / value j
    std::vector<std::string> statements;
};

/// From the derivatives of residuals after the coordinates (logarithms for Motion::factors): the covariance
/// of the least-squares estimate under such noise, (J'J)^-1 J'V J (J'J)^-1. Standard errors are standard
/// deviations of Student's t, so that few curves make them wide. A direction in the space of parameters is
/// not determined when one standard error along it is 30 % or more of the parameters; of one that is
/// determined only together with another, their ratio or product is given with its own error.
[[nodiscard]] Uncertainty uncertainty(const std::vector<FreeParameter>& parameters, const Columns& jacobian,
                                      const Scatter& scatter, const Noise& noise);

}  // namespace hts::validation
