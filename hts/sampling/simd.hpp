// The compiled forms of the sampler for one instruction set.
#pragma once

#include <array>
#include <cstddef>

#include "hts/sampling/mixture.hpp"

namespace hts::sampling_detail {

/// The light as (sine, 0, cosine).
struct Light {
    double cosine, sine;
};

/// A direction in the frame of the light, and the part it was drawn from: none where out.z <= 0.
struct Drawn {
    Vector3 out;
    std::size_t part;
    double pdf;  // of a diffuse part
};

using Uniforms = std::array<double, 3>;

struct Forms {
    /// Density of all diffuse parts [1/sr]; out.z > 0.
    double (*density)(const Mixture& mixture, const Light& light, Vector3 out);
    /// The same of a pair of directions, the mixture chosen among mixture_count; 0 on the horizon.
    double (*pdf)(const Mixture* mixtures, const Direction& in, const Direction& out);
    Drawn (*draw)(const Mixture& mixture, const Light& light, const Uniforms& u);
    /// One direction of a given diffuse part, `u[0]` within its share.
    Vector3 (*drawn_from)(const Mixture& mixture, const Light& light, std::size_t part, const Uniforms& u);
};

/// Those of the best instruction set this processor has.
[[nodiscard]] const Forms& forms() noexcept;

}  // namespace hts::sampling_detail
