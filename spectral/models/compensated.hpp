/// A reflectance with its energy compensated, as spectral/energy/compensation.hpp says.
#pragma once

#include <vector>

#include "spectral/energy/compensation.hpp"
#include "spectral/models/reflectance.hpp"

namespace hts::spectral {

/// The factors of the compensation beside what `model` evaluates; Mueller matrices are
/// scaled like their element 00.
///   model          of a rough surface, else hts::Error
///   compensation   solved for its surface, one per wavelength of `model`, else hts::Error
[[nodiscard]] Reflectance compensated(const Reflectance& model, std::vector<EnergyCompensation> compensation);

}  // namespace hts::spectral
