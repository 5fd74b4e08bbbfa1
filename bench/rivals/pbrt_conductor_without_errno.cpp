// Compiled with -fno-math-errno -fno-trapping-math, by CMakeLists.txt beside it.
#include "bench/rivals/pbrt_conductor.hpp"

#define HTS_PBRT_COMPILATION without_errno
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/rivals/pbrt_conductor_without_errno.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "bench/rivals/pbrt_conductor-inl.hpp"

#if HWY_ONCE
namespace hts::bench::without_errno {
HWY_EXPORT(forms);
PbrtForms best_forms(std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(forms)(count);
}
}  // namespace hts::bench::without_errno
#endif
