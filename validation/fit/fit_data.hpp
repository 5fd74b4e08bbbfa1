/// What a fit is made to: measured values, and how a reflectance would have been seen by who measured them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"
#include "spectral/models/material.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::validation {

/// A value measured at one pair of directions and one wavelength.
struct FitSample {
    DirectionPair pair;
    std::size_t wavelength;  ///< place in the grid of the data
    double value;            ///< BRDF [1/sr]
    double uncertainty;      ///< one standard deviation [1/sr]; 0 where it is not known
};

/// What the instrument would have shown of a surface, a value per datum. Called from several threads at once.
using InstrumentView = std::function<std::vector<double>(const spectral::Material& reflector)>;

struct FitData {
    std::string name;
    spectral::WavelengthGrid wavelengths;  ///< at which `view` asks
    std::vector<std::size_t> channels;     ///< of each wavelength, from 0: those of one band belong together
    std::vector<double> values;
    std::vector<double> uncertainties;  ///< as many, or none where they are not known
    std::vector<double> cosines;        ///< cos theta_i of each datum
    InstrumentView view;
    /// Whether `view` is an affine function of the BRDF; not so where curves are divided by their own value.
    bool affine = true;
};

/// Plain samples; each wavelength is a channel of its own.
/// hts::Error "NAME: sample 3: …" for values that are negative or no numbers, uncertainties that only some have, wavelengths
/// that are not in the grid.
[[nodiscard]] FitData fit_data(std::string name, spectral::WavelengthGrid wavelengths,
                               std::vector<FitSample> samples);

/// The data if they hold together, else hts::Error as above.
[[nodiscard]] FitData checked(FitData data);

}  // namespace hts::validation
