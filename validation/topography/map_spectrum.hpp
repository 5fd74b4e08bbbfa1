/// Power spectra of height maps: of two dimensions, averaged over directions, and of profiles.
///
///   S2(f)    [um^4] over the plane of frequencies; its integral is the mean square of the heights
///   S1(f_x)  [um^3] one-sided, of profiles along x; its integral from 0 is the same
///   f        [1/um] cycles per um
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "validation/topography/levelling.hpp"

namespace hts::validation {

/// How much each point of a map counts before it is transformed.
enum class Window {
    hann,  ///< cos^2, 0 at the rim: little of strong low frequencies leaks into weak high ones
    none
};
[[nodiscard]] std::string_view name(Window window);

/// The weights of a map's points: the window, 0 in gaps.
struct MapWindow {
    std::vector<double> across, down;  ///< the window is their product
    std::vector<double> weights;       ///< of all points
    bool whole;                        ///< no gaps: the weights are that product
    double squares = 0;                ///< sum of their squares
    /// How many times fewer independent frequencies there are than without a window, count * sum w^4 /
    /// (sum w^2)^2: 3.78 for Hann.
    double inflation;

    MapWindow(const HeightMap& map, Window kind);
};

/// Lengths along and across an axis of the surface that count alike: directions are compared after distances
/// along it are divided by sqrt(ratio) and those across multiplied.
struct Ellipse {
    double ratio = 1;    ///< of correlation lengths, along over across, > 0
    double azimuth = 0;  ///< of the axis, from x towards y [rad]

    /// Of a distance, and of a frequency, whose long axis is the other.
    [[nodiscard]] double distance(double x, double y) const noexcept;
    [[nodiscard]] double frequency(double x, double y) const noexcept;
};

struct MapSpectrum {
    std::size_t columns, rows;
    double cell_x, cell_y;      ///< between frequencies [1/um]
    std::vector<double> power;  ///< S2 by rows as of a transform; y falls from row to row of the map
    /// Mean square of the windowed heights over that of all; the spectrum is divided by it.
    double window_share;

    [[nodiscard]] double frequency_x(std::size_t column) const noexcept;
    [[nodiscard]] double frequency_y(std::size_t row) const noexcept;  ///< y upwards
    [[nodiscard]] double cell() const noexcept { return cell_x * cell_y; }
    /// Sum over all frequencies: the mean square of the heights about their mean [um^2].
    [[nodiscard]] double variance() const noexcept;
};

[[nodiscard]] MapSpectrum spectrum_of(const HeightMap& map, const MapWindow& window);

/// Mean of S2 over a ring of frequencies.
struct RadialBin {
    int number;        ///< of the ring: frequencies from 10^(number/rings) to 10^((number + 1)/rings)
    double frequency;  ///< mean of those in it
    double power;
    double cells;  ///< how many frequencies are in it, a half of them independent

    static constexpr double rings = 16;  ///< per decade
};

/// Rings from the lowest frequency to the highest that all directions have. Those of several maps go
/// together, by `number`.
///   ellipse   directions along which frequencies are compared
[[nodiscard]] std::vector<RadialBin> radial_spectrum(const MapSpectrum& spectrum,
                                                     const Ellipse& ellipse = {});
[[nodiscard]] std::vector<RadialBin> merged(const std::vector<std::vector<RadialBin>>& spectra);

/// Mean of S2 over a ring and a sector of directions.
struct PolarBin {
    double frequency, azimuth;  ///< means of those in it
    double power, cells;
};
inline constexpr int sector_count = 18;
[[nodiscard]] std::vector<PolarBin> polar_spectrum(const MapSpectrum& spectrum);

struct ProfileSpectrum {
    std::vector<double> frequency, power;  ///< f and S1
};
/// Of profiles along x, or along y.
[[nodiscard]] ProfileSpectrum profile_spectrum(const MapSpectrum& spectrum, bool along_x);

}  // namespace hts::validation
