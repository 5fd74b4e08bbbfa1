/// The formats of other programs that can be written.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"
#include "tables/formats/sidecar.hpp"

namespace hts::tables {

enum class SpecularSpread {
    facets,   ///< as a lobe of facets, whose edge is at the same half vectors for every light
    box,      ///< about the mirror direction
    patches,  ///< by the writer itself, over its patches
};

/// The three channels of a file of colour, linear sRGB or CIE XYZ.
enum class Colour { rgb, xyz };

/// How a user wants a file.
struct ExportDetails {
    /// Over which the specular term is spread in the reflectance or by the writer [sr]; 0 for none.
    double specular_solid_angle = 0;
    double slope = 0;             ///< of the lobe without it (tables/formats/lobe.hpp)
    bool colour = false;          ///< three channels where a format could hold others
    std::string basis = "full";   ///< of Klems: full, half or quarter
    int depth = 0;                ///< of a tensor tree, 0 for its default
    double mirror_azimuth = 180;  ///< of OpenMATERIAL: where azimuths have the mirror direction [deg]
};

/// A format: what is written, and how programs that know it read it.
struct WrittenFormat {
    std::string name;         ///< as --format takes it
    std::string what;         ///< a line of help
    std::string wavelengths;  ///< [um] where the user gives none, as WavelengthGrid::parse takes them
    /// What is to stand in the file, and in those beside it, for write_with_sidecar.
    std::function<Exported(const spectral::Reflectance& brdf, const std::string& path,
                           const ExportDetails& details)>
        exported;
    /// What a reader makes of those files, with the interpolation of the programs that read them.
    std::function<spectral::Reflectance(const Exported& files)> read;
    /// What of a reflectance the file can hold at all without --colour, which is written and compared: none
    /// for all of it, or, say, luminance.
    std::function<spectral::Reflectance(const spectral::Reflectance& brdf)> as_held{};
    Colour colour = Colour::rgb;  ///< which three channels a file of colour has
    bool colour_alone = false;    ///< whether it holds nothing else
    /// What of FileRequest means something here: "colour", "basis", "depth", "mirror-azimuth".
    std::vector<std::string> takes{};
    /// How the specular term is spread, as the format's grid can hold it.
    SpecularSpread spread = SpecularSpread::facets;
    bool holds_specular = false;  ///< as a function of its own, so that nothing need be spread
};

/// A reflectance as colour under D65: three wavelengths as blue, green and red, three channels as what they
/// are, more wavelengths as the eye sees them.
///   channels   of the reflectance, none if it has wavelengths
[[nodiscard]] spectral::Reflectance as_colour(const spectral::Reflectance& brdf, Colour wanted,
                                              const std::vector<std::string>& channels);

/// A line per format.
[[nodiscard]] const std::vector<WrittenFormat>& written_formats();

}  // namespace hts::tables
