/// Reflectances as files of the RGL group's measurements (`.bsdf`): Mitsuba 3 (`measured`), pbrt-v4
/// (`Material "measured"`) and powitacq read them; spectral, or of three channels for the RGB variants of
/// Mitsuba, unpolarised, front side only, no specular term.
///
/// A file holds f cos(theta_o), not f [Dupuy18]. Half vectors m are points (u, v) of a square, u = sqrt(2
/// theta_m/pi), v = (phi_m - phi_i + pi)/(2 pi); per angle of incidence a density over that square (`vndf`)
/// warps it to another one, s, on which the values lie:
///
///   f cos(theta_o) = spectra(theta_i, wavelength; s(m)) ndf(u, v)/(4 sigma(theta_i))
///   pdf = vndf(u, v) luminance(s)/(2 pi^2 u sin(theta_m) 4 (w_i.m))
///
/// everything linear between nodes, in single precision. The writer takes for `vndf` the light that a facet m
/// sends to the viewer, so that nodes and samples are where light is, whatever the width of the lobe. Nothing
/// is negative, since readers do not clamp what they interpolate: f cos(theta_o) is 0 from the horizon on,
/// and the horizon stands on the same column of the warped square for every azimuth and angle of incidence,
/// so that it stays there between them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/round_trip.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::tables {

namespace accuracy {
/// Of a file that write_rgl made as fine as it must be, read back up to 88 degrees, in parts of the peak.
inline constexpr double rgl = 0.02;
}  // namespace accuracy

/// How finely a file samples; its size is close to 4 theta_i phi_i (wavelengths resolution^2 +
/// azimuths elevations) bytes.
struct RglResolution {
    int theta_i;     ///< angles of incidence, 2 ... 256
    int resolution;  ///< of the warped square, along either side, 2 ... 1024
    int azimuths;    ///< of the warp, rows, 2 ... 1024
    int elevations;  ///< of the warp, columns, 8 ... 4096
    /// azimuths of incidence from -180 to 180 deg, 5 ... 361; of an isotropic reflectance there is one
    int phi_i = 25;
};

/// What a reader of the file evaluates: BRDF and density, of directions on the front side.
class RglBrdf : public spectral::Evaluator, public HasDensity {
  public:
    /// A direction drawn as the readers draw it, with its density [1/sr]; may point below the
    /// horizon, with density 0.
    struct Draw {
        Vector3 out;
        double density;
    };
    [[nodiscard]] virtual Draw sample(const Direction& in, double u1, double u2) const noexcept = 0;

  protected:
    using spectral::Evaluator::Evaluator;
};

/// Writes a reflectance, with azimuths of incidence where it is anisotropic; hts::Error where
/// the file cannot be written.
///   specular_solid_angle   of with_specular_lobe, if that was applied [sr]: then nodes are set
///                          where that lobe is; else 0
void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path,
               const RglResolution& resolution, double specular_solid_angle = 0);
/// The same as finely as it must be: each try is read back at random pairs of directions, and if the worst
/// error is above 1.2 % of the peak the next is finer, twice at most. On other pairs it is below
/// accuracy::rgl for the surfaces of the tests. An anisotropic reflectance is written once, at 36 polar
/// angles and 25 azimuths of the light: some 40 MB.
void write_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path);
/// What a file's channels are.
enum class RglChannels {
    spectra,  ///< values at wavelengths
    /// three, which a reflectance has as blue, green and red (linear_srgb_brdf), for Mitsuba's RGB variants
    rgb,
};

/// The pairs of directions at which it does so.
inline const RoundTripOptions rgl_comparison{200000, 0};
/// What that writes, and the sidecar.
[[nodiscard]] Exported exported_rgl(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                                    const RoundTripOptions& compared = rgl_comparison,
                                    RglChannels channels = RglChannels::spectra);

/// Reads a file of spectra (`spectra`, `wavelengths`) or of three channels (`rgb`, which get rgb_wavelengths
/// for names), isotropic or anisotropic over all azimuths; its specular reflectance is 0.
/// hts::Error "path: field "vndf": …" for what Mitsuba and pbrt would refuse or what is no number.
[[nodiscard]] std::unique_ptr<RglBrdf> read_rgl(const std::filesystem::path& path);
/// The same from memory.    path   for messages and the name
[[nodiscard]] std::unique_ptr<RglBrdf> parse_rgl(std::string bytes, const std::filesystem::path& path);

/// Whether a file of this format has three channels without wavelengths.
///   head   how it begins
[[nodiscard]] bool is_rgb_rgl(std::string_view head);

}  // namespace hts::tables
