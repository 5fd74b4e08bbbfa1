#include "py_material.hpp"

#include <cmath>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "arrays.hpp"
#include "spectral/text/text.hpp"

namespace hts::python {
namespace {

using spectral::Reflectance;
using spectral::WavelengthGrid;

constexpr std::size_t most_kept = 256;

/// Whether a number of a key is not one: as a key it would be equal to every other.
template <class Key>
bool has_nan(const Key& key) {
    const auto is_nan = [](const auto& part) {
        if constexpr (std::is_same_v<std::decay_t<decltype(part)>, std::optional<double>>)
            return part && std::isnan(*part);
        else
            return false;
    };
    return std::isnan(std::get<0>(key)) ||
           std::apply([&](const auto&... parts) { return (is_nan(parts) || ...); }, key);
}

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

Reflectance PyMaterial::at(double wavelength, const How& how, const spectral::RoughSurfaceValues& own) const {
    const Key which = key(wavelength, how, own);
    const bool whole = !has_nan(which);
    if (whole) {
        const std::lock_guard lock{kept_->mutex};
        if (const auto found = kept_->reflectances.find(which); found != kept_->reflectances.end())
            return found->second;
    }
    const Reflectance made = at(WavelengthGrid::from_micrometres({wavelength}), how, own);
    if (!whole) return made;
    const std::lock_guard lock{kept_->mutex};
    if (kept_->reflectances.size() >= most_kept) kept_->reflectances.clear();
    return kept_->reflectances.emplace(which, made).first->second;
}

spectral::Sampler PyMaterial::sampler(double wavelength, const How& how) const {
    const auto checked = Wavelength::from_micrometres(wavelength);
    const Key which = key(checked.micrometres(), how, {});
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
