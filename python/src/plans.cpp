// Material.plan: the cheapest form of a material that is exact enough, as measured.
#include "evaluation.hpp"
#include "module.hpp"

#include <nanobind/stl/vector.h>

#include "hts/terms.hpp"
#include "spectral/plans/plan.hpp"

namespace hts::python {
namespace {

nb::dict as_dict(const spectral::MeasuredRung& measured) {
    const spectral::Rung& rung = measured.rung;
    nb::dict result;
    result["lobe"] = name(rung.lobe);
    result["lobe_tolerance"] = rung.lobe_tolerance.relative_error();
    result["specular"] = rung.specular;
    result["wavelengths"] = array_of(rung.wavelengths.micrometres());
    result["worst"] = measured.error.worst;
    result["percentile_99"] = measured.error.percentile_99;
    return result;
}

/// What was chosen, what was rejected, and the material as the plan evaluates it.
///   scene   as a scene file has it, without materials, at the wavelengths
nb::dict plan(const PyMaterial& self, const std::string& scene, const std::vector<double>& wavelengths,
              std::size_t pairs, std::uint64_t seed) {
    const auto grid = spectral::WavelengthGrid::from_micrometres(wavelengths);
    const auto asked = spectral::scene_from_text(scene, "plan", self.sampled(grid).material());
    std::optional<spectral::Plan> made;
    {
        const nb::gil_scoped_release others_may_run;
        made = spectral::make_plan(asked, {seed, pairs}, asked.tolerance);
    }
    const spectral::PlannedMaterial& planned = made->materials.front();
    nb::dict result = as_dict(planned.choice);
    nb::list rejected;
    for (const auto& rung : planned.rejected) rejected.append(as_dict(rung));
    result["rejected"] = rejected;
    result["nbytes"] = planned.form.bytes();
    result["material"] = material_of_reflectance(planned.form.reflectance(), {}, "plan", "a plan of hts");
    return result;
}

}  // namespace

void bind_plans(nb::module_& module) {
    module.def(
        "_plan", &plan, nb::arg("material"), nb::arg("scene"), nb::arg("wavelengths"), nb::arg("pairs"),
        nb::arg("seed"),
        nb::sig("def _plan(material: Material, scene: str, wavelengths: list[float], pairs: int, seed: "
                "int) -> dict[str, typing.Any]"));
}

}  // namespace hts::python
