#include "cli/verbs/table/formats.hpp"

#include "tables/formats/brdf_file.hpp"
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

Reflectance read_back(const std::string& path) {
    return tables::read_brdf(path).brdf;
}

Reflectance read_rgl(const std::string& path) {
    return Reflectance{tables::read_rgl(path)};
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

Exported merl(const Reflectance& brdf, const std::string& path) {
    auto result = sidecar(
        "MERL binary (.binary)",
        {"three channels: the three wavelengths as blue, green, red, or of more wavelengths linear sRGB of "
         "the radiance factor under D65, over pi; components below 0 are written as 0",
         "negative numbers mark bins below the horizon"});
    result.normalisation = "the reader multiplies red, green, blue by 1/1500, 1.15/1500, 1.66/1500";
    return {{{path, tables::merl_bytes(brdf)}}, std::move(result)};
}

constexpr const char* radiance_channel =
    "one channel, Visible, in \"Reflection Back\", which is Radiance's front: the one wavelength, or of more "
    "wavelengths the "
    "luminance factor under D65, over pi";

Exported klems(const Reflectance& brdf, const std::string& path) {
    return {{{path, tables::klems_xml(brdf)}},
            sidecar("LBNL WINDOW XML, Klems full basis",
                    {radiance_channel, "means over pairs of patches, weighted by projected solid angle",
                     "Radiance loads no file that reflects more than 1.01 of the light of a patch"})};
}

Exported tensor_tree(const Reflectance& brdf, const std::string& path) {
    return {{{path, tables::tensor_tree_xml(brdf)}},
            sidecar("Radiance XML, tensor tree",
                    {radiance_channel, "constant in cells of 1/64 in direction cosines and larger"})};
}

Exported zemax(const Reflectance& brdf, const std::string& path) {
    return {tables::zemax_files(brdf, path),
            sidecar("OpticStudio tabular BSDF (.bsdf), a file per wavelength",
                    {"angles about the mirror direction; 0 below the horizon",
                     "TIS: reflectance per angle of incidence"})};
}

Exported csv(const Reflectance& brdf, const std::string& path) {
    return {{{path, tables::scatter_csv(brdf, tables::csv_grid(brdf.properties().isotropic))}},
            sidecar("CSV, a row per pair of directions, a column per wavelength", {})};
}

Exported pbsdf(const Reflectance& brdf, const std::string& path) {
    return tables::exported_pbsdf(brdf, path);
}

}  // namespace

const std::vector<TableFormat>& table_formats() {
    static const std::vector<TableFormat> formats{
        {"rgl", "tensor .bsdf of spectra, for Mitsuba 3, pbrt-v4 and powitacq; isotropic", "0.38:0.78:21",
         tables::exported_rgl, read_rgl},
        {"pbsdf", "Mueller matrices at five wavelengths, for Mitsuba 3; isotropic, model he", "0.45:0.65:5",
         pbsdf, tables::read_pbsdf},
        {"merl", "MERL .binary, isotropic; three wavelengths, or linear sRGB of more", "0.40:0.70:31", merl,
         read_back, as_rgb},
        {"zemax", "OpticStudio tabular .bsdf; of several wavelengths an index .json and a file each", "0.55",
         zemax, read_back},
        {"radiance", "Radiance tensor tree XML; one wavelength, or luminance of more", "0.40:0.70:31",
         tensor_tree, read_back, as_luminance},
        {"klems", "LBNL WINDOW XML over Klems' full basis; as radiance", "0.40:0.70:31", klems, read_back,
         as_luminance},
        {"csv", "angles and a BRDF column per wavelength", "0.40:0.70:7", csv, read_back},
    };
    return formats;
}

}  // namespace hts::cli
