#include "py_material.hpp"

#include <utility>

#include "arrays.hpp"
#include "spectral/text/text.hpp"

namespace hts::python {
namespace {

using spectral::Reflectance;
using spectral::WavelengthGrid;

constexpr std::size_t most_kept = 256;

/// A material of the same description whose optical constants are what a Python function
/// says at these wavelengths.
spectral::Material with_index(const std::string& description, const nb::object& index,
                              const WavelengthGrid& grid) {
    const nb::gil_scoped_acquire python;
    const auto helper = nb::module_::import_("hts._description");
    const auto text = nb::cast<std::string>(
        helper.attr("with_sampled_index")(description, index, array_of(grid.micrometres())));
    return spectral::material_from_text(text, "index of a function");
}

}  // namespace

How how_from(double tolerance, const std::string& outside, bool compensate_energy) {
    return {Tolerance{tolerance}.relative_error(),
            spectral::located("outside", [&] { return spectral::outside_range_named(outside); }),
            compensate_energy};
}

PyMaterial::PyMaterial(spectral::Material material, std::string description, nb::object index)
    : material_{std::move(material)},
      description_{std::move(description)},
      index_{std::move(index)},
      kept_{std::make_shared<Kept>()} {}

Reflectance PyMaterial::at(const WavelengthGrid& grid, const How& how,
                           const spectral::RoughSurfaceValues& own) const {
    const spectral::EvaluationOptions options{.tolerance = Tolerance{how.tolerance},
                                              .outside = how.outside,
                                              .compensate_energy = how.compensate_energy,
                                              .instead = own};
    if (index_.is_valid()) return with_index(description_, index_, grid).at(grid, options);
    return material_.at(grid, options);
}

PyMaterial::Key PyMaterial::key(double wavelength, const How& how, const spectral::RoughSurfaceValues& own) {
    return {wavelength, how, own.n, own.k, own.rms_roughness, own.correlation_length, own.diffuse_albedo};
}

Reflectance PyMaterial::at(double wavelength, const How& how, const spectral::RoughSurfaceValues& own) const {
    const Key which = key(wavelength, how, own);
    {
        const std::lock_guard lock{kept_->mutex};
        if (const auto found = kept_->reflectances.find(which); found != kept_->reflectances.end())
            return found->second;
    }
    const Reflectance made = at(WavelengthGrid::from_micrometres({wavelength}), how, own);
    const std::lock_guard lock{kept_->mutex};
    if (kept_->reflectances.size() >= most_kept) kept_->reflectances.clear();
    return kept_->reflectances.emplace(which, made).first->second;
}

spectral::Sampler PyMaterial::sampler(double wavelength, const How& how) const {
    const Key which = key(wavelength, how, {});
    {
        const std::lock_guard lock{kept_->mutex};
        if (const auto found = kept_->samplers.find(which); found != kept_->samplers.end())
            return found->second;
    }
    const spectral::Sampler made = at(wavelength, how).sampler(0);
    const std::lock_guard lock{kept_->mutex};
    if (kept_->samplers.size() >= most_kept) kept_->samplers.clear();
    return kept_->samplers.emplace(which, made).first->second;
}

}  // namespace hts::python
