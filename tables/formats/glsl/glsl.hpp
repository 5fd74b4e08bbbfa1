/// A material as functions of a shading language, GLSL ES 3.00 for WebGL 2, OpenGL ES 3 and OpenGL 3.3, or
/// WGSL for WebGPU: text that needs no texture, no buffer and no other file.
///
/// The text holds the whole model in single precision (he_torrance.glsl: Phi by its terms below g = 6, above
/// by 35 coefficients about its saddle point), then the constants of one material at its wavelengths. Of the
/// model alone:
///
///     float hts_he_brdf(vec3 wi, vec3 wo, float wavelength, float sigma0, float tau, float n, float k,
///                       float albedo)
///     float hts_he_specular(vec3 wi, float wavelength, float sigma0, float tau, float n, float k)
///     HtsDraw hts_he_sample(vec3 wi, vec3 u, float wavelength, …)
///     float hts_he_pdf(vec3 wi, vec3 wo, float wavelength, …)
///
/// whose arguments may be uniforms, and of the material, with the index of a wavelength:
///
///     float hts_brdf(vec3 wi, vec3 wo, int w)         float hts_specular(vec3 wi, int w)
///     HtsDraw hts_sample(vec3 wi, vec3 u, int w)      float hts_pdf(vec3 wi, vec3 wo, int w)
///     vec3 hts_brdf_rgb(vec3 wi, vec3 wo)             vec3 hts_specular_rgb(vec3 wi)
///
/// The last two, linear sRGB under D65, are there where the wavelengths have a colour: three as blue, green
/// and red, or those that cover 0.40 ... 0.70 um.
#pragma once

#include <string>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::accuracy {
/// Of the shader's BRDF against the model for directions rounded to single precision, relative, where 0.003
/// <= sigma_0/tau <= 1, both polar angles are at most 89 degrees and the value exceeds `shader_floor` of what
/// the surface reflects at most from that light.
inline constexpr double shader = 1e-3;
inline constexpr double shader_floor = 1e-6;
}  // namespace hts::accuracy

namespace hts::tables {

/// Most wavelengths of a shader: 64.
inline constexpr std::size_t most_shader_wavelengths = 64;

/// The text.
///   brdf   of the model he at 1 ... most_shader_wavelengths wavelengths, else hts::Error
[[nodiscard]] std::string glsl_text(const spectral::Reflectance& brdf);
[[nodiscard]] std::string wgsl_text(const spectral::Reflectance& brdf);
/// The same with what stands beside it.
[[nodiscard]] Exported exported_glsl(const spectral::Reflectance& brdf, const std::string& path);
[[nodiscard]] Exported exported_wgsl(const spectral::Reflectance& brdf, const std::string& path);

/// What the text computes, in single precision: its constants are read, its functions are
/// those hts was built with.
///   text   by glsl_text or wgsl_text, else hts::Error      name   its path, for messages
[[nodiscard]] spectral::Reflectance shader_brdf(const std::string& text, const std::string& name);

}  // namespace hts::tables
