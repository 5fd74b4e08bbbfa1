/// BSDF files of Radiance and LBNL WINDOW (XML): one BRDF [1/sr] without the cosine, as means over Klems'
/// patches or as a tensor tree.
///
/// WINDOW's front is the outside: Radiance takes the reflection at the side of the surface normal from
/// "Reflection Back", which is what is written here. The files hold one channel, "Visible", which Radiance
/// takes for luminance (luminance_brdf), or colour: a matrix also "CIE-X" and "CIE-Z", a tree "CIE-u" and
/// "CIE-v", u' and v' of CIE 1976.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tables/formats/radiance/klems.hpp"
#include "tables/formats/radiance/tensor_tree.hpp"

namespace hts::tables {

/// A file's text.
///   brdf       one channel, or Z, Y and X (tristimulus_brdf), which are written as colour; else hts::Error
///   basis      other bases than the full one are written with their definition
///   specular   whether the specular term is added, see klems_means
[[nodiscard]] std::string klems_xml(const spectral::Reflectance& brdf,
                                    const KlemsBasis& basis = KlemsBasis::full(), bool specular = false);

/// A file's text.
///   brdf   one channel, or three as above; else hts::Error
[[nodiscard]] std::string tensor_tree_xml(const spectral::Reflectance& brdf,
                                          const TensorTreeOptions& options = {});

/// A file and what a user should know of it.
struct RadianceFile {
    spectral::Reflectance brdf;
    std::vector<std::string> notes{};     ///< which of its blocks was read, which were not
    std::vector<std::string> channels{};  ///< Y, or Z, Y, X of a file of colour
};

/// The BRDF of a file of either kind, by the rules of Radiance: of the blocks of the wavelength "Visible"
/// that of "Reflection Back", else of "Reflection Front"; names in letters of any case. What stands in front
/// of the first element, a line of a log or a byte order mark, is passed over. Constant in patches or cells;
/// negative values become 0.
///   text         the whole file      name   its path, for messages and as the BRDF's name
/// Bases are taken as the file defines them, else by name.
///   wavelength   what the channels are called; one asks for "Visible" alone. If none is given 0.55 um,
///                of colour rgb_wavelengths
/// hts::Error "path: …" or "path:line: …" where it is no such file, has no such block or several.
/// Entities are not expanded.
[[nodiscard]] RadianceFile radiance_file(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelength = std::nullopt);
/// The same without notes.
[[nodiscard]] spectral::Reflectance radiance_brdf(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelength = std::nullopt);

}  // namespace hts::tables
