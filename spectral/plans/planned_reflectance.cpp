#include "spectral/plans/planned_reflectance.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t block = 64;  // pairs whose node values are held at a time

void require_size(const char* call, std::size_t size, const char* rule, std::size_t expected) {
    if (size == expected) return;
    throw out_of_range(std::string{call}.append(": number of results"), static_cast<double>(size), "",
                       std::string{rule}.append(" = ") + std::to_string(expected));
}

std::vector<Xyz> node_weights(const Scene& scene, const SpectrumInterpolation& interpolation) {
    if (!scene.illuminant) return {};
    return interpolation.folded(
        tristimulus_weights(scene.wavelengths.micrometres(), *scene.illuminant).weights());
}

}  // namespace

PlannedReflectance::PlannedReflectance(const Scene& scene, const AnyReflector& material, const Rung& rung)
    : PlannedReflectance{MaterialForms{scene, material}.at(rung)} {}

PlannedReflectance::PlannedReflectance(const Scene& scene, Rung rung,
                                       std::shared_ptr<const SpectralBrdf> at_nodes)
    : rung_{std::move(rung)},
      wavelengths_{scene.wavelengths},
      polarised_{scene.polarised},
      nodes_{std::move(at_nodes)},
      interpolation_{rung_.wavelengths, scene.wavelengths},
      weights_{node_weights(scene, interpolation_)} {
    if (!std::ranges::equal(nodes_->wavelengths().micrometres(), rung_.wavelengths.micrometres()))
        throw Error{name() + ": wavelengths of what is evaluated: must be the rung's"};
    if (polarised_ && !nodes_->polarised())
        throw Error{name() + ": must be of model he: the scene is polarised"};
    if (interpolation_.is_identity()) return;
    if (polarised_) throw Error{name() + ": wavelengths must be the scene's, which is polarised"};
    if (nodes() > most_nodes) {
        throw out_of_range("number of wavelengths", static_cast<double>(nodes()), "",
                           "<= " + std::to_string(most_nodes) + ", or all the scene's");
    }
}

std::size_t PlannedReflectance::bytes() const noexcept {
    const std::size_t grids = (rung_.wavelengths.size() + size()) * sizeof(double);
    return sizeof *this + nodes_->bytes() + grids + interpolation_.bytes() + weights_.size() * sizeof(Xyz);
}

std::vector<double> PlannedReflectance::brdf(const DirectionPair& pair) const {
    std::vector<double> result(size());
    brdf(pair, result);
    return result;
}

void PlannedReflectance::brdf(const DirectionPair& pair, std::span<double> result) const {
    require_size("brdf", result.size(), "wavelengths", size());
    brdf_block(std::span{&pair, 1}, result);
}

void PlannedReflectance::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    require_size("brdf", result.size(), "pairs x wavelengths", pairs.size() * size());
    const auto blocks = static_cast<std::ptrdiff_t>((pairs.size() + block - 1) / block);
#pragma omp parallel for schedule(dynamic, 4) if (blocks > 1)
    for (std::ptrdiff_t j = 0; j < blocks; ++j) {
        const std::size_t first = static_cast<std::size_t>(j) * block;
        const std::size_t count = std::min(block, pairs.size() - first);
        brdf_block(pairs.subspan(first, count), result.subspan(first * size(), count * size()));
    }
}

void PlannedReflectance::brdf_block(std::span<const DirectionPair> pairs,
                                    std::span<double> result) const noexcept {
    if (interpolation_.is_identity()) return nodes_->brdf_batch(pairs, result);
    std::array<double, block * most_nodes> values;  // NOLINT(*-member-init): written before it is read
    nodes_->brdf_batch(pairs, std::span{values}.first(pairs.size() * nodes()));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        interpolation_(std::span{values}.subspan(i * nodes(), nodes()), result.subspan(i * size(), size()));
    }
}

std::vector<SpecularReflectance> PlannedReflectance::specular_reflectance(const Direction& in) const {
    std::vector<double> values(size());
    specular_reflectance(in, values);
    return {values.begin(), values.end()};
}

void PlannedReflectance::specular_reflectance(const Direction& in, std::span<double> result) const {
    require_size("specular_reflectance", result.size(), "wavelengths", size());
    if (interpolation_.is_identity()) return specular_at_nodes(in, result);
    std::array<double, most_nodes> values;  // NOLINT(*-member-init): written before it is read
    specular_at_nodes(in, std::span{values}.first(nodes()));
    interpolation_(std::span{values}.first(nodes()), result);
}

std::vector<Mueller> PlannedReflectance::mueller(const DirectionPair& pair) const {
    require_mueller();
    std::vector<Mueller> result(size());
    nodes_->mueller(pair, result);
    return result;
}

std::vector<Mueller> PlannedReflectance::specular_mueller(const Direction& in) const {
    require_mueller();
    std::vector<Mueller> result(size());
    if (rung_.specular) nodes_->specular_mueller(in, result);
    return result;
}

Xyz PlannedReflectance::colour(const DirectionPair& pair, std::span<double> scratch) const {
    require_size("colour", scratch.size(), "wavelengths of the rung", nodes());
    nodes_->brdf(pair, scratch);
    return std::numbers::pi * weighted(scratch);
}

Xyz PlannedReflectance::specular_colour(const Direction& in) const {
    std::vector<double> values(nodes());
    specular_at_nodes(in, values);
    return weighted(values);
}

void PlannedReflectance::require_mueller() const {
    if (!polarised_) throw Error{name() + ": no Mueller matrices: the scene must be polarised"};
}

Xyz PlannedReflectance::weighted(std::span<const double> at_nodes) const {
    if (weights_.empty()) throw Error{name() + ": no colour: the scene's output must be rgb"};
    Xyz sum{0, 0, 0};
    for (std::size_t i = 0; i < at_nodes.size(); ++i) sum = sum + at_nodes[i] * weights_[i];
    return sum;
}

void PlannedReflectance::specular_at_nodes(const Direction& in, std::span<double> result) const {
    if (rung_.specular)
        nodes_->specular_reflectance(in, result);
    else
        std::fill(result.begin(), result.end(), 0.0);
}

MaterialForms::MaterialForms(const Scene& scene, const AnyReflector& material)
    : scene_{scene}, material_{material} {
    if (!scene.compensate_energy) return;
    const Reflector* he = material.he_torrance();
    if (he == nullptr) throw Error{material.name() + ": must be of model he: the scene compensates energy"};
    compensation_ = EnergyCompensation::of(he->surface, scene.wavelengths);
}

PlannedReflectance MaterialForms::at(const Rung& rung) const {
    return {scene_, rung, at_nodes(rung)};
}

std::unique_ptr<SpectralBrdf> MaterialForms::at_nodes(const Rung& rung) const {
    auto model =
        model_brdf(material_, rung.wavelengths, scene_.outside_range, rung.lobe_tolerance, rung.lobe);
    if (!scene_.compensate_energy) return model;
    return compensated_brdf(std::move(model), EnergyCompensation::interpolated(
                                                  compensation_, scene_.wavelengths, rung.wavelengths));
}

PlannedReflectance MaterialForms::full_model(Tolerance tolerance) const {
    return at({DiffuseLobe::full, tolerance, material_.he_torrance() != nullptr, scene_.wavelengths});
}

}  // namespace hts::spectral
