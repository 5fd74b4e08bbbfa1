/// What a tolerance of the distance from exact scattering leaves for arithmetic. Not installed.
#pragma once

#include "spectral/plans/scene.hpp"

namespace hts::spectral {

/// A scene's "true_db": the distance [dB] of a value from exact scattering, of the model and of the
/// arithmetic together. The model's is the greatest that is expected (spectral/energy/expected_distance.hpp)
/// over materials, wavelengths and polar angles of light, in TE and TM where the scene is polarised and in
/// unpolarised light otherwise; arithmetic may add to it the relative error 10^((true_db - model)/10) - 1.
///   returns   that relative error, at most accuracy::coarsest_tolerance
/// hts::Error where a material is not of he or he_unified, has not been studied there, or is expected further
/// off; it names the material, the place and what would do.
[[nodiscard]] double tolerance_beside_model(const Scene& scene, double true_db);

}  // namespace hts::spectral
