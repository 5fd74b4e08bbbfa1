/// A randomly rough surface: Gaussian heights, isotropic, with autocorrelation C(r) = exp(-r^2/tau^2) [He91 (48)].
#pragma once

namespace hts {

class Surface {
  public:
    ///   rms_roughness        sigma_0 [um], standard deviation of height   0 (a mirror), or 1e-24 ... 1e24
    ///   correlation_length   tau [um], distance at which C falls to 1/e   1e-24 ... 1e24
    /// Throws hts::Error outside these ranges.
    Surface(double rms_roughness, double correlation_length);

    [[nodiscard]] double rms_roughness() const noexcept { return rms_roughness_; }
    [[nodiscard]] double correlation_length() const noexcept { return correlation_length_; }
    /// 2 sigma_0 / tau: sqrt(2) times the rms slope, the Beckmann width alpha of Walter et al. 2007.
    [[nodiscard]] double slope_width() const noexcept { return 2 * rms_roughness_ / correlation_length_; }

  private:
    double rms_roughness_;
    double correlation_length_;
};

}  // namespace hts
