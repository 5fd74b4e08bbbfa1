/// What a fit is made to: measured values, and how a reflectance would have been seen by who measured them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "spectral/materials/piecewise_linear.hpp"
#include "spectral/wavelength_grid.hpp"
#include "validation/curves/prediction.hpp"

namespace hts::validation {

/// A value measured at one pair of directions and one wavelength.
struct FitSample {
    DirectionPair pair;
    std::size_t wavelength;  ///< place in the grid of the data
    double value;            ///< BRDF [1/sr]
    double uncertainty;      ///< one standard deviation [1/sr]; 0 where it is not known
};

struct FitData {
    std::string name;
    spectral::WavelengthGrid wavelengths;  ///< at which the instrument asks
    std::vector<std::size_t> channels;     ///< of each wavelength, from 0: those of one band belong together
    std::vector<double> values;
    std::vector<double> uncertainties;  ///< as many, or none where they are not known
    std::vector<double> cosines;        ///< cos theta_i of each datum
    /// Which curve each datum belongs to, from 0: data of one share an error of the instrument's gain.
    std::vector<std::size_t> curves{};
    /// CurveSet::noise_floor; 0 where values are > 0. What `log_ratio` makes of it is a logarithmic residual.
    double noise_floor = 0;
    /// Of each datum, whether the factor "scale" does not apply: reflectances into all directions are
    /// measured against a reference of their own. Empty: it applies to all.
    std::vector<bool> without_scale{};
    /// Factor on the residual of each datum; empty: 1. Sets of unlike size count alike by it.
    std::vector<double> importance{};
    bool absolute = true;  ///< the values are no multiples of an unknown factor
    /// What it would have shown of a surface, a value per datum.
    std::shared_ptr<const Prediction> instrument{};
    spectral::OutsideRange outside = spectral::OutsideRange::error;  ///< of optical constants
};

/// Plain samples; each wavelength is a channel of its own, and what one incident direction shows at it a
/// curve. hts::Error "NAME: sample 3: …" for values that are negative or no numbers, uncertainties that only
/// some have, wavelengths that are not in the grid.
[[nodiscard]] FitData fit_data(std::string name, spectral::WavelengthGrid wavelengths,
                               const std::vector<FitSample>& samples);

/// The data if they hold together, else hts::Error as above.
[[nodiscard]] FitData checked(FitData data);

}  // namespace hts::validation
