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

Eigen::MatrixXd matrix_of(const Columns& columns, const std::vector<double>& units) {
    Eigen::MatrixXd result(static_cast<Index>(columns.front().size()), static_cast<Index>(columns.size()));
    for (Index j = 0; j < result.cols(); ++j) {
        result.col(j) =
            units[at(j)] * Eigen::Map<const Eigen::VectorXd>(columns[at(j)].data(), result.rows());
    }
    return result;
}

/// Sums of the rows of a curve, each times its change with the gain.
Eigen::MatrixXd gain_sums(const Eigen::MatrixXd& rows, const Scatter& scatter) {
    const std::size_t curves = scatter.curves.empty() ? 0 : *std::ranges::max_element(scatter.curves) + 1;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Index>(curves), rows.cols());
    for (std::size_t r = 0; r < scatter.curves.size(); ++r)
        result.row(static_cast<Index>(scatter.curves[r])) +=
            scatter.by_gain[r] * rows.row(static_cast<Index>(r));
    return result;
}

/// Variances of combinations of the scaled coordinates.
class Covariance {
  public:
    Covariance(const Eigen::MatrixXd& jacobian, const Scatter& scatter, const Noise& noise) : noise_{noise} {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved{jacobian.transpose() * jacobian};
        const Index count = jacobian.cols();
        Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(count, count);
        null_ = inverse;
        for (Index k = 0; k < count; ++k) {
            const double value = solved.eigenvalues()[k];
            const Eigen::VectorXd vector = solved.eigenvectors().col(k);
            if (value > 1e-14 * solved.eigenvalues()[count - 1])
                inverse += vector * vector.transpose() / value;
            else
                null_ += vector * vector.transpose();
        }
        const double least = std::numeric_limits<double>::min();
        of_noise_ = std::max(noise.variance, least) * inverse;
        const Eigen::MatrixXd gains = gain_sums(jacobian, scatter) * inverse;
        of_gains_ = noise.gain_variance * gains.transpose() * gains;
    }

    /// Infinity where the data say nothing.
    [[nodiscard]] double variance(const Eigen::VectorXd& along) const {
        if (along.dot(null_ * along) > 1e-10) return std::numeric_limits<double>::infinity();
        const double a = along.dot(of_noise_ * along), b = along.dot(of_gains_ * along);
        // Satterthwaite's degrees of freedom of a sum
        const double spread = a * a / noise_.freedom + (b > 0 ? b * b / noise_.gain_freedom : 0);
        return (a + b) * (spread > 0 ? student_variance((a + b) * (a + b) / spread) : 1);
    }
    /// As a matrix; directions of which the data say nothing have a variance that is large.
    [[nodiscard]] Eigen::MatrixXd matrix() const {
        const double gains = noise_.gain_freedom > 0 ? student_variance(noise_.gain_freedom) : 1;
        const Eigen::MatrixXd known = of_noise_ + gains * of_gains_;
        return known + 1e8 * std::max(1.0, known.trace()) * null_;
    }

  private:
    Noise noise_;
    Eigen::MatrixXd null_, of_noise_, of_gains_;
};

/// "only sigma0/tau = 0.158 +- 0.002".
std::string combination(const FreeParameter& a, const FreeParameter& b, const Eigen::VectorXd& direction,
                        Index i, Index j, const Covariance& found) {
    const bool ratio = direction[i] * direction[j] > 0;
    Eigen::VectorXd along = Eigen::VectorXd::Zero(direction.size());
    along[i] = 1;
    along[j] = ratio ? -1 : 1;
    const double value = ratio ? a.value / b.value : a.value * b.value;
    return a.name + " and " + b.name + " apart: only " + a.name + (ratio ? "/" : " ") + b.name + " = " +
           three_digits(value) + " +- " + three_digits(std::abs(value) * std::sqrt(found.variance(along)));
}

/// A direction that is not determined, in words.
std::string in_words(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& direction,
                     const Covariance& found) {
    const double largest = direction.cwiseAbs().maxCoeff();
    std::vector<Index> involved;
    for (Index i = 0; i < direction.size(); ++i) {
        if (std::abs(direction[i]) > 0.3 * largest) involved.push_back(i);
    }
    const FreeParameter& first = parameters[at(involved.front())];
    if (involved.size() == 1) return first.name + ": the data leave it open";
    if (involved.size() == 2) {
        const FreeParameter& second = parameters[at(involved.back())];
        return combination(first, second, direction, involved.front(), involved.back(), found);
    }
    std::string text = "only together: ";
    for (const Index i : involved) {
        const double percent = 10 * direction[i] / largest;
        text += (i == involved.front() ? "" : ", ") + parameters[at(i)].name + (percent > 0 ? " +" : " ") +
                three_digits(percent) + " %";
    }
    return text + " change the fit by less than its noise";
}

std::vector<std::string> statements(const std::vector<FreeParameter>& parameters, const Covariance& found) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved{found.matrix()};
    std::vector<std::string> result;
    for (Index k = solved.eigenvalues().size(); k-- > 0;) {
        if (solved.eigenvalues()[k] >= undetermined * undetermined)
            result.push_back(in_words(parameters, solved.eigenvectors().col(k), found));
    }
    return result;
}

/// What is left of residuals beside the space that the columns span, and how many dimensions that has.
struct Beside {
    Eigen::MatrixXd basis;

    explicit Beside(const Columns& jacobian, Index rows) : basis{rows, 0} {
        if (jacobian.empty()) return;
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors{
            matrix_of(jacobian, std::vector<double>(jacobian.size(), 1))};
        basis = factors.householderQ() * Eigen::MatrixXd::Identity(rows, factors.rank());
    }
};

}  // namespace

double Noise::along(const std::vector<double>& direction, const Scatter& scatter) const {
    const Eigen::VectorXd sums = gain_sums(
        Eigen::Map<const Eigen::VectorXd>(direction.data(), static_cast<Index>(direction.size())), scatter);
    const double gains = gain_freedom > 0 ? student_variance(gain_freedom) : 1;
    return variance + gains * gain_variance * sums.squaredNorm();
}

double student_variance(double freedom) noexcept {
    const double enough = std::max(freedom, 2.5);
    return enough / (enough - 2);
}

Noise noise(const Columns& jacobian, const Scatter& scatter) {
    const auto count = static_cast<Index>(scatter.residuals.size());
    const Eigen::Map<const Eigen::VectorXd> residuals{scatter.residuals.data(), count};
    const Beside fitted_space{jacobian, count};
    Noise result;
    result.freedom = std::max(1.0, static_cast<double>(count - fitted_space.basis.cols()));
    result.variance = residuals.squaredNorm() / result.freedom;

    // lengths of the gains' columns; the columns themselves share no row
    const Eigen::Map<const Eigen::VectorXd> by_gain{scatter.by_gain.data(), count};
    const Eigen::VectorXd squares = gain_sums(by_gain, scatter);
    const Eigen::VectorXd lengths = squares.cwiseSqrt().cwiseMax(1e-150);
    const Eigen::MatrixXd in_basis =
        lengths.cwiseInverse().asDiagonal() * gain_sums(fitted_space.basis, scatter);
    const Eigen::MatrixXd left =
        Eigen::MatrixXd::Identity(squares.size(), squares.size()) - in_basis * in_basis.transpose();
    const Eigen::VectorXd means = lengths.cwiseInverse().asDiagonal() * gain_sums(residuals, scatter);
    const Eigen::MatrixXd of_gain = left * squares.asDiagonal() * left;
    // expected: all = freedom v + tr(left squares) g, means = tr(left) v + tr(of_gain) g
    const double all_by_gain = (left * squares.asDiagonal()).trace();
    const double determinant = result.freedom * of_gain.trace() - left.trace() * all_by_gain;
    const bool told =
        squares.size() > 1 && left.trace() > 0.5 && determinant > 1e-6 * result.freedom * of_gain.trace();
    if (!told) return result;
    const double of_means = means.squaredNorm(), all = residuals.squaredNorm();
    const double gain = (result.freedom * of_means - left.trace() * all) / determinant;
    if (!(gain > 0)) return result;
    const double rest = std::max(0.0, all - all_by_gain * gain) / result.freedom;
    const Eigen::MatrixXd spread = rest * left + gain * of_gain;
    result.variance = rest;
    result.gain_variance = gain;
    result.gain_freedom = spread.trace() * spread.trace() / (spread * spread).trace();
    return result;
}

Uncertainty uncertainty(const std::vector<FreeParameter>& parameters, const Columns& jacobian,
                        const Scatter& scatter, const Noise& noise) {
    if (parameters.empty()) return {};
    const auto count = static_cast<Index>(parameters.size());
    std::vector<double> units;
    units.reserve(parameters.size());
    for (const FreeParameter& parameter : parameters) units.push_back(unit(parameter));
    const Covariance found{matrix_of(jacobian, units), scatter, noise};
    const Eigen::MatrixXd matrix = found.matrix();
    Uncertainty result;
    for (Index i = 0; i < count; ++i) {
        const Eigen::VectorXd own = Eigen::VectorXd::Unit(count, i);
        const FreeParameter& parameter = parameters[at(i)];
        const double in_value = parameter.range.motion == Motion::factors ? parameter.value : units[at(i)];
        result.standard_errors.push_back(in_value * std::sqrt(found.variance(own)));
        std::vector<double> row, ratios;
        for (Index j = 0; j < count; ++j) {
            row.push_back(matrix(i, j) / std::sqrt(matrix(i, i) * matrix(j, j)));
            ratios.push_back(std::sqrt(found.variance(own - Eigen::VectorXd::Unit(count, j))));
        }
        result.correlation.push_back(std::move(row));
        result.of_ratios.push_back(std::move(ratios));
    }
    result.statements = statements(parameters, found);
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
