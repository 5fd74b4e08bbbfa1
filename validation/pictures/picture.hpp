/// Pictures put together and sent to a screen.
#pragma once

#include <string>
#include <vector>

#include "validation/pictures/renderer.hpp"

namespace hts::validation {

/// How bright light is shown: as it is up to `shoulder`, beyond ever more softly towards 1, so that
/// highlights keep their colour and shape.
///   formula   x up to s = shoulder, s + (1 - s)(1 - exp(-(x - s)/(1 - s))) above: value and slope are
///             continuous
///   range     0 ... 1
inline constexpr double shoulder = 0.8;
[[nodiscard]] double shown(double brightness) noexcept;

/// The bytes of a PNG file: sRGB under D65. The largest component of each pixel is made `shown` of itself and
/// the others keep their ratio to it; what lies outside the gamut is clipped.
[[nodiscard]] std::string png(const Picture& picture);

/// Pictures of equal size in rows of `columns`, `gap` pixels of white between them; hts::Error if there is
/// none or sizes differ.
[[nodiscard]] Picture panels(const std::vector<Picture>& pictures, std::size_t columns, std::size_t gap);

}  // namespace hts::validation
