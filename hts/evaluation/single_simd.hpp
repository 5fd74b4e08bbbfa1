// The compiled forms of the evaluation in single precision for one instruction set.
#pragma once

#include <span>

#include "hts/evaluation/evaluation_simd.hpp"
#include "hts/evaluation/single_precision.hpp"

namespace hts::evaluation_detail {

/// lowest_cosine for vectors of single precision.
inline constexpr float lowest_single_cosine = 1.1e-5F;

/// What single precision holds with room for every product of the kernels, on top of is_ordinary: lengths of
/// 0.001 to 10 000 um, wavelengths of 0.05 to 1000 um, indices up to 1000, and no total reflection without
/// absorption, whose edge is sharper than single precision resolves.
[[nodiscard]] bool fits_single(const Surface& surface, std::span<const SpectralSample> samples) noexcept;

struct SingleForms {
    /// False, and the result untouched, where the pair is not ordinary.
    bool (*brdf_one)(const PreparedSingle& prepared, const DirectionPair& pair, double* result);
    bool (*brdf_of_vectors)(const PreparedSingle& prepared, const VectorPair& pair, float* result);
    /// Whether every pair is ordinary; the others get an arbitrary result.
    bool (*brdf_many)(const PreparedSingle& prepared, std::span<const DirectionPair> pairs, double* result);
    bool (*brdf_of_many_vectors)(const PreparedSingle& prepared, std::span<const VectorPair> pairs,
                                 float* result);
};

/// Those of the best instruction set this processor has; null where it has no vectors.
[[nodiscard]] SingleForms single_forms(DiffuseLobe lobe) noexcept;

}  // namespace hts::evaluation_detail
