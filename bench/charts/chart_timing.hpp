/// What a value of Phi costs.
#pragma once

#include "bench/phi/accuracy_sweep.hpp"

namespace hts::bench {

/// Nanoseconds of processor time per value: median of seven passes over inputs drawn beforehand, on one core.
///   inputs    walked through without repetition while they last, so that neither data nor branches are
///             known beforehand
///   seconds   that it may take in all; a method too slow for one value in them takes one value
///   error     the clock's and the machine's; includes one call through a pointer where the method is called
///             value by value
[[nodiscard]] double nanoseconds(const ChartMethod& method, const PhiInputs& inputs, double seconds);

}  // namespace hts::bench
