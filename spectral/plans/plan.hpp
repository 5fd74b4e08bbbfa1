/// Plans: for every material of a scene the cheapest evaluator that is exact enough, as measured.
///
/// The planner walks a ladder of evaluators, cheapest first. Of model he: the directional-diffuse lobe left
/// out, to first order in g, in the limit of rough surfaces, or in full at a tolerance; the specular term
/// left out or kept; and, unless the scene is polarised, fewer wavelengths than the scene's, between which
/// the spectrum is interpolated. Of other models: the uniform-diffuse part alone, or all of it, at one, few
/// or all wavelengths. It takes the first whose error, measured on random directions of the scene against the
/// full model at accuracy::finest_tolerance, is at most `plan_headroom` times the tolerance. Order and choice
/// depend on the scene and the seed alone. Whether a lookup table is cheaper is a matter of the machine: `hts
/// plan --tables` builds one for each material, measures its error and its time, and puts it in the model's
/// place where both are better.
///
/// Where waves do not matter (g >> 1), the rough limit is the geometric-optics rung: there the He-Torrance
/// lobe is that of Beckmann-distributed facets, hts::WalterBrdf with alpha = 2 sigma/tau times its own
/// shadowing. No other model stands in.
///
/// Errors of a pair of directions, the worst over wavelengths and terms:
///   relative_brdf_error   diffuse terms   |f - f_full| / (f_full + `floor_of_peak` f_peak), f_peak
///                         the lobe's largest value
///                                         in the scene for that theta_i and wavelength: the far tail of a
///                                         lobe counts as much as it is seen. Polarised: the largest
///                                         difference of Mueller elements over m00 + `floor_of_peak` f_peak
///                         specular term     |rho - rho_full| / (|F|^2 S + a), the share of all
///                                           that is reflected, since
///                                         mirror and lobe together reflect |F|^2 S (with energy compensation
///                                         rho has its factor, |F|^2 S has not)
///   delta_e_2000          CIEDE2000 between the colours of the radiance factors pi f, and between those of
///                         the specular term's reflectance, which is how white surroundings look in it. The
///                         white is the perfect diffuser under the scene's illuminant; where a highlight is
///                         brighter, both colours are exposed so that the brighter one has
///                         the luminance of that white
///
/// Directions: half of the pairs uniform in solid angle over the scene's cap of lights and that of views,
/// half with the view in the lobe (of model he about the mirror direction, of others as the model draws), and
/// a few at the edges of the caps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spectral/plans/planned_reflectance.hpp"
#include "spectral/plans/scene.hpp"

namespace hts::spectral {

/// Share of the tolerance that a measured error may use up; the rest is for directions not drawn.
inline constexpr double plan_headroom = 0.8;
/// Weight of the lobe's peak in the denominator of the relative error.
inline constexpr double floor_of_peak = 1e-3;

/// Random pairs on which a material is measured.
struct PlanSampling {
    std::uint64_t seed = 1;    ///< 0 ... 2^53, else hts::Error where it is used
    std::size_t pairs = 8192;  ///< 1 ... 10^7, else hts::Error where it is used
};

/// Errors over the pairs; what they are of says the scene's ErrorMeasure.
struct MeasuredError {
    double worst;
    double percentile_99;
};

/// An evaluator that was measured.
struct MeasuredRung {
    Rung rung;
    MeasuredError error;
};

/// The choice for one material.
struct PlannedMaterial {
    std::string name;
    MeasuredRung choice;
    /// What failed before: of each lobe form, with and without specular term, the rung of the most
    /// wavelengths that was still cheaper than the choice.
    std::vector<MeasuredRung> rejected;
    PlannedForm form;  ///< of the choice
};

struct Plan {
    Scene scene;
    double tolerance;  ///< in the scene's measure
    PlanSampling sampling;
    std::vector<PlannedMaterial> materials;  ///< in the scene's order

    /// One per material, on the scene's wavelengths.
    [[nodiscard]] std::vector<Reflectance> reflectances() const;
    /// Memory of the evaluators together with the tables of Phi that they share.
    [[nodiscard]] std::size_t bytes() const;
};

/// The full model of a material in a scene: what plans are measured against.
[[nodiscard]] PlannedForm full_model(const Scene& scene, const Material& material);

/// Plans a scene.
///   tolerance   instead of the scene's, in its measure
/// hts::Error if the cheapest plan takes more than the scene's memory budget; it says how much.
[[nodiscard]] Plan make_plan(const Scene& scene, const PlanSampling& sampling, double tolerance);

/// Measures an evaluator as the planner does.
[[nodiscard]] MeasuredError measured_error(const Scene& scene, const Material& material,
                                           const PlannedForm& form, const PlanSampling& sampling);

/// Measures the evaluators of a plan again, on other directions.
[[nodiscard]] std::vector<MeasuredError> measured_errors(const Plan& plan, const PlanSampling& sampling);

/// Opens a file that holds a reflectance: tables, which this module knows nothing of, come in this way.
/// hts::Error names the file and both checksums where the file's is not `checksum`, that of Rung::table.
using OpenTable = std::function<Reflectance(const std::filesystem::path& file, const std::string& checksum)>;

/// A plan as JSON, for a file in `folder`, from which the scene's path is relative. The same
/// plan gives the same bytes.
[[nodiscard]] std::string plan_text(const Plan& plan, const std::filesystem::path& folder);

/// Reads a plan file and the scene that it names. hts::Error "path: key "…": …" if it was made by another
/// version of format or library, or if the scene, its materials or a table have changed since.
///   models       that material files may name
///   open_table   reads the tables that the plan names, hts::tables::open_for_plan; without
///                it such plans are refused
[[nodiscard]] Plan read_plan(const std::filesystem::path& path,
                             const std::vector<ModelEntry>& models = built_in_models(),
                             const OpenTable& open_table = {});

}  // namespace hts::spectral
