/// The colour of a spectrum's two parts, as text and as JSON.
#pragma once

#include <string>

#include "spectral/colour/colour.hpp"

namespace hts::cli {

struct SpectrumColour {
    spectral::Xyz diffuse;   ///< of the radiance factor pi f of both diffuse terms
    spectral::Xyz specular;  ///< of the specular reflectance
    spectral::Illuminant illuminant;

    /// A line per part.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::string json() const;
};

}  // namespace hts::cli
