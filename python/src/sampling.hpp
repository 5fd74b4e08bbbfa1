/// Directions drawn as a material reflects.
#pragma once

#include "py_material.hpp"

namespace hts::python {

void bind_sampling(nb::module_& module, nb::class_<PyMaterial>& material);

}  // namespace hts::python
