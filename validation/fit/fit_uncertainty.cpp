#include "validation/fit/fit_uncertainty.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using Eigen::Index;

constexpr double undetermined = 0.3;  // standard error in units of the parameters themselves
constexpr double strongly_correlated = 0.95;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

std::string three_digits(double value) {
    return spectral::brief(value, 3);
}

/// What a change of 1 in the scaled coordinates means: a factor e, or the value itself.
double unit(const FreeParameter& parameter) {
    if (parameter.range.motion == Motion::factors) return 1;
    const double whole = std::min(parameter.range.highest - parameter.range.lowest, 1.0);
    return std::max(std::abs(parameter.value), 0.05 * whole);
}

/// Eigenvalues and -vectors of the information matrix in scaled coordinates.
struct Information {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;

    /// Variance along a combination of scaled coordinates.
    [[nodiscard]] double variance(const Eigen::VectorXd& along) const {
        const double none = 1e-14 * values[values.size() - 1];
        double sum = 0;
        for (Index k = 0; k < values.size(); ++k) {
            const double share = vectors.col(k).dot(along);
            if (values[k] > none)
                sum += share * share / values[k];
            else if (share * share > 1e-10)
                return std::numeric_limits<double>::infinity();
        }
        return sum;
    }
    [[nodiscard]] double covariance(Index i, Index j) const {
        const double none = 1e-14 * values[values.size() - 1];
        double sum = 0;
        for (Index k = 0; k < values.size(); ++k)
            sum += vectors(i, k) * vectors(j, k) / std::max(values[k], none);
        return sum;
    }
};

Information information(const std::vector<FreeParameter>& parameters, const Columns& jacobian,
                        double variance) {
    const Index count = static_cast<Index>(parameters.size());
    Eigen::MatrixXd matrix(count, count);
    for (Index i = 0; i < count; ++i) {
        for (Index j = 0; j < count; ++j) {
            double sum = 0;
            for (std::size_t r = 0; r < jacobian[0].size(); ++r)
                sum += jacobian[at(i)][r] * jacobian[at(j)][r];
            matrix(i, j) = sum * unit(parameters[at(i)]) * unit(parameters[at(j)]) / variance;
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved{matrix};
    return {solved.eigenvalues().cwiseMax(0), solved.eigenvectors()};
}

/// "only sigma0/tau = 0.158 +- 0.002".
std::string combination(const FreeParameter& a, const FreeParameter& b, const Eigen::VectorXd& direction,
                        Index i, Index j, const Information& info) {
    const bool ratio = direction[i] * direction[j] > 0;
    Eigen::VectorXd along = Eigen::VectorXd::Zero(direction.size());
    along[i] = 1;
    along[j] = ratio ? -1 : 1;
    const double value = ratio ? a.value / b.value : a.value * b.value;
    return a.name + " and " + b.name + " apart: only " + a.name + (ratio ? "/" : " ") + b.name + " = " +
           three_digits(value) + " +- " + three_digits(std::abs(value) * std::sqrt(info.variance(along)));
}

/// A direction that is not determined, in words.
std::string in_words(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& direction,
                     const Information& info) {
    const double largest = direction.cwiseAbs().maxCoeff();
    std::vector<Index> involved;
    for (Index i = 0; i < direction.size(); ++i) {
        if (std::abs(direction[i]) > 0.3 * largest) involved.push_back(i);
    }
    const FreeParameter& first = parameters[at(involved.front())];
    if (involved.size() == 1) return first.name + ": the data leave it open";
    if (involved.size() == 2) {
        const FreeParameter& second = parameters[at(involved.back())];
        return combination(first, second, direction, involved.front(), involved.back(), info);
    }
    std::string text = "only together: ";
    for (const Index i : involved) {
        const double percent = 10 * direction[i] / largest;
        text += (i == involved.front() ? "" : ", ") + parameters[at(i)].name + (percent > 0 ? " +" : " ") +
                three_digits(percent) + " %";
    }
    return text + " change the fit by less than its noise";
}

std::vector<std::string> statements(const std::vector<FreeParameter>& parameters, const Information& info) {
    std::vector<std::string> result;
    for (Index k = 0; k < info.values.size(); ++k) {
        if (info.values[k] * undetermined * undetermined >= 1) continue;
        result.push_back(in_words(parameters, info.vectors.col(k), info));
    }
    return result;
}

}  // namespace

Uncertainty uncertainty(const std::vector<FreeParameter>& parameters, const Columns& jacobian,
                        double variance) {
    if (parameters.empty()) return {};
    const Index count = static_cast<Index>(parameters.size());
    const Information info =
        information(parameters, jacobian, std::max(variance, std::numeric_limits<double>::min()));
    Uncertainty result;
    for (Index i = 0; i < count; ++i) {
        const FreeParameter& parameter = parameters[at(i)];
        const double in_value = parameter.range.motion == Motion::factors ? parameter.value : unit(parameter);
        result.standard_errors.push_back(in_value *
                                         std::sqrt(info.variance(Eigen::VectorXd::Unit(count, i))));
        std::vector<double> row;
        for (Index j = 0; j < count; ++j) {
            row.push_back(info.covariance(i, j) / std::sqrt(info.covariance(i, i) * info.covariance(j, j)));
        }
        result.correlation.push_back(std::move(row));
    }
    result.statements = statements(parameters, info);
    for (Index i = 0; i < count; ++i) {
        for (Index j = i + 1; j < count; ++j) {
            const double r = result.correlation[at(i)][at(j)];
            if (!(std::abs(r) > strongly_correlated) || !result.statements.empty()) continue;
            result.statements.push_back(parameters[at(i)].name + " against " + parameters[at(j)].name +
                                        ": correlation " + three_digits(r));
        }
    }
    return result;
}

}  // namespace hts::validation
