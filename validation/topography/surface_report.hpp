/// What a study of maps found, as text, JSON, tables, a picture and a material file.
#pragma once

#include <string>
#include <string_view>

#include "spectral/output/figure.hpp"
#include "validation/topography/surface_study.hpp"

namespace hts::validation {

[[nodiscard]] std::string surface_text(const SurfaceStudy& study);
[[nodiscard]] std::string surface_json(const SurfaceStudy& study);

/// Spectra over directions, with every fit beside them: frequency [1/um], S2 [um^4]; and S1 [um^3] of
/// profiles along x and y of the first map; autocorrelation over distance [um]. Named as their files are.
[[nodiscard]] output::FigureTable radial_table(const SurfaceStudy& study);
[[nodiscard]] output::FigureTable profile_table(const SurfaceStudy& study, bool along_x);
[[nodiscard]] output::FigureTable autocorrelation_table(const SurfaceStudy& study);

/// The first map, how its heights are distributed, spectra and autocorrelation.
[[nodiscard]] output::Figure surface_figure(const SurfaceStudy& study);

/// The measured radial spectrum between the frequencies that the maps know, without the noise of a fit, as a
/// file for {"type": "psd", "file": …}, with the standard errors that so few frequencies and the noise leave;
/// beyond its last frequency the material goes on by a power law.
[[nodiscard]] std::string spectrum_file(const SurfaceStudy& study, const SpectrumFit& fit);

/// A material of this roughness.
///   description     of `fit`, or "measured": the spectrum of `spectrum_path`, which spectrum_file writes
///   index           JSON of the optical constants
/// rms_roughness_um is that of the periods that the maps know, "rms_band_um"; what the description says of
/// others is extrapolated, which the name says. hts::Error where directions differ and the description has
/// one length for all.
[[nodiscard]] std::string surface_material(const SurfaceStudy& study, const SpectrumFit& fit,
                                           const std::string& index, const std::string& spectrum_path = "");

/// A fit of its name, or the best for "best"; hts::Error that lists them otherwise.
[[nodiscard]] const SpectrumFit& fit_named(const SurfaceStudy& study, std::string_view name);

}  // namespace hts::validation
