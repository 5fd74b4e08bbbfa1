/// Lambert's W where its argument need not fit in a double.
#pragma once

namespace hts {

namespace accuracy {
inline constexpr double lambert = 8e-16;  ///< of `lambert_w0_of_square`, relative
}

/// W_0(a^2): the w >= 0 with w exp(w) = a^2.
///   a        0 ... largest finite double      range  0 ... about 1413, growing
///   error    accuracy::lambert
[[nodiscard]] double lambert_w0_of_square(double a) noexcept;

/// W_0(exp(logarithm)).
///   logarithm   at least 10      error   relative, at most 1e-15 beside what `logarithm` itself carries
[[nodiscard]] double lambert_w0_of_exp(double logarithm) noexcept;

}  // namespace hts
