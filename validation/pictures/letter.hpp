/// Letters on the panels of a picture.
#pragma once

#include <cstddef>

#include "validation/pictures/renderer.hpp"

namespace hts::validation {

/// How many panels can have one: (a) to (f).
inline constexpr std::size_t letters = 6;

/// Writes "(a)", "(b)" … into the upper left corner, black on white.
///   place   0 of (a); nothing is written from `letters` on
void put_letter(Picture& panel, std::size_t place);

}  // namespace hts::validation
