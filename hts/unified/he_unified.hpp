/// The successor of He-Torrance at one wavelength as a value: evaluated, and drawn from
/// as lobe_sampler.hpp says.
#pragma once

#include "hts/rough_surface_model.hpp"
#include "hts/unified/he_unified_spectrum.hpp"

namespace hts {

/// he_unified, unpolarised and polarised, with its sampler.
///
///     const hts::HeUnified model{surface, {wavelength, index, uniform_diffuse}};
using HeUnified = RoughSurfaceModel<HeUnifiedSpectrum>;

static_assert(ReflectanceModel<HeUnified>);

}  // namespace hts
