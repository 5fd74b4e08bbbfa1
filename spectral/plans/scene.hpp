/// What a scene asks of its materials: where from, at which wavelengths, for what purpose and how exactly. It
/// is what spectral/plans/plan.hpp plans for.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spectral/colour/colour.hpp"
#include "spectral/models/material.hpp"
#include "spectral/wavelength_grid.hpp"

namespace hts::spectral {

/// The quantity that must not be wrong by more than the tolerance.
enum class ErrorMeasure {
    relative_brdf_error,  ///< of every spectral value, or Mueller element; see spectral/plans/plan.hpp
    delta_e_2000,         ///< colour difference CIEDE2000 of what a colour sensor sees
};

/// "relative_brdf_error" or "delta_e_2000".
[[nodiscard]] const char* name(ErrorMeasure measure) noexcept;

/// A scene as read by `read_scene`, which guarantees what the members say.
struct Scene {
    std::filesystem::path path;
    std::vector<Material> materials;  ///< at least one, names differ
    WavelengthGrid wavelengths;       ///< within the range of every material unless clamped
    OutsideRange outside_range;
    double largest_theta_i, largest_theta_r;  ///< [rad] polar angles of lights and views, 0 ... pi/2, > 0
    bool polarised;                           ///< Mueller matrices are needed; all materials are of model he
    std::optional<Illuminant> illuminant;     ///< set if the output is colour, not spectra
    ErrorMeasure measure;
    double tolerance;
    std::optional<std::size_t> memory_budget;  ///< [bytes] for all materials together
    bool compensate_energy =
        false;  ///< as spectral/energy/compensation.hpp says; all materials are of model he
    /// Distance from exact scattering [dB] that is allowed to model and arithmetic together; `tolerance` is
    /// what it leaves for arithmetic.
    std::optional<double> true_db{};
};

/// Legal tolerances: relative_brdf_error from accuracy::finest_tolerance to accuracy::coarsest_tolerance;
/// delta_e_2000 from 0.001 to 100. hts::Error outside.
void require_tolerance(ErrorMeasure measure, double tolerance);

/// Reads a scene file (JSON):
///   {"materials": ["aluminium.json", {"name": "glass", "model": "he", …}],
///    "wavelengths_um": "0.4:0.7:31", "output": "spectral", "polarised": false,
///    "largest_theta_i_deg": 80, "largest_theta_r_deg": 80,
///    "tolerance": {"relative_brdf_error": 1e-2}, "memory_budget_bytes": 1000000}
/// "materials" are material files of any model, relative to this file, or their content; "wavelengths_um" is
/// text as WavelengthGrid::parse takes it, or a list; "output" is "spectral" or "rgb", the latter with an
/// optional "illuminant" ("D65" if left out); "tolerance" has one of the keys relative_brdf_error,
/// delta_e_2000, for unpolarised rgb alone, and true_db, as spectral/plans/true_tolerance.hpp says.
/// "outside" (error if left out, hold, zero; "clamp": true is hold) says what stands outside a material's
/// range. "polarised" is false if left out, and without a budget memory does not count. "compensate_energy"
/// (false if left out) is the optional energy compensation, which is not part of the published model. Both
/// are for materials of model he alone. hts::Error "path: key "…": …" names the key and the legal range, or
/// what contradicts what.
///   models   that material files may name
[[nodiscard]] Scene read_scene(const std::filesystem::path& path,
                               const std::vector<ModelEntry>& models = built_in_models());

/// The same of one material, from text without the key "materials".
///   source   what errors call the text
[[nodiscard]] Scene scene_from_text(const std::string& text, const std::string& source, Material material);

/// A checksum, 16 hexadecimal digits, of all that a plan depends on: every member but `path`, and of each
/// material its name, its model, and at the wavelengths and between them: of model he index and albedo (to 12
/// digits) beside the roughness, of others BRDF values of a few directions (to 9, so that another compiler's
/// last bits do not change them). Files may be moved or formatted anew without changing it.
[[nodiscard]] std::string fingerprint(const Scene& scene);

}  // namespace hts::spectral
