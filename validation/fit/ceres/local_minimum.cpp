// Levenberg and Marquardt's search by Ceres Solver: a module that least_squares.cpp loads when a first fit
// runs.

#include <ceres/ceres.h>

#include <algorithm>
#include <vector>

#include "validation/fit/least_squares.hpp"

namespace hts::validation {
namespace {

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

class StopCallback final : public ceres::IterationCallback {
  public:
    explicit StopCallback(bool (*asked)()) : asked_{asked} {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
        return asked_() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
    }

  private:
    bool (*asked_)();
};

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

Minimum minimum_by_ceres(const Residuals& residuals, std::vector<double> start,
                         const std::vector<Bounds>& bounds, const Stopping& stopping) {
    const auto first = residuals(start, false).residuals;
    ceres::Problem problem;
    problem.AddResidualBlock(new Function{residuals, start.size(), first.size()}, nullptr, start.data());
    for (std::size_t j = 0; j < bounds.size(); ++j) {
        problem.SetParameterLowerBound(start.data(), static_cast<int>(j), bounds[j].lowest);
        problem.SetParameterUpperBound(start.data(), static_cast<int>(j), bounds[j].highest);
    }
    StopCallback stop{stopping.asked_to_stop};
    ceres::Solver::Options options = solver_options(stopping);
    options.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return {start, half_sum_of_squares(residuals(start, false).residuals),
            static_cast<int>(summary.iterations.size()) - 1, summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace
}  // namespace hts::validation

/// What the module has.
extern "C" {
extern hts::validation::LocalMinimum* const hts_local_minimum;
hts::validation::LocalMinimum* const hts_local_minimum = hts::validation::minimum_by_ceres;
}
