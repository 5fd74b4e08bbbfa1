#include "validation/fit/least_squares.hpp"

#include <dlfcn.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hts/error.hpp"

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

/// The search by Ceres Solver, from its module in this installation. Whoever fits nothing waits for none of
/// the libraries of Ceres Solver, some twenty.
LocalMinimum& search() {
    static LocalMinimum* const loaded = [] {
        void* const module = ::dlopen(HTS_CERES_MODULE, RTLD_NOW | RTLD_LOCAL);
        const auto* const found =
            module != nullptr ? static_cast<LocalMinimum* const*>(::dlsym(module, "hts_local_minimum"))
                              : nullptr;
        if (found == nullptr)
            throw Error{std::string{"fits need a part of the installation: "} + ::dlerror()};
        return *found;
    }();
    return *loaded;
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
    if (start.empty()) return {{}, half_sum_of_squares(residuals(start, false).residuals), 0, true};
    return search()(residuals, std::move(start), bounds, stopping);
}

}  // namespace hts::validation
