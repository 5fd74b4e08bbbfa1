#include "validation/fit/least_squares.hpp"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "spectral/jobs/progress.hpp"

namespace hts::validation {
namespace {

// ---- linear

Eigen::MatrixXd matrix_of(const Columns& columns, std::size_t rows) {
    Eigen::MatrixXd matrix(rows, columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
        matrix.col(static_cast<Eigen::Index>(j)) =
            Eigen::Map<const Eigen::VectorXd>(columns[j].data(), matrix.rows());
    }
    return matrix;
}

/// Minimises x'Ax/2 - b'x within bounds: unknowns are freed from their bounds one at a time, the one that
/// promises most first, and are held again where the free solution would pass a bound (Lawson and Hanson;
/// Stark and Parker).
class BoundedQuadratic {
  public:
    BoundedQuadratic(Eigen::MatrixXd a, Eigen::VectorXd b, const std::vector<Bounds>& bounds)
        : a_{std::move(a)}, b_{std::move(b)}, bounds_{bounds}, x_(b_.size()) {
        for (Eigen::Index j = 0; j < x_.size(); ++j) x_[j] = bound(j).lowest;
    }

    [[nodiscard]] const Eigen::VectorXd& solution() {
        for (Eigen::Index round = 0; round < 10 * x_.size() && free_best(); ++round) {
            while (move_to_free_solution()) {
            }
        }
        return x_;
    }

  private:
    [[nodiscard]] const Bounds& bound(Eigen::Index j) const { return bounds_[static_cast<std::size_t>(j)]; }
    [[nodiscard]] bool is_free(Eigen::Index j) const { return std::ranges::find(free_, j) != free_.end(); }

    /// Frees the held unknown whose move into its range lowers the sum fastest; false if none does.
    bool free_best() {
        const Eigen::VectorXd gradient = b_ - a_ * x_;
        Eigen::Index best = -1;
        double most = 0;
        for (Eigen::Index j = 0; j < x_.size(); ++j) {
            if (is_free(j) || !(a_(j, j) > 0)) continue;
            const double gain = gradient[j] * (x_[j] > bound(j).lowest ? -1 : 1) / std::sqrt(a_(j, j));
            if (gain <= most + 1e-13 * std::abs(b_[j]) / std::sqrt(a_(j, j))) continue;
            most = gain;
            best = j;
        }
        if (best >= 0) free_.push_back(best);
        return best >= 0;
    }

    /// Moves the free unknowns towards their own minimum; true if a bound came in between and holds one now.
    bool move_to_free_solution() {
        if (free_.empty()) return false;
        Eigen::VectorXd held = x_;
        held(free_).setZero();
        const Eigen::VectorXd rest = b_ - a_ * held;
        const Eigen::VectorXd wanted = a_(free_, free_).completeOrthogonalDecomposition().solve(rest(free_));
        double step = 1;
        std::ptrdiff_t limiting = -1;
        for (std::size_t i = 0; i < free_.size(); ++i) {
            const double from = x_[free_[i]], to = wanted[static_cast<Eigen::Index>(i)];
            const double limit = to < from ? bound(free_[i]).lowest : bound(free_[i]).highest;
            if ((to - limit) * (limit - from) <= 0 || (to - from) * step == 0) continue;
            const double share = (limit - from) / (to - from);
            if (share < step) {
                step = share;
                limiting = static_cast<std::ptrdiff_t>(i);
            }
        }
        for (std::size_t i = 0; i < free_.size(); ++i) {
            double& x = x_[free_[i]];
            x += step * (wanted[static_cast<Eigen::Index>(i)] - x);
            x = std::clamp(x, bound(free_[i]).lowest, bound(free_[i]).highest);
        }
        if (limiting < 0) return false;
        const Eigen::Index stopped = free_[static_cast<std::size_t>(limiting)];
        x_[stopped] =
            wanted[limiting] < bound(stopped).lowest ? bound(stopped).lowest : bound(stopped).highest;
        free_.erase(free_.begin() + limiting);
        return true;
    }

    Eigen::MatrixXd a_;
    Eigen::VectorXd b_;
    const std::vector<Bounds>& bounds_;
    Eigen::VectorXd x_;
    std::vector<Eigen::Index> free_;
};

// ---- not linear

class Function final : public ceres::CostFunction {
  public:
    Function(const Residuals& residuals, std::size_t unknowns, std::size_t count) : residuals_{residuals} {
        set_num_residuals(static_cast<int>(count));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns));
    }

    bool Evaluate(const double* const* parameters, double* values, double** jacobians) const override {
        const auto unknowns = static_cast<std::size_t>(parameter_block_sizes().front());
        const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
        const auto [residuals, columns] = residuals_({parameters[0], unknowns}, wanted);
        std::ranges::copy(residuals, values);
        for (std::size_t j = 0; j < columns.size(); ++j) {
            for (std::size_t i = 0; i < columns[j].size(); ++i)
                jacobians[0][i * columns.size() + j] = columns[j][i];
        }
        return true;
    }

  private:
    const Residuals& residuals_;
};

/// Gives up where the process is asked to stop.
class StopCallback final : public ceres::IterationCallback {
  public:
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
        return spectral::asked_to_stop() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
    }
};

double half_sum_of_squares(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum / 2;
}

ceres::Solver::Options solver_options(const Stopping& stopping) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = stopping.most_iterations;
    options.function_tolerance = stopping.least_gain;
    options.parameter_tolerance = 1e-10;
    options.gradient_tolerance = 1e-14;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    return options;
}

}  // namespace

std::vector<double> bounded_linear_solution(const Columns& columns, std::span<const double> target,
                                            const std::vector<Bounds>& bounds) {
    const Eigen::MatrixXd matrix = matrix_of(columns, target.size());
    const Eigen::Map<const Eigen::VectorXd> wanted{target.data(), matrix.rows()};
    const Eigen::MatrixXd a = matrix.transpose() * matrix;
    const Eigen::VectorXd b = matrix.transpose() * wanted;
    BoundedQuadratic problem{a, b, bounds};
    const Eigen::VectorXd& x = problem.solution();
    return {x.begin(), x.end()};
}

Columns beside(const Columns& columns, const Columns& others) {
    if (columns.empty() || others.empty()) return columns;
    const std::size_t rows = columns.front().size();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors{matrix_of(others, rows)};
    const Eigen::MatrixXd basis =
        factors.householderQ() * Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(rows), factors.rank());
    Columns result;
    for (const auto& column : columns) {
        const Eigen::Map<const Eigen::VectorXd> whole{column.data(), static_cast<Eigen::Index>(rows)};
        const Eigen::VectorXd rest = whole - basis * (basis.transpose() * whole);
        result.emplace_back(rest.begin(), rest.end());
    }
    return result;
}

Minimum local_minimum(const Residuals& residuals, std::vector<double> start,
                      const std::vector<Bounds>& bounds, const Stopping& stopping) {
    const auto first = residuals(start, false).residuals;
    if (start.empty()) return {{}, half_sum_of_squares(first), 0, true};
    ceres::Problem problem;
    problem.AddResidualBlock(new Function{residuals, start.size(), first.size()}, nullptr, start.data());
    for (std::size_t j = 0; j < bounds.size(); ++j) {
        problem.SetParameterLowerBound(start.data(), static_cast<int>(j), bounds[j].lowest);
        problem.SetParameterUpperBound(start.data(), static_cast<int>(j), bounds[j].highest);
    }
    ceres::Solver::Summary summary;
    StopCallback stop;
    ceres::Solver::Options options = solver_options(stopping);
    options.callbacks.push_back(&stop);
    ceres::Solve(options, &problem, &summary);
    return {start, half_sum_of_squares(residuals(start, false).residuals),
            static_cast<int>(summary.iterations.size()) - 1, summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace hts::validation
