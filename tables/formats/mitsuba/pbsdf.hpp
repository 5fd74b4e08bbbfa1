/// Mueller matrices as files of the KAIST polarised measurements (`.pbsdf`, [Baek20]): Mitsuba 3 reads them
/// (`measured_polarized`, in its `*_spectral_polarized` variants); five wavelengths, isotropic, front
/// side only, no specular term.
///
/// A file holds the Mueller matrix of the BRDF [1/sr], without the cosine, over theta_h, theta_d, phi_d of
/// the half vector, multilinear between the nodes: with h the half vector of light w_L and view w_V, b =
/// z x h/|z x h|, t = b x h,
///   cos theta_h = h.z,   w_L = cos theta_d h + sin theta_d p,   p = cos phi_d t + sin phi_d b
/// Frames: right-handed, z along the propagation, x_in = x_out = w_L x w_V/|w_L x w_V| = p x h, S3 = +1
/// clockwise for the receiver. Where a direction would lie below the horizon the matrix of the horizon
/// stands, so that nothing is lost in front of it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::tables {

/// Number of nodes along each axis, 2 ... 1024; a node takes 320 bytes.
struct PbsdfResolution {
    int theta_h = 61;  ///< crowded towards 0 according to the width of the lobe
    int theta_d = 61;  ///< crowded towards 90 degrees
    int phi_d = 49;    ///< -180 to 180 degrees
};

/// Writes an isotropic, polarised reflectance at five wavelengths of whole nanometres; hts::Error for others,
/// or where the file cannot be written.
void write_pbsdf(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                 const PbsdfResolution& resolution = {});
/// What that writes, and the sidecar.
[[nodiscard]] Exported exported_pbsdf(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                                      const PbsdfResolution& resolution = {});

/// Reads a file as a polarised reflectance, in the frames of hts/polarisation.hpp; its specular reflectance
/// is 0. Where the file has no number, as measurements do, it is black. hts::Error "path: field "M": …" for
/// what Mitsuba would refuse.
[[nodiscard]] spectral::Reflectance read_pbsdf(const std::filesystem::path& path);
/// The same from memory.    path   for messages and the name
[[nodiscard]] spectral::Reflectance parse_pbsdf(std::string bytes, const std::filesystem::path& path);

}  // namespace hts::tables
