#include "sampling.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <nanobind/stl/vector.h>

#include "evaluation.hpp"
#include "module.hpp"
#include "pairs.hpp"

namespace hts::python {
namespace {

/// (theta_r, phi_r, pdf, weight, lobe code) of `uniforms`, an array (…, 3), light
/// broadcast with its leading axes.
nb::tuple sample(const PyMaterial& self, double wavelength, nb::handle theta_i, nb::handle phi_i,
                 nb::handle uniforms, bool degrees, double tolerance, const std::string& outside) {
    const Operand polar{"theta_i", theta_i}, azimuth{"phi_i", phi_i}, drawn{"uniforms", uniforms, 3};
    const Operand* const all[]{&polar, &azimuth, &drawn};
    const Broadcast broadcast{all};
    const auto sampler = self.sampler(wavelength, how_from(tolerance, outside, false));
    Result theta{broadcast.shape(), nb::none(), {}}, phi{broadcast.shape(), nb::none(), {}},
        density{broadcast.shape(), nb::none(), {}}, weight{broadcast.shape(), nb::none(), {}},
        lobe{broadcast.shape(), nb::none(), {}};
    const Walk walk{broadcast.shape(), std::vector<bool>(broadcast.shape().size(), true)};
    const Shape polar_steps = broadcast.steps(polar), azimuth_steps = broadcast.steps(azimuth),
                drawn_steps = broadcast.steps(drawn);
    const double unit = degrees ? 180 / std::numbers::pi : 1;
    {
        const nb::gil_scoped_release others_may_run;
        for (std::size_t i = 0; i < walk.size(); ++i) {
            const Direction in = of_element(broadcast.shape(), i, [&] {
                return direction(polar.data()[walk.offset(i, polar_steps)],
                                 azimuth.data()[walk.offset(i, azimuth_steps)], degrees);
            });
            const double* u = drawn.data() + walk.offset(i, drawn_steps);
            const std::ptrdiff_t step = drawn.component_stride();
            const Draw draw = sampler.sample(in, {u[0], u[step], u[2 * step]});
            theta.data()[i] = std::atan2(draw.out.sin_theta(), draw.out.cos_theta()) * unit;
            phi.data()[i] = std::atan2(draw.out.sin_phi(), draw.out.cos_phi()) * unit;
            density.data()[i] = draw.pdf;
            weight.data()[i] = draw.weight;
            lobe.data()[i] = static_cast<double>(static_cast<int>(draw.lobe));
        }
    }
    return nb::make_tuple(theta.finish(), phi.finish(), density.finish(), weight.finish(), lobe.finish());
}

std::vector<std::string> lobe_names() {
    return {name(Lobe::none), name(Lobe::specular), name(Lobe::directional_diffuse),
            name(Lobe::uniform_diffuse)};
}

}  // namespace

void bind_sampling(nb::module_& module, nb::class_<PyMaterial>& material) {
    module.def("_lobe_names", &lobe_names);
    material.def("_sample", &sample,
                 HTS_ANY("_sample(self, wavelength: float, theta_i: typing.Any, phi_i: typing.Any, uniforms: "
                         "typing.Any, degrees: bool, tolerance: float, outside: str)"),
                 nb::arg("wavelength"), nb::arg("theta_i"), nb::arg("phi_i"), nb::arg("uniforms"),
                 nb::arg("degrees"), nb::arg("tolerance"), nb::arg("outside"));
}

}  // namespace hts::python
