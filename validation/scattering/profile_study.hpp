/// Realisations of a random profile under tapered beams, each solved exactly and by Kirchhoff's currents.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "validation/scattering/boundary_integral.hpp"
#include "validation/scattering/moment_method.hpp"
#include "validation/scattering/tapered_beam.hpp"

namespace hts::validation {

/// Of the light; the wavelength is the unit of length.
inline constexpr double wave_number = 2 * std::numbers::pi;
inline constexpr int angles_per_bin = 10;  // of an AngularBin
inline constexpr int bin_count = static_cast<int>(180 / bin_width_deg);

/// One realisation in one polarisation, per beam: far fields per angle, and powers.
struct Scattered {
    std::vector<SurfaceField> exact, kirchhoff;
    std::vector<double> past_ends, transmitted;
};
/// TE and TM.
using Realisation = std::array<Scattered, 2>;

class ProfileStudy {
  public:
    ProfileStudy(const RoughnessStatistics& surface, const std::vector<double>& theta_i_deg,
                 const MomentSettings& settings);

    /// Of scattering: middles of even steps from -90 to 90 degrees, so that sums are integrals.
    [[nodiscard]] const std::vector<double>& angles() const { return angles_; }
    [[nodiscard]] const std::vector<TaperedBeam>& beams() const { return beams_; }
    /// As many as the settings say, on all cores.
    [[nodiscard]] std::vector<Realisation> realisations() const;

  private:
    [[nodiscard]] Realisation realisation(std::size_t number) const;
    [[nodiscard]] PolarisedFields solved(const Contour& contour,
                                         const std::vector<SurfaceField>& incident) const;

    RoughnessStatistics surface_;
    MomentSettings settings_;
    std::vector<double> angles_, below_;
    std::vector<TaperedBeam> beams_;
    std::size_t nodes_ = 0, period_ = 64;
};

}  // namespace hts::validation
