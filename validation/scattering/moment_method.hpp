/// Light scattered by random rough profiles, exactly: perfect conductors or a ground that light enters, under
/// a tapered beam, TE and TM, solved by the method of moments (`boundary_integral`) and averaged over
/// realisations. Lengths are in wavelengths.
///
/// Each realisation is solved and, with the same heights and the same beam, computed from Kirchhoff's
/// currents on a perfect conductor, 2 d psi_in/dn and 2 psi_in; on a ground their amplitude is multiplied by
/// the modulus of Fresnel's at theta_d, half the angle between the directions, as [He91 (44)] does. The two
/// share their speckle, so their ratio is known far better than either; and the closed form of the second is
/// known (`profile_scattering`). A model's distance from the exact solution is hence taken as
///
///   model/exact = model/Kirchhoff (closed forms) * Kirchhoff/exact (realisations)
///
/// The profile is finite, and some of the light that runs along it, a little above, passes its end and is
/// diffracted below the horizon; of an infinite one it would stay above. It is counted apart, from the field
/// above the profile continued below the horizon: integral (psi - psi_in) dG/dn' - G (u - u_in).
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hts/fresnel.hpp"
#include "validation/scattering/profile_scattering.hpp"

namespace hts::validation {

struct MomentSettings {
    int realisations = 250;
    double length = 50;  ///< of the profile; the beam's g is a quarter of it
    int points_per_wavelength = 10;
    int drawn_between =
        1;  ///< steps of the drawn heights from node to node: 2 solves by every second of them
    std::uint64_t study = 1991;              ///< seeds of all realisations follow from it
    std::optional<RefractiveIndex> index{};  ///< of the ground; none for a perfect conductor
};

enum class Polarisation { te, tm, unpolarised };
inline constexpr std::array polarisations{Polarisation::te, Polarisation::tm, Polarisation::unpolarised};
/// "te", "tm", "unpolarised".
[[nodiscard]] const char* name(Polarisation polarisation) noexcept;

/// A profile under a beam.
struct MomentCase {
    RoughnessStatistics surface;
    double theta_i_deg;
    Polarisation polarisation;
    std::optional<RefractiveIndex> index{};
};

/// What a plane interface mirrors where the directions are 2 theta_d apart; 1 for a perfect conductor.
[[nodiscard]] double facet_reflectance(const MomentCase& of, double theta_d);

/// Between two angles of scattering.
struct AngularBin {
    double theta_r_deg;  ///< middle
    double exact;        ///< incoherent [1/rad] of the power that falls in, an average over the bin
    double kirchhoff;    ///< the same realisations by Kirchhoff's currents, times the facet_reflectance
    std::array<double, profile_models.size()> model;  ///< closed forms
    double ratio_error_db;                            ///< standard error of kirchhoff/exact, by jackknife
};

/// Shares of the power that falls in.
struct MomentResult {
    MomentCase of;
    int realisations;
    double energy;       ///< all that is accounted for: 1 in an exact solution
    double mirror;       ///< what is scattered coherently
    double past_ends;    ///< what passes the ends of the profile and is diffracted below the horizon
    double transmitted;  ///< into the ground, where it is absorbed or runs on
    double kirchhoff_energy;
    std::vector<AngularBin> bins;  ///< 5 degrees each
};

inline constexpr double bin_width_deg = 5;
/// Of a closed form [1/rad]: where it is less, what is computed of realisations is the beam's
/// rest, and bins do not count.
inline constexpr double least_light = 1e-12;

/// A surface at all angles of incidence, and at each in the three polarisations; the same bits
/// for any number of threads.
///   cost   0.12 s a realisation on one core, whatever the number of angles; a ground four times as much
[[nodiscard]] std::vector<MomentResult> moment_results(const RoughnessStatistics& surface,
                                                       const std::vector<double>& theta_i_deg,
                                                       const MomentSettings& settings);

/// A surface and the angles it is seen at.
struct LitSurface {
    RoughnessStatistics surface;
    std::vector<double> theta_i_deg;
};
/// Surfaces one after the other.
///   unfinished   a file that takes what is solved, surface by surface, so that a run that was stopped goes
///                on where it ended, to the same bits; the caller removes it when the tables stand. None if
///                empty. hts::Error where it is of another run
[[nodiscard]] std::vector<MomentResult> moment_results(const std::vector<LitSurface>& surfaces,
                                                       const MomentSettings& settings,
                                                       const std::string& unfinished = {});

/// A model's distance from the exact incoherent lobe [dB]; 0 where there is none, on a plane.
struct Distance {
    double rms;     ///< over bins, each with the weight of the exact energy in it
    double median;  ///< of absolute values over the bins within 20 dB of the brightest
    double bias;    ///< mean with the weights of rms: above 0 where the model is too bright
};
[[nodiscard]] Distance distance(const MomentResult& result, ProfileModel model);
/// What chance adds to rms: the weighted rms of the bins' standard errors [dB].
[[nodiscard]] double chance(const MomentResult& result);
/// Distance of the realisations' Kirchhoff lobe from its closed form [dB]: a test of both.
[[nodiscard]] Distance kirchhoff_distance(const MomentResult& result);

}  // namespace hts::validation
