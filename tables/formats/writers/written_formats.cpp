#include "tables/formats/writers/written_formats.hpp"

#include "tables/formats/channels.hpp"
#include "tables/formats/glsl/glsl.hpp"
#include "tables/formats/merl.hpp"
#include "tables/formats/mitsuba/pbsdf.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/points/bird.hpp"
#include "tables/formats/points/lighttools.hpp"
#include "tables/formats/points/open_material.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/zemax.hpp"

namespace hts::tables {
namespace {

using spectral::Reflectance;

const spectral::TextFile& only_file(const Exported& exported) {
    return exported.files.front();
}

Reflectance rgl_as_read(const Exported& exported) {
    return Reflectance{parse_rgl(only_file(exported).text, only_file(exported).path)};
}

Reflectance pbsdf_as_read(const Exported& exported) {
    return parse_pbsdf(only_file(exported).text, only_file(exported).path);
}

// The value of a bin, as most readers do.
Reflectance merl_as_read(const Exported& exported) {
    return merl_brdf(only_file(exported).text, only_file(exported).path, rgb_wavelengths(), MerlLookup::bins);
}

Reflectance zemax_as_read(const Exported& exported) {
    std::vector<Reflectance> parts;
    for (const auto& file : exported.files)
        if (!file.path.ends_with(".json")) parts.push_back(zemax_brdf(file.text, file.path));
    return parts.size() == 1 ? parts.front() : joined(exported.files.back().path, std::move(parts));
}

Reflectance radiance_as_read(const Exported& exported) {
    return radiance_brdf(only_file(exported).text, only_file(exported).path);
}

Reflectance astm_as_read(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return brdf_from(path, points_of_astm(text, path)).brdf;
}

Reflectance csv_as_read(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return brdf_from(path, points_of_csv(text, path)).brdf;
}

Reflectance lighttools_as_read(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return brdf_from(path, points_of_lighttools(text, path, std::nullopt)).brdf;
}

// Its BRDF stands in the last of its files; azimuths as they were written.
Reflectance open_material_as_read(const Exported& exported) {
    const auto& [path, text] = exported.files.back();
    return brdf_from(path, points_of_open_material(text, path, std::nullopt, exported.mirror_azimuth)).brdf;
}

Reflectance bird_as_read(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return brdf_from(path, points_of_bird(text, path, std::nullopt)).brdf;
}

// One wavelength as it is, others as luminance.
Reflectance as_luminance(const Reflectance& brdf) {
    if (brdf.wavelengths().size() == 1) return with_channels_named(brdf, luminance_wavelength());
    return luminance_brdf(brdf, spectral::Illuminant::D65);
}

Sidecar sidecar(const char* format, std::vector<std::string> notes) {
    Sidecar result;
    result.format = format;
    result.value = "f, the BRDF without the cosine";
    result.normalisation = "none";
    result.notes = std::move(notes);
    return result;
}

constexpr const char* rgb_note =
    "colour: linear sRGB under D65, of three wavelengths as blue, green and red, of more the radiance factor "
    "over pi; components below 0 as 0";
constexpr const char* xyz_note =
    "colour: CIE X, Y and Z under D65, over pi; three wavelengths are taken for blue, green and red of "
    "linear sRGB";

Exported rgl(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    RoundTripOptions compared = rgl_comparison;
    compared.slope = details.slope;
    compared.specular_solid_angle = details.specular_solid_angle;
    return exported_rgl(brdf, path, compared, details.colour ? RglChannels::rgb : RglChannels::spectra);
}

Exported merl(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    auto result = sidecar(
        "MERL binary (.binary)",
        {rgb_note,
         "a number is the BRDF at the centre of its bin, theta_h = ((i + 1/2)/90)^2 90 deg, theta_d = i + "
         "1/2 deg, phi_d = i + 1/2 deg: readers that take the bin's value are right at the centre, readers "
         "that interpolate between the bins' lower edges (libbsdf) see everything half a bin early",
         "negative numbers mark bins below the horizon, but for those next to it, which hold the horizon's "
         "value"});
    result.normalisation = "the reader multiplies red, green, blue by 1/1500, 1.15/1500, 1.66/1500";
    return {{{path, merl_bytes(brdf)}}, std::move(result)};
}

constexpr const char* radiance_side = "\"Reflection Back\", which is Radiance's front";
constexpr const char* radiance_channel =
    "one channel, Visible: the one wavelength, or of more wavelengths the luminance factor under D65, over "
    "pi";

// Under names of their own, with a definition: Radiance knows other rings of Half and Quarter
// from version to version.
KlemsBasis basis_of(const std::string& name) {
    if (name == "half") return {"Klems Half 73", KlemsBasis::half().rings()};
    if (name == "quarter") return {"Klems Quarter 41", KlemsBasis::quarter().rings()};
    return KlemsBasis::full();
}

Exported klems(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const bool specular = details.specular_solid_angle > 0;
    const auto basis = basis_of(details.basis);
    auto result = sidecar("LBNL WINDOW XML over Klems' patches",
                          {details.colour ? xyz_note : radiance_channel, radiance_side,
                           std::to_string(basis.size()) +
                               " patches; means over pairs of them, weighted by projected solid angle"});
    if (details.colour) result.notes.emplace_back("in CIE-X, Visible and CIE-Z");
    return {{{path, klems_xml(brdf, basis, specular)}}, std::move(result)};
}

Exported tensor_tree(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const int depth = details.depth > 0 ? details.depth : brdf.properties().isotropic ? 7 : 5;
    auto result = sidecar(
        "Radiance XML, tensor tree",
        {details.colour ? xyz_note : radiance_channel, radiance_side,
         "constant in cells of 1/" + std::to_string(1 << (depth - 1)) + " in direction cosines and larger"});
    if (details.colour) result.notes.emplace_back("in Visible, CIE-u and CIE-v, u' and v' of CIE 1976");
    return {{{path, tensor_tree_xml(brdf, {.depth = details.depth})}}, std::move(result)};
}

Exported zemax(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const auto grid = zemax_grid(details.specular_solid_angle);
    auto result = sidecar(
        "OpticStudio tabular BSDF (.bsdf), a file per wavelength",
        {"angles about the mirror direction; below the horizon stands the horizon's value, for readers "
         "that interpolate between all nodes",
         "TIS: reflectance per angle of incidence"});
    if (!details.colour) return {zemax_files(brdf, path, grid), std::move(result)};
    result.format = "OpticStudio tabular BSDF (.bsdf), CIE X, Y, Z";
    result.notes.emplace_back(xyz_note);
    return {{{path, zemax_colour_text(brdf, grid)}}, std::move(result)};
}

Exported csv(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {{{path, scatter_csv(brdf, csv_grid(brdf.properties().isotropic))}},
            sidecar("CSV, a row per pair of directions, a column per wavelength", {})};
}

Exported astm(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    auto result = sidecar("scatter file in the manner of ASTM E1392 (E2387)",
                          {"angles in radians, phi_s from the azimuth of x; of surfaces symmetric to the "
                           "plane of incidence one side, 0 to pi"});
    if (details.colour) result.notes.emplace_back(rgb_note);
    return {{{path, scatter_astm(brdf, csv_grid(brdf.properties().isotropic), details.colour)}},
            std::move(result)};
}

Exported lighttools(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {
        {{path, lighttools_text(brdf, csv_grid())}},
        sidecar("LightTools BSDF (.bsdf)",
                {"the light's azimuth is 90 deg; azimuths of views 90 to 270 deg, the other side is the same",
                 "blocks of BRDF Front, TIS: reflectance of the diffuse terms"})};
}

Exported open_material_files(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    return exported_open_material(brdf, path, details.mirror_azimuth);
}

Exported bird(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {
        {{path, bird_text(brdf, csv_grid(brdf.properties().isotropic))}},
        sidecar(
            "BiRD, schema 1.0 (JSON)",
            {"mirror direction at phi_r = phi_i + 180 deg; of surfaces symmetric to the plane of incidence "
             "one side"})};
}

Exported pbsdf(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return exported_pbsdf(brdf, path);
}

Exported glsl(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return exported_glsl(brdf, path);
}

Exported wgsl(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return exported_wgsl(brdf, path);
}

Reflectance shader_as_read(const Exported& exported) {
    return shader_brdf(only_file(exported).text, only_file(exported).path);
}

}  // namespace

Reflectance as_colour(const Reflectance& brdf, Colour wanted, const std::vector<std::string>& channels) {
    constexpr auto white = spectral::Illuminant::D65;
    if (brdf.size() == 3) {
        auto named = with_channels_named(brdf, rgb_wavelengths());
        const Colour given = channels == xyz_channels() ? Colour::xyz : Colour::rgb;
        if (given == wanted) return named;
        return wanted == Colour::xyz ? tristimulus_of_srgb(std::move(named))
                                     : srgb_of_tristimulus(std::move(named));
    }
    return wanted == Colour::xyz ? tristimulus_brdf(brdf, white) : linear_srgb_brdf(brdf, white);
}

const std::vector<WrittenFormat>& written_formats() {
    static const std::vector<WrittenFormat> formats{
        {"rgl",
         "tensor .bsdf of spectra, for Mitsuba 3, pbrt-v4 and powitacq, or of RGB; isotropic",
         "0.38:0.78:21",
         rgl,
         rgl_as_read,
         nullptr,
         Colour::rgb,
         false,
         {"colour"}},
        {"pbsdf", "Mueller matrices at five wavelengths, for Mitsuba 3; isotropic, model he", "0.45:0.65:5",
         pbsdf, pbsdf_as_read},
        {"merl", "MERL .binary, isotropic; three wavelengths, or linear sRGB of more", "0.40:0.70:31", merl,
         merl_as_read, nullptr, Colour::rgb, true},
        {"zemax",
         "OpticStudio tabular .bsdf; of several wavelengths an index .json and a file each",
         "0.55",
         zemax,
         zemax_as_read,
         nullptr,
         Colour::xyz,
         false,
         {"colour"},
         SpecularSpread::box},
        {"radiance",
         "Radiance tensor tree XML; one wavelength, luminance of more, or colour",
         "0.40:0.70:31",
         tensor_tree,
         radiance_as_read,
         as_luminance,
         Colour::xyz,
         false,
         {"colour", "depth"}},
        {"klems",
         "LBNL WINDOW XML over Klems' patches; as radiance",
         "0.40:0.70:31",
         klems,
         radiance_as_read,
         as_luminance,
         Colour::xyz,
         false,
         {"colour", "basis"},
         SpecularSpread::patches},
        {"astm",
         "ASTM E1392 (E2387) scatter file, angles in radians",
         "0.40:0.70:7",
         astm,
         astm_as_read,
         nullptr,
         Colour::rgb,
         false,
         {"colour"}},
        {"lighttools", "BSDF text of LightTools, isotropic", "0.40:0.70:7", lighttools, lighttools_as_read},
        {"openmaterial",
         "ASAM OpenMATERIAL 3D: .xomp with tables of optical constants and BRDF beside it; isotropic",
         "0.45,0.55,0.65",
         open_material_files,
         open_material_as_read,
         nullptr,
         Colour::rgb,
         false,
         {"mirror-azimuth"}},
        {"bird", "BiRD, JSON of bidirectional reflectance data", "0.45,0.55,0.65", bird, bird_as_read},
        {"csv", "angles and a BRDF column per wavelength", "0.40:0.70:7", csv, csv_as_read},
        {"glsl",
         "shader functions for WebGL 2 and OpenGL: brdf, specular, sample, pdf, RGB; model he",
         "0.40:0.70:8",
         glsl,
         shader_as_read,
         nullptr,
         Colour::rgb,
         false,
         {},
         SpecularSpread::facets,
         true},
        {"wgsl",
         "the same for WebGPU",
         "0.40:0.70:8",
         wgsl,
         shader_as_read,
         nullptr,
         Colour::rgb,
         false,
         {},
         SpecularSpread::facets,
         true},
    };
    return formats;
}

}  // namespace hts::tables
