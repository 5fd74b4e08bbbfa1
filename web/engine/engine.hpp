// The engine as the page asks it: a request is JSON with numbers beside it, an answer
// JSON with numbers beside it.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "spectral/models/material.hpp"

namespace hts::page {

using nlohmann::json;

/// The numbers of a request: pairs of directions, curves.
struct Numbers {
    std::span<const double> in;
    std::span<double> out;

    /// hts::Error unless there are as many.
    void require(std::size_t in_count, std::size_t out_count) const;
};

/// A material at wavelengths, from the request's "material", "wavelengths" [um] and "tolerance"; kept, since
/// the next request will mostly ask for the same.
[[nodiscard]] const spectral::Reflectance& reflectance_of(const json& request);
[[nodiscard]] const spectral::Material& material_of_request(const json& request);
/// Draws directions at the middle one of those wavelengths; kept too.
[[nodiscard]] const spectral::Sampler& sampler_of(const json& request);

/// "forget": materials are made anew, since a file was replaced.
[[nodiscard]] json forget();

/// Pairs of triples theta_i, theta_r, phi_r [deg]; the light is at azimuth 0.
[[nodiscard]] DirectionPair pair_at(std::span<const double> triples, std::size_t index);

/// Answers one request; hts::Error says what is wrong with it.
[[nodiscard]] json answer(const json& request, const Numbers& numbers);

/// "fit": heights and correlation length, and the albedo if "albedo" is true, nearest to measured points.
///   in   theta_i, theta_r, phi_r [deg], wavelength [um], BRDF [1/sr] of each point
[[nodiscard]] json fit(const json& request, const Numbers& numbers);
/// "match": the width with which the lobe of the material "beside" is nearest to that of "material", for
/// light at "theta_i_deg"; "keys" point to where it holds its width, and "exponents" to where an
/// exponent n of the cosine says it, 2/width^2. The distance is the rms difference of f
/// cos theta_r over that of the lobe itself.
[[nodiscard]] json match(const json& request);
/// "curve": the points of a file of measured values, "text", of "file": a table of FRED, whose azimuths have
/// the mirror direction at "mirror_azimuth_deg", an ASTM scatter file, one of LightTools or BiRD, or CSV.
/// Values of a file that names no wavelength are at "wavelength_um".
[[nodiscard]] json curve(const json& request);
/// Whether a text is one of these, CSV apart.
[[nodiscard]] bool is_scatter_file(const std::string& text);
/// "picture": what pixels of a lit object send to the viewer, as colours, the sums of what is at each
/// wavelength with "weights", three for each.
///   in    of a pixel the directions of the viewer and of the lamp in the frame of its surface, x y z each,
///         and three random numbers
///   out   of a pixel three colours, the BRDF for the lamp [1/sr], the specular reflectance, and f cos/pdf of
///         a direction drawn from the diffuse terms; then that direction, x y z, 0 where none was drawn
[[nodiscard]] json picture(const json& request, const Numbers& numbers);

}  // namespace hts::page
