/// The rows of the stability suite, one function each. Private to it.
#pragma once

#include "bench/stability/stability_row.hpp"

namespace hts::bench {

[[nodiscard]] StabilityRow series_in_floating_point();  // 1
[[nodiscard]] StabilityRow series_at_large_g();         // 2
[[nodiscard]] StabilityRow rough_limit_in_the_tail();   // 3
[[nodiscard]] StabilityRow root_of_roughness();         // 4
[[nodiscard]] StabilityRow shadowing_cancellation();    // 5
[[nodiscard]] StabilityRow factors_at_backscatter();    // 6
[[nodiscard]] StabilityRow frames_along_the_normal();   // 7
[[nodiscard]] StabilityRow fresnel_cancellation();      // 8
[[nodiscard]] StabilityRow extreme_lengths();           // 9
[[nodiscard]] StabilityRow steep_surfaces();            // 10
[[nodiscard]] StabilityRow energy_of_the_model();       // 11
[[nodiscard]] StabilityRow single_precision();          // 12
[[nodiscard]] StabilityRow bad_input();                 // 13

}  // namespace hts::bench
