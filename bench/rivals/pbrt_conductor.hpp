/// The yardstick that renderers use: a rough conductor as pbrt-v4 computes it, in single precision, one
/// wavelength after the other, in both ways to compile it.
///
/// pbrt-v4, M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th edition (2023), sections 9.3 to
/// 9.6: Trowbridge-Reitz (GGX) normals with the height-correlated shadowing of Smith [Walter07 (33), (34)],
/// visible normals drawn after E. Heitz (2018), and the reflectance of a complex index in complex arithmetic.
/// Written anew from the book's formulas, step by step as they stand there, with the geometry from unit
/// vectors.
///
/// pbrt's own build leaves -fmath-errno and -ftrapping-math on, so that every square root has a branch for a
/// call; the same source without both is what a careful user gets from the compiler. Both are compiled for
/// every instruction set that the library itself chooses from, so neither needs -march=native.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hts/direction.hpp"
#include "hts/evaluation/single_precision.hpp"

namespace hts::bench {

enum class Compilation { as_pbrt_is_built, without_errno };

[[nodiscard]] inline Vector3f single(const Direction& direction) noexcept {
    const Vector3 v = direction.vector();
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// What the formulas read.
struct PbrtMetal {
    float alpha_x, alpha_y;
    const float *eta, *k;  // one value per wavelength
};

/// A direction drawn; pdf 0 where it fell below the horizon.
struct PbrtDraw {
    Vector3f out;
    float pdf;  ///< [1/sr]
};

/// The compiled forms for a number of wavelengths, which pbrt fixes when it is compiled.
struct PbrtForms {
    void (*brdf)(const PbrtMetal& metal, Vector3f in, Vector3f out, float* result);
    PbrtDraw (*sample)(const PbrtMetal& metal, Vector3f in, float u0, float u1, float* brdf);
    float (*pdf)(const PbrtMetal& metal, Vector3f in, Vector3f out);
    PbrtDraw (*draw)(const PbrtMetal& metal, Vector3f in, float u0, float u1);
};

/// A rough conductor at 1, 4, 8, 16 or 31 wavelengths.
class PbrtConductor {
  public:
    ///   alpha   width of the slopes, 1e-3 or more: pbrt takes less for a mirror
    ///   n, k    one value per wavelength, equally many; else hts::Error
    PbrtConductor(double alpha, std::span<const double> n, std::span<const double> k,
                  Compilation compilation);

    [[nodiscard]] std::size_t size() const noexcept { return eta_.size(); }

    /// BRDF [1/sr] of unit vectors above the horizon, one value per wavelength.
    void brdf(Vector3f in, Vector3f out, std::span<float> result) const noexcept {
        forms_.brdf(metal(), in, out, result.data());
    }
    /// A direction, its density and the BRDF of each wavelength; u two numbers in [0, 1).
    [[nodiscard]] PbrtDraw sample(Vector3f in, const std::array<double, 2>& u,
                                  std::span<float> brdf) const noexcept {
        return forms_.sample(metal(), in, static_cast<float>(u[0]), static_cast<float>(u[1]), brdf.data());
    }
    [[nodiscard]] float pdf(Vector3f in, Vector3f out) const noexcept { return forms_.pdf(metal(), in, out); }
    /// A direction and its density alone.
    [[nodiscard]] PbrtDraw draw(Vector3f in, const std::array<double, 2>& u) const noexcept {
        return forms_.draw(metal(), in, static_cast<float>(u[0]), static_cast<float>(u[1]));
    }

  private:
    [[nodiscard]] PbrtMetal metal() const noexcept { return {alpha_, alpha_, eta_.data(), k_.data()}; }

    float alpha_;
    std::vector<float> eta_, k_;
    PbrtForms forms_;
};

}  // namespace hts::bench
