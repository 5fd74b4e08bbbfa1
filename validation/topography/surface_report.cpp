#include "validation/topography/surface_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hts/correlation/correlation.hpp"
#include "hts/error.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using nlohmann::ordered_json;
using spectral::brief;

constexpr double degrees = 180 / std::numbers::pi;

std::string padded(std::string text, std::size_t width) {
    text.append(text.size() < width ? width - text.size() : 1, ' ');
    return text;
}

std::string line(const std::string& title, const std::string& text) {
    return padded(title, 20).append(text).append("\n");
}

std::string with_error(double value, double error) {
    return brief(value) + " +- " + brief(error, 2);
}

std::string count_of(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// "0.454 ... 169 um".
std::string periods(const FrequencyBand& band) {
    return brief(1 / band.last, 3) + " ... " + brief(1 / band.first, 3) + " um";
}

std::string map_text(const StudiedMap& map) {
    const HeightMap& heights = map.levelled.map;
    std::string text = std::to_string(heights.columns()) + " x " + std::to_string(heights.rows()) +
                       " points of " + brief(heights.step_x()) + " x " + brief(heights.step_y()) +
                       " um, rms " + brief(map.statistics.rms) + " um, tilt " +
                       brief(std::hypot(map.levelled.tilt_x, map.levelled.tilt_y) * degrees, 2) + " deg";
    if (map.levelled.gaps > 0) text.append(", ").append(count_of(map.levelled.gaps, "gap"));
    if (map.levelled.outliers > 0) text.append(", ").append(count_of(map.levelled.outliers, "outlier"));
    return line(heights.name(), text);
}

std::string fit_text(const SpectrumFit& fit, const SpectrumFit& best_fit) {
    std::string text = padded(std::string{fit.title}, 20) + padded(brief(fit.deviance, 3), 10);
    for (const FittedValue& value : fit.values) {
        if (value.name == "length_um" || value.name == "nu") continue;  // B and C say the same
        text += value.name + " " + with_error(value.value, value.error);
        if (std::ranges::find(fit.at_bounds, value.name) != fit.at_bounds.end()) text += " (at its bound)";
        text += "  ";
    }
    return text + (&fit == &best_fit ? "<- best\n" : "\n");
}

ordered_json band_json(const FrequencyBand& band) {
    return {1 / band.last, 1 / band.first};
}

ordered_json map_json(const StudiedMap& map) {
    const HeightMap& heights = map.levelled.map;
    return {{"name", heights.name()},
            {"columns", heights.columns()},
            {"rows", heights.rows()},
            {"step_um", {heights.step_x(), heights.step_y()}},
            {"gaps", map.levelled.gaps},
            {"outliers", map.levelled.outliers},
            {"tilt", {map.levelled.tilt_x, map.levelled.tilt_y}},
            {"rms_um", map.statistics.rms},
            {"rms_of_spectrum_um", std::sqrt(map.spectrum.variance())},
            {"window_share", map.spectrum.window_share},
            {"known_periods_um", band_json(map.known)}};
}

ordered_json statistics_json(const HeightStatistics& s) {
    return {{"rms_um", s.rms},
            {"mean_absolute_um", s.mean_absolute},
            {"lowest_um", s.lowest},
            {"highest_um", s.highest},
            {"skewness", s.skewness},
            {"skewness_error", s.skewness_error},
            {"kurtosis", s.kurtosis},
            {"kurtosis_error", s.kurtosis_error},
            {"gaussian_heights", s.gaussian()},
            {"slope_x", s.slope_x},
            {"slope_y", s.slope_y}};
}

ordered_json fit_json(const SpectrumFit& fit) {
    ordered_json values = ordered_json::array();
    for (const FittedValue& value : fit.values)
        values.push_back({{"name", value.name}, {"value", value.value}, {"standard_error", value.error}});
    return {{"description", fit.model},
            {"values", values},
            {"rms_of_fitted_spectrum_um", fit.free_rms.value},
            {"rms_of_fitted_spectrum_error_um", fit.free_rms.error},
            {"rms_of_known_periods_um", fit.rms_of_band.value},
            {"rms_of_known_periods_error_um", fit.rms_of_band.error},
            {"deviance", fit.deviance},
            {"aic", fit.aic},
            {"at_bounds", fit.at_bounds}};
}

/// A length, or those along and across an axis.
ordered_json lengths(double length, const Ellipse& ellipse) {
    if (ellipse.ratio == 1) return length;
    const double root = std::sqrt(ellipse.ratio);
    return {length * root, length / root};
}

void add_correlation(ordered_json& material, const SpectrumFit& fit, const Ellipse& ellipse) {
    const RoughnessScale& first = fit.scales.front();
    if (fit.model == "k_correlation") {
        material["correlation"] = {{"type", "k_correlation"},
                                   {"B_um", lengths(2 * std::numbers::pi * first.length, ellipse)},
                                   {"C", 2 * first.nu + 1},
                                   {"psd", "1d one-sided"}};
    } else if (fit.model == "two_scales") {
        ordered_json parts = ordered_json::array();
        for (const RoughnessScale& scale : fit.scales)
            parts.push_back(
                ordered_json::array({scale.weight, {{"type", "gaussian"}, {"length_um", scale.length}}}));
        material["correlation"] = {{"type", "sum"}, {"of", parts}};
    } else {
        material["correlation_length_um"] = lengths(first.length, ellipse);
        if (fit.model != "gaussian") material["correlation"] = fit.model;
    }
    if (ellipse.ratio != 1) material["azimuth_deg"] = ellipse.azimuth * degrees;
}

/// A number of the material and what its relative error is: a factor on one of SpectrumFit::covariances.
struct ErrorOf {
    std::string key;
    std::size_t place;
    double factor = 1;

    [[nodiscard]] bool at_bound(const SpectrumFit& fit) const {
        return place > 0 && std::ranges::find(fit.at_bounds, fit.values[place].name) != fit.at_bounds.end();
    }
};

std::vector<ErrorOf> errors_of(const SpectrumFit& fit, const Ellipse& ellipse) {
    std::vector<ErrorOf> errors{{"rms_roughness_um", 0}};
    const auto add_length = [&](const std::string& key, std::size_t place) {
        if (ellipse.ratio == 1) return errors.push_back({key, place});
        for (const char* which : {"/0", "/1"}) errors.push_back({key + which, place});
    };
    if (fit.model == "k_correlation") {
        add_length("correlation/B_um", 3);
        errors.push_back({"correlation/C", 4});
    } else if (fit.model == "two_scales") {
        errors.push_back({"correlation/of/0/1/length_um", 1});
        errors.push_back({"correlation/of/1/1/length_um", 2});
        // the other weight is held: the share changes by so much less
        errors.push_back({"correlation/of/0/0", 3, 1 / (1 - fit.scales.front().weight)});
    } else {
        add_length("correlation_length_um", 1);
    }
    return errors;
}

/// The key "uncertainty" of a material; numbers that ended at a bound have none.
void add_uncertainty(ordered_json& material, const SpectrumFit& fit, const Ellipse& ellipse) {
    const std::size_t count = fit.scales.size() > 1 ? 4 : fit.model == "k_correlation" ? 5 : 2;
    const auto covariance = [&](const ErrorOf& a, const ErrorOf& b) {
        return a.factor * b.factor * fit.covariances[a.place * count + b.place];
    };
    std::vector<ErrorOf> known;
    ordered_json uncertainty = ordered_json::object(), correlated = ordered_json::array();
    for (const ErrorOf& error : errors_of(fit, ellipse)) {
        const double relative = std::sqrt(covariance(error, error));
        if (error.at_bound(fit)) continue;
        uncertainty[error.key] =
            relative * material.at(ordered_json::json_pointer{"/" + error.key}).get<double>();
        for (const ErrorOf& other : known) {
            const double r = covariance(error, other) / (relative * std::sqrt(covariance(other, other)));
            correlated.push_back({other.key, error.key, std::clamp(r, -1.0, 1.0)});
        }
        known.push_back(error);
    }
    uncertainty["correlated"] = correlated;
    material["uncertainty"] = uncertainty;
}

/// The spectrum of the fit's noise, which the measured one has in it.
double noise_power(const SurfaceStudy& study, const SpectrumFit& fit) {
    const HeightMap& map = study.maps.front().levelled.map;
    const double rms = fit.value("noise_rms_um").value;
    return rms * rms * map.step_x() * map.step_y();
}

double noise_power_error(const SurfaceStudy& study, const SpectrumFit& fit) {
    const HeightMap& map = study.maps.front().levelled.map;
    const FittedValue& rms = fit.value("noise_rms_um");
    return rms.error * (2 * rms.value + rms.error) * map.step_x() * map.step_y();
}

/// Rings that a measured spectrum keeps.
std::vector<RadialBin> trusted(const SurfaceStudy& study, const SpectrumFit& fit) {
    std::vector<RadialBin> result;
    const double noise = noise_power(study, fit);
    for (RadialBin ring : study.radial) {
        ring.power -= noise;
        if (ring.cells >= 4 && ring.frequency >= study.known.first && ring.frequency <= study.known.last &&
            ring.power > 0)
            result.push_back(ring);
    }
    if (result.size() < 3) throw Error{"measured spectrum: above the noise in 3 rings at least"};
    return result;
}

}  // namespace

std::string surface_text(const SurfaceStudy& study) {
    const HeightStatistics& s = study.statistics;
    const SpectrumFit& chosen = best(study.fits);
    std::string text;
    for (const StudiedMap& map : study.maps) text += map_text(map);
    const Levelling& how = study.request.levelling;
    text += line("treatment", std::string{name(how.level)} + " taken off, gaps " +
                                  (how.gaps == Gaps::mask ? "masked" : "filled") + ", window " +
                                  std::string{name(study.request.window)});
    text += line("known periods", periods(study.known) + "; all else is extrapolated");
    text += line("rms", brief(s.rms) + " um of the heights, " + brief(study.rms_of_spectra()) +
                            " um of the 2-D spectrum, " +
                            with_error(chosen.free_rms.value, chosen.free_rms.error) +
                            " um of the fitted spectrum, its amplitude left free");
    text += line("slopes", brief(s.slope_x, 3) + " along x, " + brief(s.slope_y, 3) +
                               " along y, rms between neighbours");
    text += line("skewness", with_error(s.skewness, s.skewness_error));
    text += line("kurtosis", with_error(s.kurtosis, s.kurtosis_error) + "; 3 of a Gaussian");
    text +=
        line("heights", s.gaussian() ? "Gaussian, as far as skewness and kurtosis tell"
                                     : "not Gaussian: skewness or kurtosis off by more than three errors");
    const double through = study.autocorrelation.gaussian_length_at(1);
    text += line("autocorrelation",
                 "1/e at " + brief(study.autocorrelation.length()) + " um" +
                     (through > 0 ? "; the Gaussian through its value at 1 um has a length of " +
                                        brief(through) + " um"
                                  : ""));
    const Anisotropy& a = study.anisotropy;
    text += line("directions",
                 a.significant
                     ? with_error(a.ellipse.ratio, a.ratio_error) + " times as long at " +
                           with_error(a.ellipse.azimuth * degrees, a.azimuth_error * degrees) +
                           " deg from x as across"
                     : with_error(a.ellipse.ratio, a.ratio_error) + " times as long in one as across: alike");
    text.append("\n").append(padded("description", 20)).append(padded("deviance", 10));
    text += "values with standard errors; rms of all periods\n";
    for (const SpectrumFit& fit : study.fits) text += fit_text(fit, chosen);
    return text;
}

std::string surface_json(const SurfaceStudy& study) {
    const Anisotropy& a = study.anisotropy;
    ordered_json maps = ordered_json::array(), fits = ordered_json::array();
    for (const StudiedMap& map : study.maps) maps.push_back(map_json(map));
    for (const SpectrumFit& fit : study.fits) fits.push_back(fit_json(fit));
    const ordered_json result{{"maps", maps},
                              {"level", name(study.request.levelling.level)},
                              {"gaps", name(study.request.levelling.gaps)},
                              {"window", name(study.request.window)},
                              {"known_periods_um", band_json(study.known)},
                              {"heights", statistics_json(study.statistics)},
                              {"rms_of_spectra_um", study.rms_of_spectra()},
                              {"autocorrelation_length_um", study.autocorrelation.length()},
                              {"anisotropy",
                               {{"ratio", a.ellipse.ratio},
                                {"ratio_error", a.ratio_error},
                                {"azimuth_deg", a.ellipse.azimuth * degrees},
                                {"azimuth_error_deg", a.azimuth_error * degrees},
                                {"significant", a.significant}}},
                              {"descriptions", fits},
                              {"best", best(study.fits).model}};
    return result.dump(2) + "\n";
}

const SpectrumFit& fit_named(const SurfaceStudy& study, std::string_view name) {
    if (name == "best") return best(study.fits);
    std::vector<std::string> names{"best"};
    for (const SpectrumFit& fit : study.fits) {
        if (fit.model == name) return fit;
        names.emplace_back(fit.model);
    }
    throw Error{"description " + spectral::in_quotes(name) + ": " +
                spectral::must_be_one_of(std::string{name}, names)};
}

std::string spectrum_file(const SurfaceStudy& study, const SpectrumFit& fit) {
    std::string text = "# radial power spectrum of the heights of";
    for (const StudiedMap& map : study.maps) text.append(" ").append(map.levelled.map.name());
    text.append("\n# less a white noise of ").append(brief(fit.value("noise_rms_um").value));
    text += " um rms; nothing is known outside\nfrequency_per_um,psd_um4,psd_um4_error\n";
    const double noise = noise_power(study, fit), noise_error = noise_power_error(study, fit);
    const double inflation = study.maps.front().inflation;
    for (const RadialBin& ring : trusted(study, fit)) {
        // each independent frequency, of which there are cells/2/inflation, holds an exponentially
        // distributed power
        const double spread = (ring.power + noise) * std::sqrt(2 * inflation / ring.cells);
        text.append(shortest(ring.frequency)).append(",").append(shortest(ring.power)).append(",");
        text.append(shortest(std::hypot(spread, noise_error))).append("\n");
    }
    return text;
}

/// Whether the power of frequency with which the known spectrum ends may be that of all higher frequencies.
static bool continues(const SurfaceStudy& study, const SpectrumFit& fit) {
    std::vector<double> frequency, density;
    for (const RadialBin& ring : trusted(study, fit)) {
        frequency.push_back(ring.frequency);
        density.push_back(ring.power);
    }
    try {
        static_cast<void>(Correlation::of_spectrum(frequency, density, true));
        return true;
    } catch (const Error&) {
        return false;
    }
}

std::string surface_material(const SurfaceStudy& study, const SpectrumFit& fit, const std::string& index,
                             const std::string& spectrum_path) {
    std::string title = study.maps.front().levelled.map.name();
    if (study.maps.size() > 1) title.append(" and ").append(count_of(study.maps.size() - 1, "more map"));
    const bool measured = !spectrum_path.empty();
    title.append(": ").append(measured ? "measured" : fit.title).append(" spectrum, known for periods ");
    const bool extrapolated = !measured || continues(study, fit);
    title.append(periods(study.known)).append(extrapolated ? ", extrapolated beyond" : ", smooth below");
    if (study.ellipse.ratio != 1 && (measured || fit.scales.size() > 1)) {
        throw Error{title +
                    ": the directions of the surface differ, and this description has one length for all; "
                    "must be gaussian, exponential or k_correlation"};
    }
    ordered_json material{{"name", title}, {"model", "he"}};
    if (measured) {
        material["correlation"] = {{"type", "psd"}, {"file", spectrum_path}};
        if (extrapolated) material["correlation"]["outside"] = "power_law";
    } else {
        material["rms_roughness_um"] = fit.rms_of_band.value;
        material["rms_band_um"] = band_json(study.known);
        add_correlation(material, fit, study.ellipse);
    }
    material["index"] = ordered_json::parse(index);
    if (!measured) add_uncertainty(material, fit, study.ellipse);
    return material.dump(2) + "\n";
}

}  // namespace hts::validation
