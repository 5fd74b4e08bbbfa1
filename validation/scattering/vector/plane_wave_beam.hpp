/// A beam of finite width that is an exact sum of plane waves, so that it obeys Maxwell's equations to
/// rounding. The wavelength is the unit of length, the amplitude of E is that of H, the time factor is
/// exp(-i omega t).
///
/// At z = 0 it is a Gaussian spot exp(-rho^2/width^2) with the phase of the direction of incidence. Its waves
/// stand on a lattice of horizontal wave vectors, which repeats the spot at every period: a patch that is not
/// wider than some 0.8 of a period sees one of them. Each wave is weighted with its cosine, so that none runs
/// along the horizon, and the spectrum's centre is shifted so that the power falls in from theta on average.
/// Polarised s or p is each wave in its own frame (polarisation.hpp).
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "hts/direction.hpp"

namespace hts::validation {

enum class Incident { s, p };
inline constexpr std::array incident_states{Incident::s, Incident::p};

using ComplexVector = std::array<std::complex<double>, 3>;

/// A wave of the beam.
struct BeamWave {
    Vector3 along;     ///< unit vector of propagation, z < 0
    double amplitude;  ///< the strongest has about 1
    double weight;     ///< share of the beam's power

    /// Where it comes from.
    [[nodiscard]] Direction in() const { return Direction::from_unit_vector(-along); }
};

class PlaneWaveBeam {
  public:
    ///   theta     of incidence [rad], such that no wave of weight is vertical or grazing: 0.2 … 1.3 where
    ///             the width is 2 or more
    ///   azimuth   of the horizontal direction of propagation [rad]
    ///   least     amplitude of waves that are left out, of the strongest
    PlaneWaveBeam(double theta, double azimuth, double width, double period, double least = 1e-5);

    [[nodiscard]] const std::vector<BeamWave>& waves() const noexcept { return waves_; }
    [[nodiscard]] double azimuth() const noexcept { return azimuth_; }
    /// Power through a horizontal plane, of which a plane wave of amplitude 1 carries cos theta per area.
    [[nodiscard]] double power() const noexcept { return power_; }
    /// H at a point, of both polarisations.
    [[nodiscard]] std::array<ComplexVector, 2> magnetic_field(Vector3 point) const noexcept;

  private:
    std::vector<BeamWave> waves_;
    std::vector<Vector3> s_;  // of each wave
    double azimuth_, power_ = 0;
};

}  // namespace hts::validation
