#include "cli/verbs/table/formats.hpp"

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

namespace hts::cli {
namespace {

using tables::Exported;

const spectral::TextFile& only_file(const Exported& exported) {
    return exported.files.front();
}

Reflectance read_rgl(const Exported& exported) {
    return Reflectance{tables::parse_rgl(only_file(exported).text, only_file(exported).path)};
}

Reflectance read_pbsdf(const Exported& exported) {
    return tables::parse_pbsdf(only_file(exported).text, only_file(exported).path);
}

// The value of a bin, as most readers do.
Reflectance read_merl(const Exported& exported) {
    return tables::merl_brdf(only_file(exported).text, only_file(exported).path, tables::rgb_wavelengths(),
                             tables::MerlLookup::bins);
}

Reflectance read_zemax(const Exported& exported) {
    std::vector<Reflectance> parts;
    for (const auto& file : exported.files)
        if (!file.path.ends_with(".json")) parts.push_back(tables::zemax_brdf(file.text, file.path));
    return parts.size() == 1 ? parts.front() : tables::joined(exported.files.back().path, std::move(parts));
}

Reflectance read_radiance(const Exported& exported) {
    return tables::radiance_brdf(only_file(exported).text, only_file(exported).path);
}

Reflectance read_astm(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return tables::brdf_from(path, tables::points_of_astm(text, path)).brdf;
}

Reflectance read_csv(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return tables::brdf_from(path, tables::points_of_csv(text, path)).brdf;
}

Reflectance read_lighttools(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return tables::brdf_from(path, tables::points_of_lighttools(text, path, std::nullopt)).brdf;
}

// Its BRDF stands in the last of its files; azimuths as they were written.
Reflectance read_open_material(const Exported& exported) {
    const auto& [path, text] = exported.files.back();
    return tables::brdf_from(
               path, tables::points_of_open_material(text, path, std::nullopt, exported.mirror_azimuth))
        .brdf;
}

Reflectance read_bird(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return tables::brdf_from(path, tables::points_of_bird(text, path, std::nullopt)).brdf;
}

// One wavelength as it is, others as luminance.
Reflectance as_luminance(const Reflectance& brdf) {
    if (brdf.wavelengths().size() == 1)
        return tables::with_channels_named(brdf, tables::luminance_wavelength());
    return tables::luminance_brdf(brdf, spectral::Illuminant::D65);
}

tables::Sidecar sidecar(const char* format, std::vector<std::string> notes) {
    tables::Sidecar result;
    result.format = format;
    result.value = "f, the BRDF without the cosine";
    result.normalisation = "none";
    result.notes = std::move(notes);
    return result;
}

constexpr const char* rgb_note =
    "colour: linear sRGB under D65, of three wavelengths as blue, green and red, of more the radiance factor "
    "over pi; components below "
    "0 as 0";
constexpr const char* xyz_note =
    "colour: CIE X, Y and Z under D65, over pi; three wavelengths are taken for blue, green and red of "
    "linear sRGB";

Exported rgl(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    tables::RoundTripOptions compared = tables::rgl_comparison;
    compared.slope = details.slope;
    compared.specular_solid_angle = details.specular_solid_angle;
    return tables::exported_rgl(brdf, path, compared,
                                details.colour ? tables::RglChannels::rgb : tables::RglChannels::spectra);
}

Exported merl(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    auto result = sidecar(
        "MERL binary (.binary)",
        {rgb_note,
         "a number is the BRDF at the centre of its bin, theta_h = ((i + 1/2)/90)^2 90 deg, theta_d = i + "
         "1/2 "
         "deg, phi_d = i + 1/2 deg: readers that take the bin's value are right at the centre, readers that "
         "interpolate between the bins' lower edges (libbsdf) see everything half a bin early",
         "negative numbers mark bins below the horizon, but for those next to it, which hold the horizon's "
         "value"});
    result.normalisation = "the reader multiplies red, green, blue by 1/1500, 1.15/1500, 1.66/1500";
    return {{{path, tables::merl_bytes(brdf)}}, std::move(result)};
}

constexpr const char* radiance_side = "\"Reflection Back\", which is Radiance's front";
constexpr const char* radiance_channel =
    "one channel, Visible: the one wavelength, or of more wavelengths the luminance factor under D65, over "
    "pi";

// Under names of their own, with a definition: Radiance knows other rings of Half and Quarter
// from version to version.
tables::KlemsBasis basis_of(const std::string& name) {
    if (name == "half") return {"Klems Half 73", tables::KlemsBasis::half().rings()};
    if (name == "quarter") return {"Klems Quarter 41", tables::KlemsBasis::quarter().rings()};
    return tables::KlemsBasis::full();
}

Exported klems(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const bool specular = details.specular_solid_angle > 0;
    const auto basis = basis_of(details.basis);
    auto result = sidecar("LBNL WINDOW XML over Klems' patches",
                          {details.colour ? xyz_note : radiance_channel, radiance_side,
                           std::to_string(basis.size()) +
                               " patches; means over pairs of them, weighted by projected solid angle"});
    if (details.colour) result.notes.emplace_back("in CIE-X, Visible and CIE-Z");
    return {{{path, tables::klems_xml(brdf, basis, specular)}}, std::move(result)};
}

Exported tensor_tree(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const int depth = details.depth > 0 ? details.depth : brdf.properties().isotropic ? 7 : 5;
    auto result = sidecar(
        "Radiance XML, tensor tree",
        {details.colour ? xyz_note : radiance_channel, radiance_side,
         "constant in cells of 1/" + std::to_string(1 << (depth - 1)) + " in direction cosines and larger"});
    if (details.colour) result.notes.emplace_back("in Visible, CIE-u and CIE-v, u' and v' of CIE 1976");
    return {{{path, tables::tensor_tree_xml(brdf, {.depth = details.depth})}}, std::move(result)};
}

Exported zemax(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const auto grid = tables::zemax_grid(details.specular_solid_angle);
    auto result = sidecar(
        "OpticStudio tabular BSDF (.bsdf), a file per wavelength",
        {"angles about the mirror direction; below the horizon stands the horizon's value, for readers "
         "that interpolate between all nodes",
         "TIS: reflectance per angle of incidence"});
    if (!details.colour) return {tables::zemax_files(brdf, path, grid), std::move(result)};
    result.format = "OpticStudio tabular BSDF (.bsdf), CIE X, Y, Z";
    result.notes.emplace_back(xyz_note);
    return {{{path, tables::zemax_colour_text(brdf, grid)}}, std::move(result)};
}

Exported csv(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {{{path, tables::scatter_csv(brdf, tables::csv_grid(brdf.properties().isotropic))}},
            sidecar("CSV, a row per pair of directions, a column per wavelength", {})};
}

Exported astm(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    auto result = sidecar("scatter file in the manner of ASTM E1392 (E2387)",
                          {"angles in radians, phi_s from the azimuth of x; of surfaces symmetric to the "
                           "plane of incidence one side, "
                           "0 to pi"});
    if (details.colour) result.notes.emplace_back(rgb_note);
    return {
        {{path, tables::scatter_astm(brdf, tables::csv_grid(brdf.properties().isotropic), details.colour)}},
        std::move(result)};
}

Exported lighttools(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {
        {{path, tables::lighttools_text(brdf, tables::csv_grid())}},
        sidecar("LightTools BSDF (.bsdf)",
                {"the light's azimuth is 90 deg; azimuths of views 90 to 270 deg, the other side is the same",
                 "blocks of BRDF Front, TIS: reflectance of the diffuse terms"})};
}

Exported open_material(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    return tables::exported_open_material(brdf, path, details.mirror_azimuth);
}

Exported bird(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {
        {{path, tables::bird_text(brdf, tables::csv_grid(brdf.properties().isotropic))}},
        sidecar(
            "BiRD, schema 1.0 (JSON)",
            {"mirror direction at phi_r = phi_i + 180 deg; of surfaces symmetric to the plane of incidence "
             "one side"})};
}

Exported pbsdf(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return tables::exported_pbsdf(brdf, path);
}

Exported glsl(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return tables::exported_glsl(brdf, path);
}

Reflectance read_glsl(const Exported& exported) {
    return tables::glsl_brdf(only_file(exported).text, only_file(exported).path);
}

}  // namespace

Reflectance as_colour(const Reflectance& brdf, Colour wanted, const std::vector<std::string>& channels) {
    constexpr auto white = spectral::Illuminant::D65;
    if (brdf.size() == 3) {
        auto named = tables::with_channels_named(brdf, tables::rgb_wavelengths());
        const Colour given = channels == tables::xyz_channels() ? Colour::xyz : Colour::rgb;
        if (given == wanted) return named;
        return wanted == Colour::xyz ? tables::tristimulus_of_srgb(std::move(named))
                                     : tables::srgb_of_tristimulus(std::move(named));
    }
    return wanted == Colour::xyz ? tables::tristimulus_brdf(brdf, white)
                                 : tables::linear_srgb_brdf(brdf, white);
}

const std::vector<TableFormat>& table_formats() {
    static const std::vector<TableFormat> formats{
        {"rgl",
         "tensor .bsdf of spectra, for Mitsuba 3, pbrt-v4 and powitacq, or of RGB; isotropic",
         "0.38:0.78:21",
         rgl,
         read_rgl,
         nullptr,
         Colour::rgb,
         false,
         {"--colour"}},
        {"pbsdf", "Mueller matrices at five wavelengths, for Mitsuba 3; isotropic, model he", "0.45:0.65:5",
         pbsdf, read_pbsdf},
        {"merl", "MERL .binary, isotropic; three wavelengths, or linear sRGB of more", "0.40:0.70:31", merl,
         read_merl, nullptr, Colour::rgb, true},
        {"zemax",
         "OpticStudio tabular .bsdf; of several wavelengths an index .json and a file each",
         "0.55",
         zemax,
         read_zemax,
         nullptr,
         Colour::xyz,
         false,
         {"--colour"},
         SpecularSpread::box},
        {"radiance",
         "Radiance tensor tree XML; one wavelength, luminance of more, or colour",
         "0.40:0.70:31",
         tensor_tree,
         read_radiance,
         as_luminance,
         Colour::xyz,
         false,
         {"--colour", "--depth"}},
        {"klems",
         "LBNL WINDOW XML over Klems' patches; as radiance",
         "0.40:0.70:31",
         klems,
         read_radiance,
         as_luminance,
         Colour::xyz,
         false,
         {"--colour", "--basis"},
         SpecularSpread::patches},
        {"astm",
         "ASTM E1392 (E2387) scatter file, angles in radians",
         "0.40:0.70:7",
         astm,
         read_astm,
         nullptr,
         Colour::rgb,
         false,
         {"--colour"}},
        {"lighttools", "BSDF text of LightTools, isotropic", "0.40:0.70:7", lighttools, read_lighttools},
        {"openmaterial",
         "ASAM OpenMATERIAL 3D: .xomp with tables of optical constants and BRDF beside it; isotropic",
         "0.45,0.55,0.65",
         open_material,
         read_open_material,
         nullptr,
         Colour::rgb,
         false,
         {"--mirror-azimuth"}},
        {"bird", "BiRD, JSON of bidirectional reflectance data", "0.45,0.55,0.65", bird, read_bird},
        {"csv", "angles and a BRDF column per wavelength", "0.40:0.70:7", csv, read_csv},
        {"glsl",
         "shader functions for WebGL 2 and OpenGL: brdf, specular, sample, pdf, RGB; model he",
         "0.40:0.70:8",
         glsl,
         read_glsl,
         nullptr,
         Colour::rgb,
         false,
         {},
         SpecularSpread::facets,
         true},
    };
    return formats;
}

}  // namespace hts::cli
