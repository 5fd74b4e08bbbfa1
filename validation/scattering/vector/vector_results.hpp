/// Averages over realisations of rough conducting surfaces (`vector_study`), in bins of directions, and how
/// far closed forms are from them.
///
/// The incoherent part of the exact lobe is known better by a control variate: Kirchhoff's currents on the
/// same realisations share its speckle, and their mean K is known in closed form,
///
///   exact = <E> - b (<K> - K),   b = cov(E, K)/var(K)
///
/// by realisations, bin by bin and in each channel by itself. The closed forms, of Kirchhoff and of every
/// model, are averages over the waves of the beam and over the bin.
#pragma once

#include <array>
#include <vector>

#include "validation/scattering/ground_truth.hpp"
#include "validation/scattering/vector/vector_study.hpp"

namespace hts::validation {

/// A surface in a plane of incidence at an angle.
struct VectorCase {
    VectorSurface surface;
    double azimuth_deg, theta_i_deg;
};

/// Directions of scattering.
struct VectorBin {
    double theta_deg, most_theta_deg, phi_deg, most_phi_deg;  ///< limits; azimuths from forward
    Channels exact, error;  ///< share per solid angle, a mean [1/sr], and its standard error

    [[nodiscard]] double solid_angle() const noexcept;  ///< both sides of the plane of incidence
};

struct VectorResult {
    VectorCase of;
    int realisations;
    double iterations;                     ///< of GMRES
    std::array<double, 2> energy, mirror;  ///< shares of s and of p: all that goes up; what is coherent
    std::array<double, 2> energy_error;
    double kirchhoff_db;  ///< of the realisations' Kirchhoff lobe from its closed form, rms
    double gain;          ///< by the control variate: what it divides the variance by, a median
    std::vector<VectorBin> bins;
};

/// The limits of bins: theta_r by 10 degrees, azimuths 21, 48, 42, 48 and 21 degrees wide.
[[nodiscard]] std::vector<VectorBin> vector_bins();

/// The closed forms in the bins of a case.
[[nodiscard]] std::vector<std::array<Channels, vector_models.size()>> binned(const ClosedForms& forms,
                                                                             const VectorCase& of,
                                                                             const VectorSettings& settings);

/// Of all realisations of a surface, 3 or more: its cases.
[[nodiscard]] std::vector<VectorResult> vector_results(const VectorSurface& surface,
                                                       const VectorSettings& settings,
                                                       const std::vector<VectorRealisation>& all);

/// What is compared.
enum class VectorLight { ss, pp, cross, unpolarised };
inline constexpr std::array vector_lights{VectorLight::ss, VectorLight::pp, VectorLight::cross,
                                          VectorLight::unpolarised};
[[nodiscard]] const char* name(VectorLight light) noexcept;
/// Of channels: cross is sp and ps, unpolarised all, both for unpolarised incident light.
[[nodiscard]] double of(const Channels& each, VectorLight light) noexcept;

/// Standard error of that in a bin, those of its channels taken for independent.
[[nodiscard]] double error_of(const VectorBin& bin, VectorLight light) noexcept;

/// Which directions.
enum class VectorRegion { all, in_plane, out_of_plane };
inline constexpr std::array vector_regions{VectorRegion::all, VectorRegion::in_plane,
                                           VectorRegion::out_of_plane};
[[nodiscard]] const char* name(VectorRegion region) noexcept;

/// Bins within 10 degrees of the horizon do not count.
inline constexpr double most_compared_theta_deg = 80;

/// A model's distance from the exact lobe [dB]: rms over bins with the weight of the exact energy in them;
/// NaN where no bin has light.
struct VectorDistance {
    double rms, bias;  ///< bias above 0 where the model is too bright
    double chance;     ///< rms of the bins' standard errors with the same weights
};
[[nodiscard]] VectorDistance distance(const std::vector<VectorBin>& exact, const std::vector<Channels>& model,
                                      VectorLight light, VectorRegion region);

}  // namespace hts::validation
