/// Descriptions of roughness fitted to the spectra of maps, with the errors that the maps leave.
///
/// A fit is by maximum likelihood of the power in rings of frequencies, whose spread is known: each
/// independent frequency holds an exponentially distributed power, and no ring counts as known to better than
/// 5 %. It compares with the power that a surface of the description is expected to show through the window
/// of each map, so that leakage, gaps, the end of the field and points a step apart bias nothing. Heights are
/// taken for samples at points; a white noise of the instrument is fitted beside them. The variance is that
/// of the heights themselves, over the frequencies that levelling has left, and what the fit shows through
/// the windows adds up to it as well.
#pragma once

#include "validation/topography/roughness_model.hpp"
#include "validation/topography/seen_spectrum.hpp"

namespace hts::validation {

/// A value with its standard error.
struct FittedValue {
    std::string name;
    double value, error;
};
/// The error of a value that is known by its logarithm, with a standard deviation: so wide that two of them
/// reach as far as two deviations up. What is measured too low by 20 % has, by its own value, too small ones.
[[nodiscard]] double error_of(double value, double deviation) noexcept;

struct SpectrumFit {
    std::string_view model, title;
    RoughnessScales scales;
    double variance;  ///< of all frequencies, without noise [um^2]
    /// rms_um of all frequencies, the model's own values, noise_rms_um
    std::vector<FittedValue> values;
    /// rms that the description has with its noise where the rings of frequencies alone say how strong it is,
    /// summed over them as the maps show it; the corners beyond the rings as they were measured. All else
    /// here is of the fit that is held to the rms of the heights. The error is that of the difference between
    /// the two: how well the heights' rms is known is not in it.
    FittedValue free_rms;
    FittedValue rms_of_band;  ///< of the fit without noise, between the frequencies that the maps know
    /// Relative covariances of rms_of_band and of the model's own values in their order, row by row: their
    /// deviations are the errors that those state.
    std::vector<double> covariances;
    /// per degree of freedom: 1 at most where the description holds; errors grow with its root
    double deviance;
    double aic;                          ///< Akaike's criterion, of all descriptions on the same data
    std::vector<std::string> at_bounds;  ///< names of values that the data would move further

    [[nodiscard]] const FittedValue& value(std::string_view name) const;
    /// S2 without noise [um^4].
    [[nodiscard]] double power(double f) const { return variance * spectrum(scales, f); }
};

/// Every description, in the order of roughness_models().
///   length   distance where C is about 1/e [um]
[[nodiscard]] std::vector<SpectrumFit> fits_of_spectra(const std::vector<SeenSpectrum>& maps, double length);

/// The one with the least criterion.
[[nodiscard]] const SpectrumFit& best(const std::vector<SpectrumFit>& fits);

/// How unlike the directions of a surface are.
struct Anisotropy {
    Ellipse ellipse;  ///< ratio >= 1
    double ratio_error, azimuth_error;
    bool significant;  ///< told from an isotropic surface: 1 in 1000 by chance
};
/// Of the spectra of maps that lay alike.
[[nodiscard]] Anisotropy anisotropy_of(const std::vector<MapSpectrum>& spectra, double inflation);

}  // namespace hts::validation
