/// Whether draws of directions fall as their density says: Pearson's test over cells of the sphere that hold
/// about as many draws each, their probabilities by adaptive quadrature of the density.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace hts::testing {

/// A function of polar angle and azimuth [rad], theta in 0 ... pi.
using OnSphere = std::function<double(double theta, double phi)>;

/// A region of the sphere.
struct Patch {
    double theta0, theta1, phi0, phi1;
};

/// Integral of f over solid angle by nested adaptive quadrature.
///   tolerance   relative
[[nodiscard]] double integral(const OnSphere& f, const Patch& patch, double tolerance);

/// The same for a function that peaks at (theta, phi) with a width: in pieces that grow away from the peak,
/// cut at the horizon too.
struct Peak {
    double theta, phi, width;
    double width_phi = width;
};
[[nodiscard]] double integral(const OnSphere& f, const Patch& patch, const Peak& peak, double tolerance);

/// Where a draw fell; phi in -pi ... pi, best with the lobe about 0.
struct Angles {
    double theta, phi;
};

/// What was drawn: a direction with a density, the direction of a delta, or nothing.
struct Draw {
    Draw(std::optional<Angles> direction = {}, bool of_delta = false) : angles{direction}, delta{of_delta} {}

    std::optional<Angles> angles;
    bool delta;
};

/// Pearson's statistic with cells pooled up to 10 expected draws.
class ChiSquared {
  public:
    void add(double expected, double found);
    /// The probability of a worse fit by chance.
    [[nodiscard]] double p_value() const;

  private:
    double expected_ = 0, found_ = 0, sum_ = 0;
    std::size_t cells_ = 0;
};

/// How well draws fit.
struct Fit {
    double p_value;  ///< the draws that gave none count as a cell of their own
    double total;    ///< integral of the density, and the probability of the delta
    double none;     ///< share of draws that gave none
    /// total + none, from 1, in standard errors.
    [[nodiscard]] double deviation_of_sum(std::size_t count) const;
};

/// Draws `count` times, first 12000 more to find the cells.
///   delta   probability of the delta
[[nodiscard]] Fit fit_of(const std::function<Draw()>& draw, const OnSphere& density, std::size_t count,
                         double delta = 0);

}  // namespace hts::testing
