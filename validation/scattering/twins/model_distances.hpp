/// How far models are from exact scattering: the twin of each (`profile_twin`) against the lobes that are
/// kept, in TE, in TM and in unpolarised light [dB].
///
/// In each bin of 5 degrees model/exact is (model/Kirchhoff, closed forms) times (Kirchhoff's currents/exact,
/// the same realisations), as in `moment_method`; the distance of a case, a surface at an angle of incidence,
/// is the rms over bins with the weight of the exact energy.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "validation/scattering/ground_truth.hpp"
#include "validation/scattering/moment_method.hpp"
#include "validation/scattering/twins/profile_twin.hpp"

namespace hts::validation {

/// Lobes that are kept.
struct KeptSet {
    const char* stem;   ///< of the table STEM-lobes
    const char* title;  ///< "conductor, first set"
    RefractiveIndex index;
    /// The model that stands for he_unified: on dielectrics with the mixing of polarisations.
    TwinModel successor;
    /// Surfaces of another set, solved otherwise, or of another correlation: not for charts. Of these
    /// `hts info` has the K-correlated ones alone, for surfaces of their kind.
    bool apart = false;
};
[[nodiscard]] const std::vector<KeptSet>& kept_sets();

/// What is known exactly of a surface at an angle of incidence, per bin; pairs are TE and TM.
struct ExactLobe {
    RoughnessStatistics surface;
    double theta_i_deg;
    std::vector<double> theta_r_deg, error_db;  ///< middle of the bin; standard error, unpolarised
    std::vector<ProfileLobe> exact, kirchhoff;  ///< [1/rad]; by Kirchhoff's currents
};
/// Of a table of lobes.
[[nodiscard]] std::vector<ExactLobe> exact_lobes(const FigureTable& lobes);

/// rms [dB].
struct Distances {
    double te, tm, unpolarised;

    [[nodiscard]] double operator[](Polarisation polarisation) const noexcept {
        return std::array{te, tm, unpolarised}[static_cast<std::size_t>(polarisation)];
    }
};

/// A model's lobe, and Kirchhoff's closed form, averaged over the bins of an exact lobe.
[[nodiscard]] std::vector<ProfileLobe> binned(const ProfileTwin& model, const ExactLobe& exact);
///   model, kirchhoff   binned      most_theta_r   [deg], bins beyond do not count
[[nodiscard]] Distances distances(const ExactLobe& exact, const std::vector<ProfileLobe>& model,
                                  const std::vector<ProfileLobe>& kirchhoff, double most_theta_r = 90);

/// A case of a set and the distances of the models in it.
struct CaseDistances {
    std::size_t set;  ///< of kept_sets
    RoughnessStatistics surface;
    double theta_i_deg;
    Distances he, unified, smith, he_above,
        unified_above;  ///< "above": 10 degrees and more above the horizon
};
/// Every kept case.
///   cost   a second or two
[[nodiscard]] std::vector<CaseDistances> case_distances();

/// The published model and its successor beside each other, set by set, and the goals of the successor. What
/// is kept is evaluated, nothing is solved.
[[nodiscard]] GroundTruth model_distance_study(Effort effort);

}  // namespace hts::validation
