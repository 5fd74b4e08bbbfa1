/// What can be asked of a material.
#pragma once

#include <cstddef>
#include <string>

#include "evaluation.hpp"

namespace hts::python::quantity {

extern const Quantity brdf, directional_diffuse, specular_reflectance, albedo, pdf;
extern const Quantity mueller;          ///< of the directional-diffuse term
extern const Quantity diffuse_mueller;  ///< of all diffuse terms
extern const Quantity specular_mueller;

/// The albedo of light polarised along s, or along p.
extern const Quantity s_albedo, p_albedo;

/// Severity 0 … 2, then the least and the most error [dB], NaN where unknown.
extern const Quantity validity;

/// Derivatives of model he by all eleven parameters, one after the other, then by n, k and thickness of each
/// film.
///   of      "brdf", "mueller" or "specular"
///   films   of the material
[[nodiscard]] Quantity derivatives(const std::string& of, std::size_t films);

}  // namespace hts::python::quantity
