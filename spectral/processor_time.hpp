/// What a piece of work costs. Not installed.
#pragma once

namespace hts::spectral {

/// Processor time of this thread [s], which other programs do not lengthen.
[[nodiscard]] double thread_seconds();

}  // namespace hts::spectral
