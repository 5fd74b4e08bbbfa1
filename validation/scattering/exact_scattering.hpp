/// How far the model is from exact scattering. The map over sigma_0/lambda, tau/lambda and theta_i, in dB,
/// from the method of moments (`moment_method`).
#pragma once

#include "validation/scattering/ground_truth.hpp"
#include "validation/scattering/moment_method.hpp"

namespace hts::validation {

/// Surfaces of the map, lengths in wavelengths, sigma_0/tau at most 1/2; a few of them for a quick look.
[[nodiscard]] std::vector<RoughnessStatistics> moment_grid(Effort effort);

/// One row per surface and angle of incidence: energy and mirror of the exact solution, and for each model
/// the distances from it in dB, columns "he_torrance_te_db", "he_torrance_db" (unpolarised) and so on.
///   stem   of the table
[[nodiscard]] FigureTable moment_map_table(const std::vector<MomentResult>& results, std::string stem);
/// One row per angle of scattering, the lobes themselves, exact and by Kirchhoff's currents; those of models
/// in unpolarised light, and on a ground this model's in TE and TM too.
[[nodiscard]] FigureTable moment_lobe_table(const std::vector<MomentResult>& results, std::string stem);

/// That what is scattered, passes the ends and enters the ground is all that falls in, to 1 %, in TE and in
/// TM.
[[nodiscard]] std::vector<Check> energy_checks(const FigureTable& map);
/// A model is to be within 0.6 dB of exact in unpolarised light, tau >= 2 lambda, theta_i up to 60 degrees:
/// of a map and its lobes. Missed where no row of the map is in that region. Within 10 degrees of the horizon
/// the exact TM lobe is up to 1 dB low: light that is 11 to 27 % of what is left there passes the ends of the
/// profile, while an infinite surface would keep it.
struct Trend {
    const char* title;           ///< "this model"
    const char* model;           ///< "he_torrance"
    double most_slope_deg = 20;  ///< of the rms slope
    double most_theta_r = 90;    ///< angles of scattering that count
};
[[nodiscard]] Check trend_check(const std::vector<FigureTable>& tables, const Trend& of);
/// That this model is nearer to exact than Kirchhoff without shadowing, in unpolarised light, in every row of
/// a map; on conductors it is not, on glass it is.
///   title   "this model"      remark   why
[[nodiscard]] Check nearer_check(const FigureTable& map, const std::string& title, const std::string& remark);
/// Checks of a map and its lobes, the two tables, against what is claimed of them.
[[nodiscard]] std::vector<Check> moment_checks(const std::vector<FigureTable>& tables);
/// The map as a picture, a panel per model and angle.
[[nodiscard]] Figure moment_map_figure(const FigureTable& map);

/// Which lobes of a table are drawn, those that it has.
struct LobePanels {
    std::string what;  ///< "perfectly conducting"
    std::vector<RoughnessStatistics> surfaces;
    std::vector<double> theta_i_deg;
    bool polarised = false;  ///< this model in TE and TM, in place of the three models
};
/// Lobes against their closed forms.
[[nodiscard]] Figure moment_lobe_figure(const FigureTable& lobes, const LobePanels& wanted);

/// First line of a provenance: "Exact scattering by random profiles, perfectly conducting: …".
[[nodiscard]] std::string moment_provenance(const std::string& what, const MomentSettings& settings);

/// Solves the surfaces of the grid. Quick: 3 surfaces, 40 realisations; full: all, 250 realisations.
///   unfinished   as of moment_results
[[nodiscard]] GroundTruth exact_scattering_study(Effort effort, const std::string& unfinished = {});
/// Its section; quick shows the kept map as well.
[[nodiscard]] Section exact_scattering_section(Effort effort);

}  // namespace hts::validation
