#include "spectral/plans/planned_reflectance.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/colour/spectrum_interpolation.hpp"
#include "spectral/models/compensated.hpp"

namespace hts::spectral {
namespace {

constexpr std::size_t block = 64;  // pairs whose node values are held at a time

std::vector<Xyz> node_weights(const Scene& scene, const WavelengthGrid& nodes) {
    if (!scene.illuminant) return {};
    return SpectrumInterpolation{nodes, scene.wavelengths}.folded(
        tristimulus_weights(scene.wavelengths.micrometres(), *scene.illuminant).weights());
}

/// Spectra on the scene's wavelengths from those at a rung's; perhaps without the specular term.
class PlannedEvaluator final : public Evaluator {
  public:
    PlannedEvaluator(Reflectance nodes, const WavelengthGrid& wavelengths, bool specular)
        : Evaluator{nodes.name(), wavelengths},
          nodes_{std::move(nodes)},
          specular_{specular},
          interpolation_{nodes_.wavelengths(), wavelengths} {}

    [[nodiscard]] Properties properties() const override {
        Properties result = nodes_.properties();
        result.polarised = result.polarised && interpolation_.is_identity();
        result.specular_term = result.specular_term && specular_;
        result.transmitting = false;
        result.surface.reset();
        return result;
    }
    [[nodiscard]] std::size_t bytes() const noexcept override {
        return sizeof *this + nodes_.bytes() + wavelengths().size() * sizeof(double) + interpolation_.bytes();
    }
    void brdf(const DirectionPair& pair, std::span<double> values) const noexcept override {
        brdf_batch({&pair, 1}, values);
    }
    void brdf_batch(std::span<const DirectionPair> pairs, std::span<double> values) const noexcept override {
        if (interpolation_.is_identity()) return nodes_.evaluator().brdf_batch(pairs, values);
        const std::size_t width = wavelengths().size();
        std::array<double, block * PlannedForm::most_nodes> at_nodes;  // NOLINT(*-member-init): written first
        for (std::size_t first = 0; first < pairs.size(); first += block) {
            const auto some = pairs.subspan(first, std::min(block, pairs.size() - first));
            nodes_.evaluator().brdf_batch(some, std::span{at_nodes}.first(some.size() * nodes_.size()));
            for (std::size_t i = 0; i < some.size(); ++i) {
                interpolation_(std::span{at_nodes}.subspan(i * nodes_.size(), nodes_.size()),
                               values.subspan((first + i) * width, width));
            }
        }
    }
    void uniform_diffuse(std::span<double> values) const noexcept override {
        through_nodes(values,
                      [&](std::span<double> at_nodes) { nodes_.evaluator().uniform_diffuse(at_nodes); });
    }
    void directional_diffuse(const DirectionPair& pair, std::span<double> values) const noexcept override {
        through_nodes(values, [&](std::span<double> at_nodes) {
            nodes_.evaluator().directional_diffuse(pair, at_nodes);
        });
    }
    void specular_reflectance(const Direction& in, std::span<double> values) const noexcept override {
        if (!specular_) return std::ranges::fill(values, 0.0), void();
        through_nodes(values, [&](std::span<double> at_nodes) {
            nodes_.evaluator().specular_reflectance(in, at_nodes);
        });
    }
    void mueller(const DirectionPair& pair, std::span<Mueller> values) const noexcept override {
        nodes_.evaluator().mueller(pair, values);
    }
    void directional_diffuse_mueller(const DirectionPair& pair,
                                     std::span<Mueller> values) const noexcept override {
        nodes_.evaluator().directional_diffuse_mueller(pair, values);
    }
    void specular_mueller(const Direction& in, std::span<Mueller> values) const noexcept override {
        if (specular_)
            nodes_.evaluator().specular_mueller(in, values);
        else
            std::ranges::fill(values, Mueller{});
    }

  private:
    template <class AtNodes>
    void through_nodes(std::span<double> values, const AtNodes& at_nodes) const noexcept {
        if (interpolation_.is_identity()) return at_nodes(values);
        std::array<double, PlannedForm::most_nodes> few;  // NOLINT(*-member-init): written before it is read
        at_nodes(std::span{few}.first(nodes_.size()));
        interpolation_(std::span{few}.first(nodes_.size()), values);
    }

    Reflectance nodes_;
    bool specular_;
    SpectrumInterpolation interpolation_;
};

Reflectance on_scene_wavelengths(const Scene& scene, const Rung& rung, const Reflectance& nodes) {
    const auto& name = nodes.name();
    const bool same = std::ranges::equal(rung.wavelengths.micrometres(), scene.wavelengths.micrometres());
    if (!std::ranges::equal(nodes.wavelengths().micrometres(), rung.wavelengths.micrometres()))
        throw Error{name + ": wavelengths of what is evaluated: must be the rung's"};
    if (scene.polarised && !nodes.properties().polarised)
        throw Error{name + ": must be of model he: the scene is polarised"};
    if (scene.polarised && !same) throw Error{name + ": wavelengths must be the scene's, which is polarised"};
    if (!same && nodes.size() > PlannedForm::most_nodes) {
        throw out_of_range("number of wavelengths", static_cast<double>(nodes.size()), "",
                           "<= " + std::to_string(PlannedForm::most_nodes) + ", or all the scene's");
    }
    if (same && (rung.specular || !nodes.properties().specular_term)) return nodes;
    return Reflectance{std::make_shared<const PlannedEvaluator>(nodes, scene.wavelengths, rung.specular)};
}

}  // namespace

PlannedForm::PlannedForm(const Scene& scene, Rung rung, Reflectance at_nodes)
    : rung_{std::move(rung)},
      nodes_{std::move(at_nodes)},
      reflectance_{on_scene_wavelengths(scene, rung_, nodes_)},
      weights_{node_weights(scene, rung_.wavelengths)} {}

std::size_t PlannedForm::bytes() const noexcept {
    return sizeof *this + reflectance_.bytes() + rung_.wavelengths.size() * sizeof(double) +
           weights_.size() * sizeof(Xyz);
}

Xyz PlannedForm::colour(const DirectionPair& pair, std::span<double> scratch) const {
    nodes_.brdf(pair, scratch);
    return std::numbers::pi * weighted(scratch);
}

Xyz PlannedForm::specular_colour(const Direction& in) const {
    std::vector<double> values(nodes_.size());
    if (rung_.specular) nodes_.specular_reflectance(in, values);
    return weighted(values);
}

Xyz PlannedForm::weighted(std::span<const double> at_nodes) const {
    if (weights_.empty()) throw Error{name() + ": no colour: the scene's output must be rgb"};
    Xyz sum{0, 0, 0};
    for (std::size_t i = 0; i < at_nodes.size(); ++i) sum = sum + at_nodes[i] * weights_[i];
    return sum;
}

MaterialForms::MaterialForms(const Scene& scene, const Material& material)
    : scene_{scene}, material_{material} {
    if (!scene.compensate_energy) return;
    const auto& surface = material.properties().surface;
    if (!surface) throw Error{material.name() + ": must be of model he: the scene compensates energy"};
    compensation_ = EnergyCompensation::of(*surface, scene.wavelengths);
}

PlannedForm MaterialForms::at(const Rung& rung) const {
    return {scene_, rung, at_nodes(rung)};
}

Reflectance MaterialForms::at_nodes(const Rung& rung) const {
    Reflectance model =
        material_.at(rung.wavelengths,
                     {.tolerance = rung.lobe_tolerance, .outside = scene_.outside_range, .lobe = rung.lobe});
    if (!scene_.compensate_energy) return model;
    return compensated(model,
                       EnergyCompensation::interpolated(compensation_, scene_.wavelengths, rung.wavelengths));
}

PlannedForm MaterialForms::full_model(Tolerance tolerance) const {
    return at({DiffuseLobe::full, tolerance, material_.properties().specular_term, scene_.wavelengths});
}

}  // namespace hts::spectral
