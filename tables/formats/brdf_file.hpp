/// Reflectance from the files of other programs and of instruments, whatever the format.
///
///     const auto nickel = hts::tables::read_brdf("nickel.binary");
///
/// A file is recognised by what it begins with: MERL (merl.hpp), RGL's tensor file
/// (rgl.hpp) and KAIST's polarised one (pbsdf.hpp), OpticStudio's tabular `.bsdf` (zemax.hpp) and the index
/// of several of them, Radiance's and WINDOW's XML (radiance_xml.hpp), those of LightTools,
/// FRED's and TracePro's tables, OpenMATERIAL 3D, BiRD, ASTM scatter files and CSV (points/).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// What a reader made of a file.
struct BrdfFile {
    spectral::Reflectance brdf;
    std::string format;              ///< "merl", …
    std::vector<std::string> notes;  ///< what a user should know of it, a line each
    /// What its wavelengths stand for: B, G, R or Z, Y, X or Y; none if they are wavelengths.
    std::vector<std::string> channels{};
    /// A material file that says the same by a model, where a file holds what a model needs: the BRDF is then
    /// that of this material.
    std::string material{};
};

/// What a user knows of a file that it may not say itself.
struct BrdfReading {
    std::optional<spectral::WavelengthGrid> wavelengths{};  ///< what the channels are called [um]
    std::string format{};                                   ///< its name; "" to recognise it
    /// Of FRED's tables, OpenMATERIAL and BiRD: where azimuths have the mirror direction [deg], 0 or 180; if
    /// not given, 0 in FRED's and 180 in others. Of TracePro's: which azimuth about the mirror direction
    /// points away from the normal; 0 if not given.
    std::optional<double> mirror_azimuth{};
};

/// A format that can be read.
struct BrdfFormat {
    std::string name;
    std::string what;  ///< a line of help
    std::function<bool(std::string_view bytes, const std::filesystem::path& path)> recognised;
    ///   bytes   the whole file      path   where it stood
    std::function<BrdfFile(std::string bytes, const std::filesystem::path& path, const BrdfReading& how)>
        read;
};

/// A line per format; the first that recognises a file reads it.
[[nodiscard]] const std::vector<BrdfFormat>& readable_formats();

/// Reads a file, or a pipe. The last note says which wavelengths, angles and share of the hemisphere it
/// covers. hts::Error "path: …", with line or offset where there is one, if it cannot be read, no format
/// recognises it or it is damaged.
[[nodiscard]] BrdfFile read_brdf(const std::filesystem::path& path, const BrdfReading& how = {});

}  // namespace hts::tables
