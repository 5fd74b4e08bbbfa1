/// Reflectance from the files of other programs and of instruments, whatever the format.
///
///     const auto nickel = hts::tables::read_brdf("nickel.binary");
///
/// A file is recognised by what it begins with: MERL (merl.hpp), RGL's tensor file
/// (rgl.hpp), OpticStudio's tabular `.bsdf` (zemax.hpp) and the index of several
/// of them, Radiance's and WINDOW's XML (radiance_xml.hpp), ASTM scatter files and CSV (scatter_points.hpp).
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
};

/// A format that can be read.
struct BrdfFormat {
    std::string name;
    std::string what;  ///< a line of help
    ///   head   the first 4096 bytes, or all
    std::function<bool(std::string_view head, const std::filesystem::path& path)> recognised;
    ///   wavelengths   what the channels are called, if the user says so
    std::function<BrdfFile(const std::filesystem::path& path,
                           const std::optional<spectral::WavelengthGrid>& wavelengths)>
        read;
};

/// A line per format; the first that recognises a file reads it.
[[nodiscard]] const std::vector<BrdfFormat>& readable_formats();

/// Reads a file.
///   wavelengths   what its channels are called [um], needed where the file does not say
///   format        name of its format, "" to recognise it
/// hts::Error "path: …", with line or offset where there is one, if no format recognises it or it is damaged.
[[nodiscard]] BrdfFile read_brdf(const std::filesystem::path& path,
                                 const std::optional<spectral::WavelengthGrid>& wavelengths = std::nullopt,
                                 std::string_view format = "");

}  // namespace hts::tables
