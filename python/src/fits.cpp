// Measured curves and fits.
#include "evaluation.hpp"
#include "module.hpp"
#include "pairs.hpp"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "hts/error.hpp"
#include "validation/curves/built_in_curves.hpp"
#include "validation/fit/fit.hpp"
#include "validation/fit/fit_curves.hpp"
#include "validation/fit/fit_findings.hpp"

namespace hts::python {
namespace {

using namespace validation;

template <class Choice>
Choice choice(const char* what, const std::string& text, std::initializer_list<Choice> choices) {
    std::string all;
    for (const Choice each : choices) {
        if (text == name(each)) return each;
        all += (all.empty() ? "" : ", ") + std::string{name(each)};
    }
    throw Error{std::string{what} + " \"" + text + "\": must be one of " + all};
}

nb::dict curves(const std::string& name_or_path) {
    const CurveSet set = curves_named(name_or_path);
    std::vector<double> columns[8];
    for (const Curve& curve : set.curves) {
        for (const CurvePoint& point : curve.points) {
            const double row[]{curve.band.first, curve.band.last, point.theta_i, point.phi_i,
                               point.theta_r,    point.phi_r,     point.value,   point.uncertainty};
            for (std::size_t i = 0; i < 8; ++i) columns[i].push_back(row[i]);
        }
    }
    nb::dict result;
    result["name"] = set.stem;
    result["surface"] = set.surface;
    result["source"] = set.source;
    result["licence"] = set.licence;
    result["quantity"] = name(set.quantity);
    constexpr const char* names[]{"first_wavelength", "last_wavelength", "theta_i", "phi_i",
                                  "theta_r",          "phi_r",           "value",   "uncertainty"};
    for (std::size_t i = 0; i < 8; ++i) result[names[i]] = array_of(columns[i]);
    return result;
}

/// Plain samples of arrays that broadcast: wavelength, light and view, value, uncertainty.
FitData samples_data(const nb::tuple& arrays, bool degrees) {
    constexpr const char* names[]{"wavelength", "theta_i", "theta_r", "phi", "brdf", "uncertainty"};
    std::vector<Operand> operands;
    for (std::size_t i = 0; i < 6; ++i) operands.emplace_back(names[i], arrays[i]);
    std::vector<const Operand*> all;
    for (const Operand& each : operands) all.push_back(&each);
    const Broadcast broadcast{all};
    const Walk walk{broadcast.shape(), std::vector<bool>(broadcast.shape().size(), true)};
    const auto value = [&](std::size_t which, std::size_t i) {
        return operands[which].data()[walk.offset(i, broadcast.steps(operands[which]))];
    };
    std::vector<double> wavelengths;
    for (std::size_t i = 0; i < walk.size(); ++i) wavelengths.push_back(value(0, i));
    std::ranges::sort(wavelengths);
    const auto repeated = std::ranges::unique(wavelengths);
    wavelengths.erase(repeated.begin(), repeated.end());
    const auto grid = spectral::WavelengthGrid::from_micrometres(wavelengths);
    std::vector<FitSample> samples;
    for (std::size_t i = 0; i < walk.size(); ++i) {
        const auto place = std::ranges::lower_bound(wavelengths, value(0, i)) - wavelengths.begin();
        const DirectionPair pair = of_element(broadcast.shape(), i, [&] {
            return DirectionPair{direction(value(1, i), 0, degrees),
                                 direction(value(2, i), value(3, i), degrees)};
        });
        samples.push_back({pair, static_cast<std::size_t>(place), value(4, i), value(5, i)});
    }
    return fit_data("samples", grid, samples);
}

nb::dict as_dict(const Fit& fit) {
    nb::dict result;
    nb::list parameters;
    for (const FittedParameter& p : fit.parameters)
        parameters.append(
            nb::make_tuple(p.name, p.unit, p.value, p.standard_error, p.lowest, p.highest, name(p.outcome)));
    result["model"] = fit.model;
    result["data"] = fit.data;
    result["parameters"] = parameters;
    result["correlated"] = nb::cast(fit.correlated);
    result["correlation"] = nb::cast(fit.correlation);
    result["predicted"] = array_of(fit.predicted);
    result["sigma0_over_tau"] =
        fit.slope ? nb::object(nb::make_tuple(fit.slope->value, fit.slope->standard_error)) : nb::none();
    result["sigma0_and_tau_apart"] = fit.slope_alone;
    result["errors_hold"] = fit.errors_hold;
    result["statements"] = nb::cast(fit.statements);
    result["material"] = fit.material;
    const FitStatistics& s = fit.statistics;
    result["values"] = s.data;
    result["free_parameters"] = s.free_parameters;
    result["rms_log"] = s.rms_log;
    result["median_abs_log"] = s.median_abs_log;
    result["rms"] = s.rms;
    result["reduced_chi_squared"] =
        s.reduced_chi_squared ? nb::object(nb::float_(*s.reduced_chi_squared)) : nb::none();
    result["aic"] = s.aic;
    result["bic"] = s.bic;
    return result;
}

/// The fit of a curve set by name or path, or of a tuple of arrays.
nb::dict fit(nb::object data, const std::string& model, int lobes, const std::string& index,
             const std::string& films, const std::vector<std::string>& freed,
             const std::map<std::string, double>& fixed, const std::map<std::string, double>& starts,
             const std::string& residual, const std::string& loss, std::size_t followed_starts,
             double largest_theta, bool degrees) {
    FitRequest request;
    request.model = model;
    request.lobes = lobes;
    request.index = index;
    request.films = films;
    request.freed = freed;
    request.fixed = fixed;
    request.starts = starts;
    using enum Residual;
    request.residual = choice("residual", residual, {logarithmic, relative, weighted, cosine});
    request.loss = choice("loss", loss, {Loss::squares, Loss::huber, Loss::cauchy});
    request.followed_starts = followed_starts;
    std::optional<FitData> of;
    std::optional<CurveSet> set;
    if (nb::isinstance<nb::str>(data)) {
        set = curves_named(nb::cast<std::string>(data));
        if (set->scale == Scale::unknown && !request.fixed.contains("scale"))
            request.freed.emplace_back("scale");
    } else {
        of = samples_data(nb::cast<nb::tuple>(data), degrees);
    }
    std::optional<Fit> made;
    {
        const nb::gil_scoped_release others_may_run;
        made =
            set ? fitted(request, *set, FitSelection{.largest_theta = largest_theta}) : fitted(request, *of);
    }
    return as_dict(*made);
}

}  // namespace

void bind_fits(nb::module_& module) {
    module.def("curve_names", &built_in_curve_names,
               "Names of the measured curve sets that come with the package.");
    module.def("_curves", &curves, HTS_ANY("_curves(name_or_path: str)"), nb::arg("name_or_path"));
    module.def(
        "_fit", &fit,
        HTS_ANY("_fit(data: typing.Any, model: str, lobes: int, index: str, films: str, free: typing.Any, "
                "fix: typing.Any, start: typing.Any, residual: str, loss: str, followed_starts: int, "
                "largest_theta: float, degrees: bool)"),
        nb::arg("data"), nb::arg("model"), nb::arg("lobes"), nb::arg("index"), nb::arg("films"),
        nb::arg("free"), nb::arg("fix"), nb::arg("start"), nb::arg("residual"), nb::arg("loss"),
        nb::arg("followed_starts"), nb::arg("largest_theta"), nb::arg("degrees"));
}

}  // namespace hts::python
