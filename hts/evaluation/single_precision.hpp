/// Vectors of single precision, and what a BRDF computed in it keeps.
#pragma once

namespace hts {

namespace accuracy {
/// Of a BRDF in single precision: relative above single_precision_floor, absolute times the floor below.
inline constexpr double single_precision_brdf = 1e-3;
inline constexpr double single_precision_floor = 1e-30;  ///< [1/sr]
}  // namespace accuracy

/// A unit vector in the frame of the surface, to rounding; no invariant. That its length is not quite 1 moves
/// v_xy by up to 1e-7 and t of the lobe by up to 2e-7 sqrt(t) pi tau/lambda, which is no part of an error.
struct Vector3f {
    float x, y, z;
};

/// Light from `in` seen from `out`.
struct VectorPair {
    Vector3f in, out;
};

}  // namespace hts
