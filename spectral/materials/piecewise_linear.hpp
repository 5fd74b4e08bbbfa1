/// A quantity tabulated against wavelength and joined by straight lines.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hts/wavelength.hpp"

namespace hts::spectral {

/// What to do with a wavelength outside the range of a table or formula.
enum class OutsideRange {
    error,  ///< hts::Error that names the range
    clamp,  ///< take the value at the nearer end
};

/// Vacuum wavelengths from `shortest` to `longest` [um], both included.
struct WavelengthRange {
    double shortest, longest;

    [[nodiscard]] bool contains(double um) const noexcept { return shortest <= um && um <= longest; }
    [[nodiscard]] double clamp(double um) const noexcept {
        return um < shortest ? shortest : um > longest ? longest : um;
    }
    /// The wavelength itself inside the range; outside, the nearer end or hts::Error
    /// "wavelength 3 um: must be from 0.3 to 2.5 um (range of <what>)".
    [[nodiscard]] double admit(const Wavelength& wavelength, OutsideRange policy,
                               const std::string& what) const;
};

/// Straight lines between tabulated points.
class PiecewiseLinear {
  public:
    struct Point {
        double um, value;
    };
    /// Points in any order; those with the same wavelength are averaged. Needs at least one point,
    /// wavelengths as hts::Wavelength takes them, values finite, else hts::Error.
    explicit PiecewiseLinear(std::vector<Point> points);

    [[nodiscard]] WavelengthRange range() const noexcept;
    /// Value at a wavelength [um]; outside the range that of the nearer end.
    [[nodiscard]] double operator()(double um) const noexcept;
    /// The points, wavelengths strictly increasing.
    [[nodiscard]] std::span<const Point> points() const noexcept { return points_; }

  private:
    std::vector<Point> points_;
};

}  // namespace hts::spectral
