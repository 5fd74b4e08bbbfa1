/// Points that fill the unit square evenly, for pixels, lights and paths.
///
/// The (0, 2)-sequence of van der Corput and Sobol, its order and its digits scrambled by a hash (Owen's
/// scrambling), so that two dimensions of the same sample, or the same of two pixels, know nothing of each
/// other. A point depends on its numbers alone: pictures have the same bits for any number of threads.
#pragma once

#include <array>
#include <cstdint>

namespace hts::validation {

/// Which pixel and which two dimensions of its samples; streams with other numbers are independent.
[[nodiscard]] std::uint32_t stream(std::uint32_t seed, std::uint32_t pixel,
                                   std::uint32_t dimensions) noexcept;

/// Point `index` of a stream, both coordinates in [0, 1).
[[nodiscard]] std::array<double, 2> even_point(std::uint32_t stream, std::uint32_t index) noexcept;

}  // namespace hts::validation
