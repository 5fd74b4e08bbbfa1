// hts._core: what hts/__init__.py gives to Python.
#include "module.hpp"

#include <chrono>
#include <exception>

#include "evaluation.hpp"
#include "hts/correlation/kept_tables.hpp"
#include "hts/error.hpp"
#include "spectral/jobs/progress.hpp"

namespace hts::python {

/// Whether a signal came for whose error Python now waits. Asked on the thread that runs a long job, without
/// Python's lock; seldom looked at in earnest.
static bool interrupted() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds between{50};
    static thread_local Clock::time_point next{};
    static thread_local bool waiting = false;
    if (!waiting && Clock::now() < next) return false;
    next = Clock::now() + between;
    const nanobind::gil_scoped_acquire lock;
    waiting = PyErr_Occurred() != nullptr || PyErr_CheckSignals() != 0;
    return waiting;
}

}  // namespace hts::python

NB_MODULE(_core, module) {
    if (PyInterpreterState_Get() != PyInterpreterState_Main())
        throw nanobind::import_error("hts: must be imported in the main interpreter, not in another");
    nanobind::set_leak_warnings(false);  // a function that is a material's index may refer to that material
    nanobind::exception<hts::Error>(module, "Error", PyExc_ValueError);
    hts::python::bind_material(module);
    hts::python::bind_functions(module);
    hts::python::bind_tables(module);
    hts::python::bind_fits(module);
    hts::python::bind_pictures(module);
    hts::python::bind_plans(module);
    hts::keep_correlation_tables_in(hts::user_cache_folder());
    hts::python::survive_forks();
    hts::spectral::stop_jobs_where(hts::python::interrupted);
    nanobind::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const hts::spectral::Stopped&) {
            // Python's own error, KeyboardInterrupt say, is set
        }
    });
}
