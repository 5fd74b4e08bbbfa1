/// The whole model at one point, by the engine and at 80 digits, for the rows of the stability suite. Private
/// to it.
#pragma once

#include "bench/stability/failures.hpp"

namespace hts::bench {

/// Phi by the sum itself at 80 digits; g below 1e18.
[[nodiscard]] double reference_phi(double g, double t);

/// Directional-diffuse BRDF [1/sr] and specular reflectance.
struct ModelValues {
    double diffuse, specular;
};

/// By the engine; throws hts::Error for a point outside its domain.
[[nodiscard]] ModelValues engine_model(const ModelPoint& point);

/// At 80 digits by the literal forms. Angles must not be 0, 90 or a backscatter pair; g and t below 1e18.
[[nodiscard]] ModelValues reference_model(const ModelPoint& point);

/// The directional-diffuse BRDF for wavelength -> 0, |F|^2 S D_B/(4 cos theta_i cos theta_r), at 80 digits.
[[nodiscard]] double reference_rough_limit(const ModelPoint& point);

/// |F(theta_i)|^2 at 80 digits.
[[nodiscard]] double reference_mirror(const ModelPoint& point);

}  // namespace hts::bench
