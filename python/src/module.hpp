/// The parts of the extension module.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

/// The signature of a function whose result is looked at by the package alone.
#define HTS_ANY(call) nb::sig("def " call " -> typing.Any")

namespace hts::python {

namespace nb = nanobind;

void bind_material(nb::module_& module);
void bind_functions(nb::module_& module);
void bind_fits(nb::module_& module);
void bind_pictures(nb::module_& module);
void bind_plans(nb::module_& module);
void bind_tables(nb::module_& module);

}  // namespace hts::python
