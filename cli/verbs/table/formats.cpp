#include "cli/verbs/table/formats.hpp"

#include "tables/formats/channels.hpp"
#include "tables/formats/merl.hpp"
#include "tables/formats/mitsuba/pbsdf.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
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

Reflectance read_csv(const Exported& exported) {
    const auto& [path, text] = only_file(exported);
    return tables::brdf_from(path, tables::points_of_csv(text, path)).brdf;
}

// Three wavelengths as they are, others as linear sRGB.
Reflectance as_rgb(const Reflectance& brdf) {
    if (brdf.wavelengths().size() == 3) return tables::with_channels_named(brdf, tables::rgb_wavelengths());
    return tables::linear_srgb_brdf(brdf, spectral::Illuminant::D65);
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

Exported rgl(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    tables::RoundTripOptions compared = tables::rgl_comparison;
    compared.slope = details.slope;
    compared.specular_solid_angle = details.specular_solid_angle;
    return tables::exported_rgl(brdf, path, compared);
}

Exported merl(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    auto result = sidecar(
        "MERL binary (.binary)",
        {"three channels: the three wavelengths as blue, green, red, or of more wavelengths linear sRGB of "
         "the radiance factor under D65, over pi; components below 0 are written as 0",
         "a number is the BRDF at the centre of its bin, theta_h = ((i + 1/2)/90)^2 90 deg, theta_d = i + "
         "1/2 "
         "deg, phi_d = i + 1/2 deg: readers that take the bin's value are right at the centre, readers that "
         "interpolate between the bins' lower edges (libbsdf) see everything half a bin early",
         "negative numbers mark bins below the horizon, but for those next to it, which hold the horizon's "
         "value"});
    result.normalisation = "the reader multiplies red, green, blue by 1/1500, 1.15/1500, 1.66/1500";
    return {{{path, tables::merl_bytes(brdf)}}, std::move(result)};
}

constexpr const char* radiance_channel =
    "one channel, Visible, in \"Reflection Back\", which is Radiance's front: the one wavelength, or of more "
    "wavelengths the "
    "luminance factor under D65, over pi";

Exported klems(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    const bool specular = details.specular_solid_angle > 0;
    return {{{path, tables::klems_xml(brdf, tables::KlemsBasis::full(), specular)}},
            sidecar("LBNL WINDOW XML, Klems full basis",
                    {radiance_channel, "means over pairs of patches, weighted by projected solid angle"})};
}

Exported tensor_tree(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {{{path, tables::tensor_tree_xml(brdf)}},
            sidecar("Radiance XML, tensor tree",
                    {radiance_channel, "constant in cells of 1/64 in direction cosines and larger"})};
}

Exported zemax(const Reflectance& brdf, const std::string& path, const ExportDetails& details) {
    return {
        tables::zemax_files(brdf, path, tables::zemax_grid(details.specular_solid_angle)),
        sidecar(
            "OpticStudio tabular BSDF (.bsdf), a file per wavelength",
            {"angles about the mirror direction; below the horizon stands the horizon's value, for readers "
             "that interpolate between all nodes",
             "TIS: reflectance per angle of incidence"})};
}

Exported csv(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return {{{path, tables::scatter_csv(brdf, tables::csv_grid(brdf.properties().isotropic))}},
            sidecar("CSV, a row per pair of directions, a column per wavelength", {})};
}

Exported pbsdf(const Reflectance& brdf, const std::string& path, const ExportDetails& /*details*/) {
    return tables::exported_pbsdf(brdf, path);
}

}  // namespace

const std::vector<TableFormat>& table_formats() {
    static const std::vector<TableFormat> formats{
        {"rgl", "tensor .bsdf of spectra, for Mitsuba 3, pbrt-v4 and powitacq; isotropic", "0.38:0.78:21",
         rgl, read_rgl},
        {"pbsdf", "Mueller matrices at five wavelengths, for Mitsuba 3; isotropic, model he", "0.45:0.65:5",
         pbsdf, read_pbsdf},
        {"merl", "MERL .binary, isotropic; three wavelengths, or linear sRGB of more", "0.40:0.70:31", merl,
         read_merl, as_rgb},
        {"zemax", "OpticStudio tabular .bsdf; of several wavelengths an index .json and a file each", "0.55",
         zemax, read_zemax, nullptr, SpecularSpread::box},
        {"radiance", "Radiance tensor tree XML; one wavelength, or luminance of more", "0.40:0.70:31",
         tensor_tree, read_radiance, as_luminance},
        {"klems", "LBNL WINDOW XML over Klems' full basis; as radiance", "0.40:0.70:31", klems, read_radiance,
         as_luminance, SpecularSpread::patches},
        {"csv", "angles and a BRDF column per wavelength", "0.40:0.70:7", csv, read_csv},
    };
    return formats;
}

}  // namespace hts::cli
