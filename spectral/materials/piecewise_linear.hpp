/// A quantity tabulated against wavelength and joined by straight lines.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hts/wavelength.hpp"

namespace hts::spectral {

/// What to do outside the range where something is known: a wavelength beyond a table or formula, directions
/// beyond what was measured.
enum class OutsideRange {
    error,  ///< hts::Error that names the range
    hold,   ///< take the value at the nearer end
    zero,   ///< reflect nothing there; an hts::Error of optical constants, which no number makes dark
};

/// "error", "hold", "zero".
[[nodiscard]] const char* name(OutsideRange policy) noexcept;
/// The one of that name, and `hold` for "clamp"; hts::Error that lists them otherwise.
[[nodiscard]] OutsideRange outside_range_named(std::string_view text);

/// Vacuum wavelengths from `shortest` to `longest` [um], both included.
struct WavelengthRange {
    double shortest, longest;

    /// Ends count with one rounding of slack, so that 0.3 + 6 x 0.1 is within a range that ends at 0.9.
    [[nodiscard]] bool contains(double um) const noexcept {
        return shortest * (1 - rounding) <= um && um <= longest * (1 + rounding);
    }
    [[nodiscard]] double clamp(double um) const noexcept {
        return um < shortest ? shortest : um > longest ? longest : um;
    }
    /// The wavelength itself inside the range; outside, the nearer end or hts::Error
    /// "wavelength 3 um: must be from 0.3 to 2.5 um (range of <what>)".
    [[nodiscard]] double admit(const Wavelength& wavelength, OutsideRange policy,
                               const std::string& what) const;

  private:
    static constexpr double rounding = 4e-16;
};

/// Straight lines between tabulated points. A point whose value is NaN has none, nor has anything up
/// to the points beside it.
class PiecewiseLinear {
  public:
    struct Point {
        double um, value;
    };
    /// Points in any order; those with the same wavelength are averaged. Needs at least one point,
    /// wavelengths as hts::Wavelength takes them, values finite or NaN, else hts::Error.
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
