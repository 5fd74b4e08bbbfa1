/// A model, its parameters' roles and data, as a least-squares problem. Private to the fits.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "validation/fit/fit.hpp"
#include "validation/fit/fit_changes.hpp"
#include "validation/fit/least_squares.hpp"

namespace hts::validation {

/// What a parameter does during a search.
enum class Role {
    searched,   ///< by the solver
    separated,  ///< follows from linear least squares
    fixed,
    tied,
};

struct Place {
    FitParameter parameter;
    Role role = Role::searched;
    double value = 0;      ///< where it is fixed
    std::size_t tied = 0;  ///< to which place
    bool start_given = false;
};

/// Immutable; calls may run on any thread.
class FitProblem {
  public:
    FitProblem(const FitRequest& request, const FitData& data);

    [[nodiscard]] const FitModel& model() const noexcept { return model_; }
    [[nodiscard]] const std::vector<Place>& places() const noexcept { return places_; }
    /// Those that are searched, then those that are separated.
    [[nodiscard]] const std::vector<std::size_t>& free() const noexcept { return free_; }
    [[nodiscard]] std::size_t searched_count() const noexcept { return searched_; }
    /// Bounds of the free parameters' coordinates: logarithms for those that move by factors.
    [[nodiscard]] const std::vector<Bounds>& bounds() const noexcept { return bounds_; }

    /// All combinations of starts, thinned to at most 512: coordinates of what is searched.
    [[nodiscard]] std::vector<std::vector<double>> starts() const;
    /// What is searched, from values of all parameters.
    [[nodiscard]] std::vector<double> searched(std::span<const double> values) const;
    /// The coordinates of all free parameters with the best values for those that are separated.
    [[nodiscard]] std::vector<double> completed(std::span<const double> searched) const;
    /// Bounds of what is searched, and what is searched over: `projected_residuals`.
    [[nodiscard]] std::vector<Bounds> searched_bounds() const {
        return {bounds_.begin(), bounds_.begin() + static_cast<std::ptrdiff_t>(searched_)};
    }
    [[nodiscard]] Residuals residuals_to_search() const;
    /// Residuals as the solver sees them, of what is searched with the best of what is separated. The
    /// derivatives leave out what the separated ones can make up for, as they stand [Kaufman 1975].
    [[nodiscard]] Linearised projected_residuals(std::span<const double> searched, bool with_jacobian) const;
    /// The same at any coordinates of all free parameters. After those of the data come what conserved energy
    /// is exceeded by, where that was asked for.
    [[nodiscard]] Linearised residuals(std::span<const double> coordinates, bool with_jacobian) const;

    /// Derivatives of the residuals by the logarithm of a factor on what is
    /// predicted: what a wrong gain does.
    [[nodiscard]] std::vector<double> change_with_gain(std::span<const double> coordinates) const;

    /// Values of all parameters.
    [[nodiscard]] std::vector<double> values(std::span<const double> coordinates) const;
    /// What the instrument would have shown.
    [[nodiscard]] std::vector<double> predicted(const std::vector<double>& values) const;

  private:
    void assign_roles();
    [[nodiscard]] std::vector<std::size_t> named(const std::string& name) const;
    [[nodiscard]] double start_unit(std::size_t place, const std::vector<double>& values) const;
    [[nodiscard]] double weight(std::size_t datum) const;
    /// Whether the factor "scale" applies to a datum, and what it is then.
    [[nodiscard]] bool has_scale(std::size_t datum) const {
        return data_.without_scale.empty() || !data_.without_scale[datum];
    }
    [[nodiscard]] double importance(std::size_t datum) const {
        return data_.importance.empty() ? 1 : data_.importance[datum];
    }
    [[nodiscard]] double scale_of(std::size_t datum, double scale) const {
        return has_scale(datum) ? scale : 1;
    }
    [[nodiscard]] Columns predictions(const std::vector<std::vector<double>>& values) const;
    [[nodiscard]] std::vector<Move> moves(std::span<const double> coordinates) const;
    [[nodiscard]] Move move(std::span<const double> coordinates, std::size_t k) const;
    [[nodiscard]] std::size_t choices(std::size_t place) const;
    [[nodiscard]] std::vector<double> start(std::size_t combination) const;
    void set_tied(std::vector<double>& values) const;
    [[nodiscard]] double residual(double predicted, std::size_t datum) const;
    [[nodiscard]] double residual_slope(double predicted, std::size_t datum) const;
    [[nodiscard]] std::vector<double> best_linear(std::vector<double> values,
                                                  const std::vector<std::size_t>& linear) const;

    FitRequest request_;
    const FitData& data_;
    FitModel model_;
    std::vector<Place> places_;
    std::vector<std::size_t> free_;
    std::size_t searched_ = 0;
    std::vector<Bounds> bounds_;
    std::optional<EnergyWatch> watch_;
    std::vector<double> weights_;  // of a difference, for linear least squares
    bool separable_;
};

}  // namespace hts::validation
