/// What several scenes are built from. Private to validation/pictures.
#pragma once

#include <array>

#include "validation/pictures/gallery.hpp"

namespace hts::validation {

/// A spectrum for each of red, green and blue: held below 0.49 um (blue), about 0.54 (green) and above 0.61
/// (red), joined by straight lines.
[[nodiscard]] spectral::PiecewiseLinear from_rgb(const std::array<double, 3>& rgb);

/// A perfectly diffuse material.   rgb   albedo, 0 ... 1
[[nodiscard]] Appearance matt(const std::array<double, 3>& rgb);

/// A rectangle about a centre whose normal points at something, its first edge level.
[[nodiscard]] Rectangle softbox(Vector3 centre, Vector3 looks_at, double width, double height);

[[nodiscard]] std::vector<Gallery> he_galleries();
[[nodiscard]] std::vector<Gallery> microfacet_galleries();

}  // namespace hts::validation
