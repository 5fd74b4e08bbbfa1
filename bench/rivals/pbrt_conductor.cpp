// Compiled as pbrt is built: nothing said of errno and of trapping mathematics.
#include "bench/rivals/pbrt_conductor.hpp"

#include <string>

#include "hts/error.hpp"

#define HTS_PBRT_COMPILATION as_pbrt_is_built
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/rivals/pbrt_conductor.cpp"
#include "hwy/foreach_target.h"  // includes this file again for each instruction set

#include "bench/rivals/pbrt_conductor-inl.hpp"

#if HWY_ONCE
namespace hts::bench {

namespace without_errno {
PbrtForms best_forms(std::size_t count);  // of pbrt_conductor_without_errno.cpp
}

namespace as_pbrt_is_built {
HWY_EXPORT(forms);
static PbrtForms best_forms(std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(forms)(count);
}
}  // namespace as_pbrt_is_built

PbrtConductor::PbrtConductor(double alpha, std::span<const double> n, std::span<const double> k,
                             Compilation compilation)
    : alpha_{static_cast<float>(alpha)}, eta_{n.begin(), n.end()}, k_{k.begin(), k.end()} {
    if (!(alpha >= 1e-3 && alpha <= 1e3)) throw out_of_range("GGX width alpha", alpha, "", "1e-3 ... 1000");
    if (n.size() != k.size())
        throw Error{"optical constants: n and k must have the same number of wavelengths"};
    forms_ = compilation == Compilation::without_errno ? without_errno::best_forms(n.size())
                                                       : as_pbrt_is_built::best_forms(n.size());
    if (forms_.brdf == nullptr) {
        throw Error{"optical constants at " + std::to_string(n.size()) +
                    " wavelengths: must be 1, 4, 8, 16 or 31 of them"};
    }
}

}  // namespace hts::bench
#endif
