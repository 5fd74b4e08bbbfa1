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

/// The same above a surface of two correlation lengths. In its frame vectors v of the plane are stretched as
/// t has them, S v with S = ((xx, xy), (xy, yy)) symmetric and of determinant 1: S turns the ellipses
/// of the lobe into circles.
struct StretchedLight : Light {
    double xx, xy, yy;
    double reach;  // (xy^2 + yy^2)^(1/2), how far S^-1 takes a unit vector along x at most

    StretchedLight(const Surface& surface, const Direction& in) noexcept;
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

    double (*stretched_density)(const Mixture& mixture, const StretchedLight& light, Vector3 out);
    Drawn (*stretched_draw)(const Mixture& mixture, const StretchedLight& light, const Uniforms& u);
    Vector3 (*stretched_drawn_from)(const Mixture& mixture, const StretchedLight& light, std::size_t part,
                                    const Uniforms& u);
};

/// A vector in the frame of the light as one in that of the surface, and back.
[[nodiscard]] Vector3 out_of_frame(const Direction& in, Vector3 v) noexcept;
[[nodiscard]] Vector3 into_frame(const Direction& in, const Direction& out) noexcept;

/// Those of the best instruction set this processor has.
[[nodiscard]] const Forms& forms() noexcept;

}  // namespace hts::sampling_detail
