/// The model of He, Torrance, Sillion and Greenberg at one wavelength as a value: evaluated, and drawn from
/// as lobe_sampler.hpp says.
#pragma once

#include "hts/rough_surface_model.hpp"

namespace hts {

/// The published model, unpolarised and polarised, with its sampler.
using HeTorrance = RoughSurfaceModel<HeTorranceSpectrum>;

static_assert(ReflectanceModel<HeTorrance>);

}  // namespace hts
