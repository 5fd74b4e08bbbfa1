#include "spectral/planned_reflectance.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t block = 64;  // pairs whose node values are held at a time

std::vector<Xyz> node_weights(const Scene& scene, const SpectrumInterpolation& interpolation) {
    if (!scene.illuminant) return {};
    return interpolation.folded(
        tristimulus_weights(scene.wavelengths.micrometres(), *scene.illuminant).weights());
}

}  // namespace

PlannedReflectance::PlannedReflectance(const Scene& scene, const Reflector& reflector, Rung rung)
    : name_{reflector.name},
      rung_{std::move(rung)},
      wavelengths_{scene.wavelengths},
      polarised_{scene.polarised},
      nodes_{reflector, rung_.wavelengths, scene.outside_range, rung_.lobe_tolerance, rung_.lobe},
      interpolation_{rung_.wavelengths, scene.wavelengths},
      weights_{node_weights(scene, interpolation_)} {
    if (interpolation_.is_identity()) return;
    if (polarised_) throw Error{name_ + ": wavelengths must be the scene's, which is polarised"};
    if (nodes() > most_nodes) {
        throw out_of_range("number of wavelengths", static_cast<double>(nodes()), "",
                           "<= " + std::to_string(most_nodes) + ", or all the scene's");
    }
}

std::size_t PlannedReflectance::bytes() const noexcept {
    const std::size_t grids = (rung_.wavelengths.size() + size()) * sizeof(double);
    return sizeof *this - sizeof nodes_ + nodes_.bytes() + grids + interpolation_.bytes() +
           weights_.size() * sizeof(Xyz);
}

std::vector<double> PlannedReflectance::brdf(const DirectionPair& pair) const {
    std::vector<double> result(size());
    brdf(pair, result);
    return result;
}

void PlannedReflectance::brdf(const DirectionPair& pair, std::span<double> result) const {
    brdf(std::span{&pair, 1}, result);
}

void PlannedReflectance::brdf(std::span<const DirectionPair> pairs, std::span<double> result) const {
    if (interpolation_.is_identity()) return nodes_.brdf(pairs, result);
    if (result.size() != pairs.size() * size()) {
        throw out_of_range("brdf: number of results", static_cast<double>(result.size()), "",
                           "pairs x wavelengths = " + std::to_string(pairs.size() * size()));
    }
    const auto blocks = static_cast<std::ptrdiff_t>((pairs.size() + block - 1) / block);
#pragma omp parallel for schedule(dynamic, 4) if (blocks > 1)
    for (std::ptrdiff_t j = 0; j < blocks; ++j) {
        std::array<double, block * most_nodes> values;  // NOLINT(*-member-init): written before it is read
        const std::size_t first = static_cast<std::size_t>(j) * block;
        const std::size_t count = std::min(block, pairs.size() - first);
        nodes_.prepared().brdf(pairs.subspan(first, count), std::span{values}.first(count * nodes()));
        for (std::size_t i = 0; i < count; ++i) {
            interpolation_(std::span{values}.subspan(i * nodes(), nodes()),
                           result.subspan((first + i) * size(), size()));
        }
    }
}

std::vector<SpecularReflectance> PlannedReflectance::specular_reflectance(const Direction& in) const {
    std::vector<double> spectrum = specular_at_nodes(in);
    if (!interpolation_.is_identity()) {
        const std::vector<double> at_nodes = std::exchange(spectrum, std::vector<double>(size()));
        interpolation_(at_nodes, spectrum);
    }
    std::vector<SpecularReflectance> result;
    result.reserve(spectrum.size());
    for (const double value : spectrum) result.emplace_back(value);
    return result;
}

std::vector<Mueller> PlannedReflectance::mueller(const DirectionPair& pair) const {
    require_mueller();
    return nodes_.mueller(pair);
}

std::vector<Mueller> PlannedReflectance::specular_mueller(const Direction& in) const {
    require_mueller();
    if (rung_.specular) return nodes_.specular_mueller(in);
    std::vector<Mueller> dropped(size());
    return dropped;
}

Xyz PlannedReflectance::colour(const DirectionPair& pair, std::span<double> scratch) const {
    nodes_.brdf(pair, scratch);
    return std::numbers::pi * weighted(scratch);
}

Xyz PlannedReflectance::specular_colour(const Direction& in) const {
    return weighted(specular_at_nodes(in));
}

void PlannedReflectance::require_mueller() const {
    if (!polarised_) throw Error{name_ + ": no Mueller matrices: the scene must be polarised"};
}

Xyz PlannedReflectance::weighted(std::span<const double> at_nodes) const {
    if (weights_.empty()) throw Error{name_ + ": no colour: the scene's output must be rgb"};
    Xyz sum{0, 0, 0};
    for (std::size_t i = 0; i < at_nodes.size(); ++i) sum = sum + at_nodes[i] * weights_[i];
    return sum;
}

std::vector<double> PlannedReflectance::specular_at_nodes(const Direction& in) const {
    std::vector<double> result;
    if (!rung_.specular) result.resize(nodes());
    if (rung_.specular) {
        for (const SpecularReflectance& value : nodes_.specular_reflectance(in))
            result.push_back(value.value());
    }
    return result;
}

}  // namespace hts::spectral
