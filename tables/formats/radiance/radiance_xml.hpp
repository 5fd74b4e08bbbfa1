/// BSDF files of Radiance and LBNL WINDOW (XML): one BRDF [1/sr] without the cosine, as means over Klems' patches or as a
/// tensor tree.
///
/// WINDOW's front is the outside: Radiance takes the reflection at the side of the surface normal from "Reflection Back", which is
/// what is written here. The files hold one channel, "Visible": Radiance takes it for luminance (luminance_brdf).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tables/formats/radiance/klems.hpp"
#include "tables/formats/radiance/tensor_tree.hpp"

namespace hts::tables {

/// A file's text.
///   brdf   one wavelength, else hts::Error. Radiance loads no file that reflects more than 1.01 of the light of any patch
///          (largest_reflectance)
[[nodiscard]] std::string klems_xml(const spectral::Reflectance& brdf,
                                    const KlemsBasis& basis = KlemsBasis::full());

/// A file's text.
///   brdf   one wavelength, else hts::Error
[[nodiscard]] std::string tensor_tree_xml(const spectral::Reflectance& brdf,
                                          const TensorTreeOptions& options = {});

/// The BRDF of a file of either kind: of its "Reflection Back", else "Reflection Front"; of these "Visible" first. Constant in
/// patches or cells; negative values become 0.
///   text         the whole file      name   its path, for messages and as the BRDF's name
///   wavelength   what the channel is called, one; if none is given 0.55 um
/// hts::Error "path: …" or "path:line: …" where it is no such file. Entities are not expanded.
[[nodiscard]] spectral::Reflectance radiance_brdf(
    std::string_view text, const std::string& name,
    const std::optional<spectral::WavelengthGrid>& wavelength = std::nullopt);

}  // namespace hts::tables
