/// Optical constants from files and from the library's own collection.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/materials/optical_constants.hpp"

namespace hts::spectral {

/// OpticalConstants from a file, by its ending:
///   .yml .yaml   refractiveindex.info database: formulas 1 to 9, tabulated nk, n, k; n from the first item
///                of DATA that gives n, k from the first that gives k, with a warning of later ones;
///                tabulated n2 is passed over. A row that is no refractive index is a warning, and an error
///                where it is asked for
///   .csv .txt    header `wavelength_um,n,k` or `wavelength_nm,n,k` (k may be left out), `#` comment lines,
///                in any dialect of csv.hpp; or as the database's website writes them, `wl,n` [um] and below
///                it `wl,k`; .txt without a header: rows of um, n and perhaps k, or (n,k) in brackets
///   .spd         pairs of nm and n; k from the file beside it that is called k where this one is called eta
///   .json        {"table": [[um, n, k], …]} with optional "name" and "source"
/// Rows may be unsorted; rows with the same wavelength are averaged. The name is the path, the source what
/// the file says of it, else the path. Throws hts::Error "path: …" or "path:line: …", for rows with n <= 0
/// or k < 0 too.
[[nodiscard]] OpticalConstants read_optical_constants(const std::filesystem::path& path);

/// Names of the materials that come with the library, sorted: "Ag", "Al", …
[[nodiscard]] std::vector<std::string> optical_constants_names();

/// One of them; hts::Error that lists the names otherwise.
[[nodiscard]] OpticalConstants built_in_optical_constants(std::string_view name);

}  // namespace hts::spectral
