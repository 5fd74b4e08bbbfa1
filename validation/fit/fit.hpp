/// Fits models to measured reflectance: the parameters that come closest, how sure they are, and what the
/// data cannot tell.
///
///     const FitData data = fit_data("my plate", grid, samples);
///     const Fit fit = fitted(FitRequest{.model = "he", .index = "\"Al\""}, data);
///     fit.parameters[0].value;   // sigma0 [um]
///     fit.statements;            // "sigma0 and tau apart: only sigma0/tau = 0.158 +- 0.002"
///
/// Method. Starts are all combinations of each parameter's starts (fit_model.hpp), for several lobes also the
/// best fit with one lobe less. The most promising ones are followed to their minimum by Levenberg and
/// Marquardt's method within bounds (Ceres Solver), lengths and widths by their logarithms. Parameters on
/// which predictions depend affinely (albedos, weights of lobes) are separated where the residuals allow it:
/// for each trial of the others their best values follow from linear least squares within bounds (variable
/// projection), so that the search is over shapes alone. Starts run on all cores; the result has the same
/// bits for any number.
///
/// The starts are followed until a step gains less than a millionth; those within 5 % of the lowest sum are
/// finished. Where both sigma0 and tau are sought, the limit of a very rough surface, where only their ratio
/// matters, is one more start.
///
/// Uncertainties are those of linearised least squares. Residuals are taken for noise of each datum and an
/// error of gain that the data of a curve share, both as large as the residuals say (fit_uncertainty.hpp).
/// Where the very rough surface comes as close as such noise allows, sigma0 and tau are open however sharp
/// the minimum. Where the model is wrong in some systematic way along the curves, the errors are too small; a
/// reduced chi squared above 2, gains allowed for, tells, and a statement says that they do not hold. sigma0
/// and tau are open then wherever the very rough surface's sum is at most twice the lowest.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/fit/fit_data.hpp"
#include "validation/fit/fit_model.hpp"

namespace hts::validation {

/// What is made small.
enum class Residual {
    logarithmic,  ///< ln(model/measured): every decade counts alike
    relative,     ///< (model - measured)/measured
    weighted,     ///< (model - measured)/uncertainty
    cosine,       ///< (model - measured) cos theta_i [1/sr], the metric of [Kurt10] after Ngan et al. 2005
};

/// How large residuals count, rho(r^2) with r in units of FitRequest::loss_scale.
enum class Loss {
    squares,  ///< r^2
    huber,    ///< r^2 up to 1, 2 |r| - 1 beyond
    cauchy,   ///< ln(1 + r^2)
};

[[nodiscard]] const char* name(Residual residual) noexcept;
[[nodiscard]] const char* name(Loss loss) noexcept;

struct FitRequest {
    std::string model = "he";
    int lobes = 1;
    std::string index{};  ///< JSON of the material file's key, where the optical constants are known
    std::string films{};  ///< JSON of the material file's key; they are held
    /// Held at a value, by name or key: {"a", 0}, {"n", 1.5}. A name without channel or lobe means all of
    /// them.
    std::map<std::string, double> fixed{};
    std::vector<std::string> freed{};        ///< that are tied or fixed unless named here: "my", "k", "scale"
    std::map<std::string, double> starts{};  ///< the only start of a parameter
    Residual residual = Residual::logarithmic;
    Loss loss = Loss::squares;
    double loss_scale = 1;
    bool conserve_energy = false;  ///< holds what the material reflects of the light at 0, 45 and 75 deg at 1
    std::size_t followed_starts = 8;  ///< how many of the most promising starts are followed
    int most_iterations = 100;
};

/// What became of a parameter.
enum class Outcome { fitted, at_bound, fixed, tied };
[[nodiscard]] const char* name(Outcome outcome) noexcept;

struct FittedParameter {
    std::string name, unit;
    double value;
    double standard_error;  ///< in the value's unit; 0 unless fitted, infinity where the data say nothing
    double lowest, highest;
    Outcome outcome;
    std::string key{};  ///< of the material file, places behind "/"; of "scale" and of channels empty
};

/// How far model and data are apart. Means over all data.
struct FitStatistics {
    std::size_t data, free_parameters;
    double rms_log;         ///< root mean square of `log_ratio`, over data that have one
    double median_abs_log;  ///< median of its magnitude
    double rms;             ///< root mean square difference, unit of the data
    double l2;              ///< the same times cos theta_i [Kurt10, after Ngan et al. 2005]
    std::optional<double> reduced_chi_squared;  ///< where uncertainties are known
    /// Standard deviation of the curves' errors of gain that the residuals show, relative; 0 where they show
    /// none.
    double gain_error;
    double cost;  ///< sum of rho over all data
    /// n ln(cost/n) + 2 k, Akaike, k the free parameters and the residuals' variance; comparable between fits
    /// of one residual and loss to the same data.
    double aic;
    double bic;  ///< n ln(cost/n) + k ln n, Schwarz
};

/// What happened to one start.
struct FitStart {
    double cost;  ///< at its minimum, as FitStatistics::cost
    int iterations;
    bool converged;
};

/// A number determined by two others.
struct Ratio {
    double value, standard_error;
};

/// The best fit whose sigma0 is so large that the specular term is gone and sigma0/tau alone matters.
struct RoughSurface {
    Ratio slope;
    double cost;  ///< as FitStatistics::cost
};

struct Fit {
    std::string model, data;
    FitRequest request;
    std::vector<FittedParameter> parameters;  ///< of the model in the order of its keys, then the scale
    /// Of the fitted parameters; a row each.
    std::vector<std::string> correlated;
    std::vector<std::vector<double>> correlation;
    std::vector<double> predicted;  ///< a value per datum
    FitStatistics statistics;
    std::optional<Ratio> slope{};         ///< sigma0/tau, of a model that has both
    std::optional<RoughSurface> rough{};  ///< where sigma0 and tau are both sought
    bool slope_alone = false;             ///< sigma0 and tau are not told apart, only `slope`
    bool errors_hold = true;              ///< false where reduced chi squared says that the model is wrong
    std::vector<FitStart> starts;
    std::size_t starts_at_best;           ///< whose cost came within 1e-4 of the lowest
    std::vector<std::string> statements;  ///< what the data cannot tell, in words
    std::string material;                 ///< the fitted material file, without the scale

    [[nodiscard]] const FittedParameter& parameter(const std::string& name) const;
};

/// RequestError that names an unknown model or parameter, one both freed and fixed, a start or fixed value
/// out of bounds; hts::Error for fewer data than free parameters, uncertainties that are needed and not
/// there, a value of 0 where its logarithm is needed.
///   with_a_lobe_less   the fit of the same request but for that, where it was made already: it is not made
///                      again
[[nodiscard]] Fit fitted(const FitRequest& request, const FitData& data,
                         const Fit* with_a_lobe_less = nullptr);

/// The fitted material as it is read from its file, without the scale.
[[nodiscard]] spectral::Material fitted_material(const Fit& fit);

}  // namespace hts::validation
