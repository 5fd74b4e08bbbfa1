#include "py_material.hpp"

#include <utility>

#include "arrays.hpp"
#include "spectral/text/text.hpp"

namespace hts::python {
namespace {

using spectral::Reflectance;
using spectral::WavelengthGrid;

constexpr std::size_t most_kept = 256;

}  // namespace

How how_from(double tolerance, const std::string& outside, bool compensate_energy) {
    return {Tolerance{tolerance}.relative_error(),
            spectral::located("outside", [&] { return spectral::outside_range_named(outside); }),
            compensate_energy};
}

PyMaterial::PyMaterial(spectral::Material material, std::string description, nb::object index,
                       std::string folder)
    : material_{std::move(material)},
      description_{std::move(description)},
      index_{std::move(index)},
      folder_{std::move(folder)},
      kept_{std::make_shared<Kept>()} {}

PyMaterial PyMaterial::sampled(const WavelengthGrid& grid) const {
    const nb::gil_scoped_acquire python;
    if (!index_.is_valid()) return *this;
    const auto helper = nb::module_::import_("hts._description");
    auto text = nb::cast<std::string>(
        helper.attr("with_sampled_index")(description_, index_, array_of(grid.micrometres())));
    return PyMaterial{
        spectral::material_from_text(text, "index of a function"), std::move(text), {}, folder_};
}

Reflectance PyMaterial::at(const WavelengthGrid& grid, const How& how,
                           const spectral::RoughSurfaceValues& own) const {
    const spectral::EvaluationOptions options{.tolerance = Tolerance{how.tolerance},
                                              .outside = how.outside,
                                              .compensate_energy = how.compensate_energy,
                                              .instead = own};
    if (index_.is_valid()) return sampled(grid).material().at(grid, options);
    return material_.at(grid, options);
}

PyMaterial::Key PyMaterial::key(double wavelength, const How& how, const spectral::RoughSurfaceValues& own) {
    return {wavelength, how, own.n, own.k, own.rms_roughness, own.correlation_length, own.diffuse_albedo};
}

template <class Made, class Make>
Made PyMaterial::kept(std::map<Key, Made> Kept::*of, const Key& which, const Make& make) const {
    // with a NaN, which as a key would be any other, and which make refuses
    if (!(which == which)) return make();
    std::map<Key, Made>& all = (*kept_).*of;
    {
        const std::lock_guard lock{kept_->mutex};
        if (const auto found = all.find(which); found != all.end()) return found->second;
    }
    const Made made = make();
    const std::lock_guard lock{kept_->mutex};
    if (all.size() >= most_kept) all.clear();
    return all.emplace(which, made).first->second;
}

Reflectance PyMaterial::at(double wavelength, const How& how, const spectral::RoughSurfaceValues& own) const {
    return kept(&Kept::reflectances, key(wavelength, how, own),
                [&] { return at(WavelengthGrid::from_micrometres({wavelength}), how, own); });
}

spectral::Sampler PyMaterial::sampler(double wavelength, const How& how) const {
    return kept(&Kept::samplers, key(wavelength, how, {}), [&] { return at(wavelength, how).sampler(0); });
}

}  // namespace hts::python
