/// Kernels as a lesser processor would run them.
#pragma once

#include <cstdint>

#include <hwy/targets.h>

namespace hts::testing {

/// Calls f(name) once for each instruction set that this processor has and that was compiled, as if it were
/// the best.
template <class F>
void on_every_target(F f) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        f(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hts::testing
