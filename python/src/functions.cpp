// Functions that need no material, and readers of any file.
#include "evaluation.hpp"
#include "module.hpp"

#include <cmath>
#include <complex>

#include <nanobind/stl/complex.h>
#include <nanobind/stl/vector.h>

#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/model_readers.hpp"

namespace hts::python {
namespace {

/// f of each pair of elements of two arrays.
template <class Function>
nb::object of_two(nb::handle a, const char* a_name, nb::handle b, const char* b_name, nb::object out,
                  const Function& f) {
    const Operand first{a_name, a}, second{b_name, b};
    const Operand* const all[]{&first, &second};
    const Broadcast broadcast{all};
    Result result{broadcast.shape(), std::move(out), all};
    const Shape first_steps = broadcast.steps(first), second_steps = broadcast.steps(second);
    const Walk walk{broadcast.shape(), std::vector<bool>(broadcast.shape().size(), true)};
    {
        const nb::gil_scoped_release others_may_run;
        for (std::size_t i = 0; i < walk.size(); ++i) {
            const double x = first.data()[walk.offset(i, first_steps)],
                         y = second.data()[walk.offset(i, second_steps)];
            result.data()[walk.offset(i, result.strides())] = f(x, y);
        }
    }
    return result.finish();
}

void require_arguments(double g, double t) {
    if (!(g >= 0 && g <= 1e300)) throw out_of_range("g", g, "", "0 ... 1e300");
    if (!(t >= 0)) throw out_of_range("t", t, "", ">= 0");
}

nb::object phi_of(nb::handle g, nb::handle t, double tolerance, nb::object out) {
    const Tolerance accepted{tolerance};
    return of_two(g, "g", t, "t", std::move(out), [&](double x, double y) {
        require_arguments(x, y);
        return phi(x, y, accepted);
    });
}

nb::object log_phi_of(nb::handle g, nb::handle t, nb::object out) {
    return of_two(g, "g", t, "t", std::move(out), [](double x, double y) {
        require_arguments(x, y);
        return phi(x, y).log;
    });
}

/// n + ik of built-in optical constants or of a file.
nb::object refractive_index(const std::string& substance, bool is_file, nb::handle wavelength) {
    const auto constants = is_file ? spectral::read_optical_constants(substance)
                                   : spectral::built_in_optical_constants(substance);
    const Operand at{"wavelength", wavelength};
    const Operand* const all[]{&at};
    const Broadcast broadcast{all};
    Result n{broadcast.shape(), nb::none(), {}}, k{broadcast.shape(), nb::none(), {}};
    const Walk walk{broadcast.shape(), std::vector<bool>(broadcast.shape().size(), true)};
    const Shape steps = broadcast.steps(at);
    for (std::size_t i = 0; i < walk.size(); ++i) {
        const auto index = constants.index(Wavelength::from_micrometres(at.data()[walk.offset(i, steps)]));
        n.data()[i] = index.n();
        k.data()[i] = index.k();
    }
    const nb::object imaginary = nb::cast(std::complex<double>{0, 1});
    return n.finish() + k.finish() * imaginary;
}

nb::list models() {
    nb::list names;
    for (const auto& entry : spectral::built_in_models())
        names.append(nb::make_tuple(entry.name, entry.source));
    return names;
}

}  // namespace

void bind_functions(nb::module_& module) {
    module.def(
        "phi", &phi_of,
        nb::sig("def phi(g: numpy.typing.ArrayLike, t: numpy.typing.ArrayLike, tolerance: float = 1e-12, "
                "out: numpy.ndarray | None = None) -> typing.Any"),
        "Phi(g, t) = exp(-g) sum g^m/(m! m) exp(-t/m) [He91 (78)]; error at most `tolerance`, relative.\n\n"
        "g   phase variance, 0 ... 1e300      t   v_xy^2 tau^2/4, 0 or more; they broadcast",
        nb::arg("g"), nb::arg("t"), nb::arg("tolerance") = accuracy::finest_tolerance,
        nb::arg("out") = nb::none());
    module.def("log_phi", &log_phi_of,
               nb::sig("def log_phi(g: numpy.typing.ArrayLike, t: numpy.typing.ArrayLike, "
                       "out: numpy.ndarray | None = None) -> typing.Any"),
               "ln Phi(g, t), which stays finite where Phi underflows; error 4e-13 of max(|ln Phi|, 1).",
               nb::arg("g"), nb::arg("t"), nb::arg("out") = nb::none());
    module.def("_refractive_index", &refractive_index, nb::arg("substance"), nb::arg("is_file"),
               nb::arg("wavelength"));
    module.def("substances", &spectral::optical_constants_names, "Names of the built-in optical constants.");
    module.def("models", &models, nb::sig("def models() -> list[tuple[str, str]]"),
               "Models that material files may name, each with its source.");
}

}  // namespace hts::python
