// One lane at a time single precision saves nothing, so the page computes in double precision at every
// tolerance.
#include "hts/evaluation/single_simd.hpp"

namespace hts::evaluation_detail {

bool fits_single(const Surface& /*surface*/, std::span<const SpectralSample> /*samples*/) noexcept {
    return false;
}

SingleForms single_forms(DiffuseLobe /*lobe*/) noexcept {
    return {};
}

}  // namespace hts::evaluation_detail
