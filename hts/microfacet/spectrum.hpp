/// One model at all wavelengths of a spectrum at once: a value of the model for each, whose BRDFs of a pair
/// of directions share what depends on the directions alone.
///
///     const std::vector<WalterBrdf> gold{{ggx, blue_index}, {ggx, green_index}, {ggx, red_index}};
///     std::array<double, 3> f;
///     spectral_brdf<WalterBrdf>(gold, in, out, f);
#pragma once

#include <cstddef>
#include <span>

#include "hts/microfacet/model.hpp"

namespace hts {

/// A model that computes many wavelengths for little more than one. No model needs it: any other is asked for
/// each wavelength alone.
///   shares_geometry   whether two values of the model differ in nothing but what each wavelength may have
///                     for itself, such as reflectivities; roughness may depend on wavelength, but the costs
///                     are then those of each alone
///   brdf              of values that all share their geometry, one or more, the same bits as each alone
template <class Model>
concept GeometrySharingModel = ReflectanceModel<Model> &&
    requires(const Model& model, std::span<const Model> alike, const Direction& in, const Direction& out,
             std::span<double> result) {
    { model.shares_geometry(model) }
    noexcept->std::same_as<bool>;
    { Model::brdf(alike, in, out, result) }
    noexcept;
};

/// The BRDF of each model [1/sr], the same bits as model.brdf(in, out).
///   models   any; neighbours that share their geometry are computed together
///            result models.size() values
template <ReflectanceModel Model>
void spectral_brdf(std::span<const Model> models, const Direction& in, const Direction& out,
                   std::span<double> result) noexcept {
    if constexpr (GeometrySharingModel<Model>) {
        for (std::size_t first = 0, last = 0; first < models.size(); first = last) {
            do ++last;
            while (last < models.size() && models[first].shares_geometry(models[last]));
            Model::brdf(models.subspan(first, last - first), in, out, result.subspan(first, last - first));
        }
    } else {
        for (std::size_t i = 0; i < models.size(); ++i) result[i] = models[i].brdf(in, out);
    }
}

/// The BRDF of one model that computes spectra [1/sr].
template <class Model>
[[nodiscard]] double spectral_brdf(const Model& model, const Direction& in, const Direction& out) noexcept {
    double result = 0;
    Model::brdf(std::span{&model, 1}, in, out, std::span{&result, 1});
    return result;
}

}  // namespace hts
