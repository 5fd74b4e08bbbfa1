/// What a sampler is fitted to: the terms of one rough surface at one wavelength, whatever the model.
#pragma once

#include <functional>

#include "hts/he_torrance_spectrum.hpp"

namespace hts {

struct ScatteringLobe {
    double wave_number;  ///< [1/um]
    Surface surface;
    double diffuse_albedo;                                  ///< of the uniform diffuse term
    std::function<double(const DirectionPair& pair)> brdf;  ///< of the directional-diffuse term [1/sr]
    std::function<double(const Direction& in)> mirror;      ///< reflectance of the specular term
    std::function<double(const Direction& in)>
        effective_roughness;  ///< of what is lit and seen along `in` [um]
};

}  // namespace hts
