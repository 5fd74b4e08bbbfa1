/// Realisations of rough conducting surfaces, each solved exactly and by Kirchhoff's currents under the same
/// beams, and what is kept of each on the way to averages: sums in files of their own, so that a long run can
/// be stopped, goes on where it ended, and is shared among processes and machines.
///
/// The wavelength is the unit of length. Directions of scattering stand on a grid of 2 degrees in theta_r and
/// 3 in the azimuth from the plane of incidence, forward 0; both sides of the plane are averaged, which the
/// statistics of the surfaces do not tell apart.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hts/surface.hpp"
#include "validation/scattering/vector/vector_models.hpp"

namespace hts::validation {

/// Gaussian, with correlation lengths along x and y, and the azimuths of the planes of incidence that are
/// solved. Those of an isotropic surface go together.
struct VectorSurface {
    double rms_roughness;
    CorrelationLengths lengths;
    std::size_t points_per_wavelength = 5;

    [[nodiscard]] bool isotropic() const noexcept { return lengths.along == lengths.across; }
    [[nodiscard]] Surface surface() const;
};

struct VectorSettings {
    double length;  ///< of the square; the beam's width is a sixth of it
    double tolerance = 1e-3;
    std::vector<double> theta_i_deg{20, 40, 60};
    std::uint64_t study = 2026;

    [[nodiscard]] double beam_width() const noexcept { return length / 6; }
};

/// Planes of incidence [deg]: along x and along y.
inline constexpr std::array vector_azimuths_deg{0.0, 90.0};

/// The grid of directions.
inline constexpr int polar_steps = 45, azimuth_steps = 60;
/// Middle of a step [rad]; azimuths from 0, forward, to pi.
[[nodiscard]] double polar_angle(int step) noexcept;
[[nodiscard]] double azimuth(int step) noexcept;
/// Solid angle of a step, both sides of the plane of incidence [sr].
[[nodiscard]] double solid_angle(int polar_step) noexcept;

/// Scattered into a direction by a realisation, of all that falls in.
struct Scatter {
    std::array<float, channels.size()> exact, kirchhoff;  ///< intensities [1/sr]
    /// Amplitudes of ss and pp [1/sqrt(sr)], for what is coherent: their squares are intensities.
    std::array<std::complex<float>, 2> exact_field, kirchhoff_field;
};
/// By polar step, then by azimuth.
using ScatterGrid = std::vector<Scatter>;

/// A realisation at all angles of incidence; of an anisotropic surface in both planes of incidence, by plane
/// and then by angle.
struct VectorRealisation {
    std::vector<ScatterGrid> grids;
    float iterations;  ///< of GMRES, a mean
};

///   number   seeds follow from it
///   cost     4 to 10 s on one core
[[nodiscard]] VectorRealisation realisation(const VectorSurface& surface, const VectorSettings& settings,
                                            std::size_t number);

/// The file of a realisation in a folder: a line that says what it is, then numbers. It is written whole or
/// not at all.
class RealisationFile {
  public:
    RealisationFile(const std::filesystem::path& folder, const VectorSurface& surface,
                    const VectorSettings& settings, std::size_t number);

    [[nodiscard]] bool exists() const;
    /// hts::Error "path: …" where it is of another run or damaged.
    [[nodiscard]] VectorRealisation read() const;
    void write(const VectorRealisation& realisation) const;

  private:
    std::filesystem::path path_;
    std::string head_;
    std::size_t grids_;
};

}  // namespace hts::validation
