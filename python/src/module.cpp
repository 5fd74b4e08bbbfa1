// hts._core: what hts/__init__.py gives to Python.
#include "module.hpp"

#include "hts/error.hpp"

NB_MODULE(_core, module) {
    nanobind::set_leak_warnings(false);  // a function that is a material's index may refer to that material
    nanobind::exception<hts::Error>(module, "Error", PyExc_ValueError);
    hts::python::bind_material(module);
    hts::python::bind_functions(module);
    hts::python::bind_tables(module);
    hts::python::bind_fits(module);
    hts::python::bind_pictures(module);
}
