#include "tables/formats/writers/write_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/lobe.hpp"
#include "tables/formats/specular_box.hpp"

namespace hts::tables {
namespace {

using spectral::Reflectance;

bool in_colour(const WrittenFormat& format, bool colour) {
    return colour || format.colour_alone;
}

bool takes(const WrittenFormat& format, const char* detail) {
    return std::ranges::find(format.takes, detail) != format.takes.end();
}

/// Where the user gives none.
std::string default_wavelengths(const WrittenFormat& format, bool colour) {
    const bool one = format.wavelengths.find(':') == std::string::npos;
    return colour && one ? "0.40:0.70:31" : format.wavelengths;
}

std::string name_of(SpecularSpread spread, double solid_angle) {
    if (spread == SpecularSpread::patches) return "spread over the patch that mirrors the light's";
    const std::string box = "a box of " + shortest(solid_angle) + " sr";
    return spread == SpecularSpread::box ? box : "spread over facets, at the normal as high as " + box;
}

/// hts::Error if a reader of the file gains or loses light.
void require_held(const FileRequest& request, const WrittenFormat& format, const RoundTrip& report) {
    constexpr double most_lost = 0.02, degree = std::numbers::pi / 180, largest_theta = 76 * degree;
    for (const auto& each : report.albedo) {
        if (each.theta_i > largest_theta || std::abs(each.read_back - each.original) <= most_lost) continue;
        throw Error{request.path + ": would reflect " + spectral::brief(each.read_back) + " for " +
                    spectral::brief(each.original) + " at theta_i " + spectral::brief(each.theta_i / degree) +
                    " deg, " + shortest(each.wavelength_um) +
                    " um, as its readers take it: the grid of format " + format.name +
                    " does not hold a box of " + shortest(*request.specular_spread) +
                    " sr; give a larger solid angle or leave the specular term out"};
    }
}

}  // namespace

const WrittenFormat& written_format(const std::string& name) {
    std::string names;
    for (const WrittenFormat& format : written_formats()) {
        if (format.name == name) return format;
        names += (names.empty() ? "" : ", ") + format.name;
    }
    throw Error{"format \"" + name + "\": must be one of " + names};
}

std::optional<std::string> not_taken(const FileRequest& request, const WrittenFormat& format) {
    if (request.colour && !takes(format, "colour")) return "colour";
    if (request.basis && !takes(format, "basis")) return "basis";
    if (request.depth && !takes(format, "depth")) return "depth";
    if (request.mirror_azimuth && !takes(format, "mirror-azimuth")) return "mirror-azimuth";
    if (request.specular_spread && format.holds_specular) return "specular";
    return std::nullopt;
}

spectral::WavelengthGrid wavelengths_to_write(const spectral::Material& material, const WrittenFormat& format,
                                              bool colour) {
    const auto& channels = material.properties().channels;
    const bool coloured = in_colour(format, colour);
    if (!coloured && channels.size() > 1 && takes(format, "colour"))
        throw Error{material.name() + ": holds the channels " + spectral::joined(channels) +
                    ": must be written with --colour"};
    if (!coloured || channels.size() == 1) require_spectrum(material);
    return spectral::WavelengthGrid::parse(channels.empty() ? default_wavelengths(format, colour)
                                                            : "0.46,0.55,0.62");
}

Source source_to_write(const spectral::Material& material, const spectral::WavelengthGrid& wavelengths,
                       spectral::OutsideRange policy) {
    // far finer than any of these files holds
    return {material.at(wavelengths, {.tolerance = Tolerance{1e-6}, .outside = policy}),
            material.properties().channels};
}

RoundTrip write_brdf(const Source& source, const WrittenFormat& format, const FileRequest& request) {
    if (const auto what = not_taken(request, format))
        throw Error{*what + ": must not come with format " + format.name};
    const auto held = [&](const Reflectance& brdf) {
        if (in_colour(format, request.colour)) return as_colour(brdf, format.colour, source.channels);
        return format.as_held ? format.as_held(brdf) : brdf;
    };
    const bool patches = format.spread == SpecularSpread::patches;
    Reflectance spread = source.brdf;
    if (request.specular_spread) {
        spread = format.spread == SpecularSpread::box
                     ? with_specular_box(source.brdf, *request.specular_spread)
                     : with_specular_lobe(source.brdf, *request.specular_spread);
    }
    const Reflectance brdf = held(spread);
    ExportDetails details{.specular_solid_angle = request.specular_spread.value_or(0),
                          .slope = lobe_slope(source.brdf),
                          .colour = request.colour};
    details.basis = request.basis.value_or(details.basis);
    details.depth = request.depth.value_or(details.depth);
    details.mirror_azimuth = request.mirror_azimuth.value_or(details.mirror_azimuth);
    Exported exported = format.exported(patches ? held(source.brdf) : brdf, request.path, details);
    auto report = round_trip(brdf, format.read(exported),
                             {request.pairs, request.seed, details.slope, details.specular_solid_angle});
    if (request.specular_spread) {
        if (!patches) require_held(request, format, report);
        exported.sidecar.specular = "in the file, " + name_of(format.spread, *request.specular_spread);
    }
    write_with_sidecar(request.path, source.brdf, std::move(exported));
    return report;
}

}  // namespace hts::tables
