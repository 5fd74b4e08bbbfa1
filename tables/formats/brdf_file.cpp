#include "tables/formats/brdf_file.hpp"

#include <algorithm>
#include <utility>

#include "hts/error.hpp"
#include "spectral/models/material.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/coverage.hpp"
#include "tables/formats/merl.hpp"
#include "tables/formats/mitsuba/pbsdf.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/points/astm.hpp"
#include "tables/formats/points/bird.hpp"
#include "tables/formats/points/fred.hpp"
#include "tables/formats/points/lighttools.hpp"
#include "tables/formats/points/open_material.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/points/tracepro.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/whole_file.hpp"
#include "tables/formats/zemax.hpp"

namespace hts::tables {
namespace {

using Path = std::filesystem::path;

// The first line that is no comment.
std::string_view first_line(std::string_view text) {
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view line = spectral::trimmed(text.substr(0, end));
        if (!line.empty() && !line.starts_with('#')) return line;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return {};
}

std::string_view without_mark(std::string_view text) {
    if (text.starts_with(spectral::byte_order_mark)) text.remove_prefix(spectral::byte_order_mark.size());
    return text;
}

/// A header of points, whatever the case of its names: the reader says what is wrong with them.
bool has_word_theta(std::string_view line) {
    constexpr std::string_view word = "theta_";
    for (std::size_t at = 0; at + word.size() <= line.size(); ++at) {
        if (spectral::same_letters(line.substr(at, word.size()), word)) return true;
    }
    return false;
}

bool is_text_file(std::string_view bytes) {
    return spectral::is_text(bytes.substr(0, bytes.find_last_of('\n') + 1));
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): as all readers
BrdfFile read_merl(std::string bytes, const Path& path, const BrdfReading& how) {
    BrdfFile file{merl_brdf(bytes, path.string(), how.wavelengths.value_or(rgb_wavelengths())), "merl", {}};
    if (!how.wavelengths) file.channels = rgb_channels();
    return file;
}

BrdfFile read_radiance(std::string bytes, const Path& path, const BrdfReading& how) {
    auto found =
        radiance_file(spectral::checked_text(std::move(bytes), path), path.string(), how.wavelengths);
    BrdfFile file{std::move(found.brdf), "radiance", std::move(found.notes)};
    if (!how.wavelengths) file.channels = std::move(found.channels);
    return file;
}

bool is_tensor_file(std::string_view bytes) {
    return bytes.starts_with(std::string_view{"tensor_file\0", 12});
}

// The fields that only the polarised files have, with the lengths of their names, among the first.
bool is_polarised(std::string_view bytes) {
    using namespace std::string_view_literals;
    const auto head = bytes.substr(0, 4096);
    return head.find("\4\0wvls"sv) != std::string_view::npos ||
           head.find("\7\0theta_h"sv) != std::string_view::npos;
}

BrdfFile read_rgl_file(std::string bytes, const Path& path, const BrdfReading& how) {
    const bool rgb = is_rgb_rgl(bytes);
    if (how.wavelengths && !rgb)
        throw Error{path.string() + ": says its wavelengths, which must not be given"};
    spectral::Reflectance brdf{parse_rgl(std::move(bytes), path)};
    if (!rgb) return {std::move(brdf), "rgl", {}};
    if (how.wavelengths) return {with_channels_named(std::move(brdf), *how.wavelengths), "rgl", {}};
    return {std::move(brdf), "rgl", {}, rgb_channels()};
}

BrdfFile read_tabular(std::string bytes, const Path& path, const BrdfReading& how) {
    auto found = zemax_file(spectral::checked_text(std::move(bytes), path), path, how.wavelengths);
    return {std::move(found.brdf), "zemax", std::move(found.notes), std::move(found.channels)};
}

BrdfFile file_of_points(const Path& path, const ScatterPoints& points, const char* format) {
    PointsBrdf found = brdf_from(path.string(), points);
    return {std::move(found.brdf), format, std::move(found.notes), points.channels};
}

/// A few wavelengths of a material's optical constants, at which to say what it reflects.
spectral::Reflectance at_some_wavelengths(const std::string& material, const Path& path) {
    constexpr std::size_t most = 16;
    const auto read = spectral::JsonValue::parse(material, path.string());
    std::vector<double> um;
    if (const auto table = read["index"].find("table"))
        for (const auto& row : table->rows({"um", "n", "k"})) um.push_back(row.values[0]);
    if (um.empty()) um.push_back(0.55);
    std::vector<double> some;
    const std::size_t count = std::min(most, um.size());
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(um[count == 1 ? 0 : i * (um.size() - 1) / (count - 1)]);
    return spectral::material_from_text(material, path)
        .at(spectral::WavelengthGrid::from_micrometres(std::move(some)));
}

BrdfFile read_open_material(std::string bytes, const Path& path, const BrdfReading& how) {
    std::string text = spectral::checked_text(std::move(bytes), path);
    OpenMaterial found;
    Path table = path;
    if (!is_open_material_brdf(text)) {
        found = open_material(text, path);
        if (!found.material.empty()) {
            if (how.wavelengths)
                throw Error{path.string() + ": says its wavelengths, which must not be given"};
            return {at_some_wavelengths(found.material, path),
                    "openmaterial",
                    std::move(found.notes),
                    {},
                    std::move(found.material)};
        }
        table = found.brdf_table;
        text = spectral::checked_text(read_whole_file(table), table);
    }
    const auto points =
        points_of_open_material(text, table.string(), how.wavelengths, how.mirror_azimuth.value_or(180));
    BrdfFile file = file_of_points(table, points, "openmaterial");
    file.notes.insert(file.notes.begin(), found.notes.begin(), found.notes.end());
    return file;
}

BrdfFile with_coverage(BrdfFile file) {
    if (!file.material.empty()) return file;  // of a model, which knows all directions
    if (!file.channels.empty()) {
        std::string names;
        for (std::size_t i = 0; i < file.channels.size(); ++i)
            names.append(i == 0 ? "" : ", ")
                .append(file.channels[i] + " at " + shortest(file.brdf.wavelengths().micrometres()[i]) +
                        " um");
        file.notes.push_back("channels, no spectrum: asked for as " + names);
    }
    file.notes.push_back(coverage_note(file.brdf));
    return file;
}

}  // namespace

const std::vector<BrdfFormat>& readable_formats() {
    static const std::vector<BrdfFormat> formats{
        {"merl", "MERL .binary, isotropic RGB",
         [](std::string_view bytes, const Path& path) {
             return bytes.starts_with(std::string_view{"\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12}) ||
                    path.extension() == ".binary";
         },
         read_merl},
        {"rgl", "tensor .bsdf of RGL, Mitsuba 3 and pbrt-v4, of spectra or RGB",
         [](std::string_view bytes, const Path&) { return is_tensor_file(bytes) && !is_polarised(bytes); },
         read_rgl_file},
        {"pbsdf", "polarised tensor .pbsdf of KAIST and Mitsuba 3",
         [](std::string_view bytes, const Path&) { return is_tensor_file(bytes) && is_polarised(bytes); },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             if (how.wavelengths)
                 throw Error{path.string() + ": says its wavelengths, which must not be given"};
             return BrdfFile{parse_pbsdf(std::move(bytes), path),
                             "pbsdf",
                             {"Mueller matrices; the specular term is not part of the file"}};
         }},
        {"radiance", "Radiance and LBNL WINDOW XML, tensor tree or Klems' patches",
         [](std::string_view bytes, const Path&) {
             return spectral::trimmed(without_mark(bytes)).starts_with('<') ||
                    bytes.find("<WindowElement") != std::string_view::npos;
         },
         read_radiance},
        {"zemax", "tabular .bsdf of OpticStudio, or the index (.json) of several",
         [](std::string_view bytes, const Path&) {
             const auto words = spectral::words(first_line(without_mark(bytes)).substr(0, 200));
             return (!words.empty() && spectral::same_letters(words.front(), "Source")) ||
                    (spectral::trimmed(bytes).starts_with('{') &&
                     bytes.find("\"zemax_files\"") != std::string_view::npos);
         },
         read_tabular},
        {"lighttools", "BSDF text of LightTools, a block per angle of incidence and wavelength",
         [](std::string_view bytes, const Path&) { return is_lighttools_file(bytes); },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             const std::string text = spectral::checked_text(std::move(bytes), path);
             return file_of_points(path, points_of_lighttools(text, path.string(), how.wavelengths),
                                   "lighttools");
         }},
        {"fred", "scatter table of FRED, \"type bsdf_data\", also with VIAVI's head of lines \"!!\"",
         [](std::string_view bytes, const Path&) { return is_fred_file(without_mark(bytes)); },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             const std::string text = spectral::checked_text(std::move(bytes), path);
             return file_of_points(
                 path, points_of_fred(text, path.string(), how.wavelengths, how.mirror_azimuth.value_or(0)),
                 "fred");
         }},
        {"tracepro", "surface property of TracePro, text with Table_BSDF_Data or ABg coefficients",
         [](std::string_view bytes, const Path&) { return is_tracepro_file(without_mark(bytes)); },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             if (how.wavelengths)
                 throw Error{path.string() + ": says its wavelengths, which must not be given"};
             const std::string text = spectral::checked_text(std::move(bytes), path);
             TraceProFile found =
                 tracepro_file(without_mark(text), path.string(), how.mirror_azimuth.value_or(0));
             return BrdfFile{std::move(found.brdf), "tracepro", std::move(found.notes)};
         }},
        {"openmaterial", "ASAM OpenMATERIAL 3D, a material (.xomp) or the table of its BRDF (_brdf.xompt)",
         [](std::string_view bytes, const Path&) { return is_open_material(without_mark(bytes)); },
         read_open_material},
        {"bird", "BiRD, JSON of bidirectional reflectance data",
         [](std::string_view bytes, const Path&) { return is_bird_file(without_mark(bytes)); },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             const std::string text = spectral::checked_text(std::move(bytes), path);
             return file_of_points(
                 path, points_of_bird(text, path.string(), how.wavelengths, how.mirror_azimuth.value_or(180)),
                 "bird");
         }},
        {"astm", "ASTM E1392 (E2387) scatter file, KEY value lines, VARS and points",
         [](std::string_view bytes, const Path&) { return is_astm_file(without_mark(bytes)); },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             const std::string text = spectral::checked_text(std::move(bytes), path);
             return file_of_points(path, points_of_astm(text, path.string(), how.wavelengths), "astm");
         }},
        {"csv", "CSV with theta_i_deg, theta_r_deg, phi_r_deg and brdf",
         [](std::string_view bytes, const Path& path) {
             return path.extension() == ".csv" || path.extension() == ".tsv" ||
                    (has_word_theta(first_line(without_mark(bytes))) && is_text_file(bytes)) ||
                    first_line(without_mark(bytes)).starts_with("sep=");
         },
         [](std::string bytes, const Path& path, const BrdfReading& how) {
             const std::string text = spectral::checked_text(std::move(bytes), path);
             return file_of_points(path, points_of_csv(text, path.string(), how.wavelengths), "csv");
         }},
    };
    return formats;
}

BrdfFile read_brdf(const Path& path, const BrdfReading& how) {
    std::string bytes = read_whole_file(path);
    if (bytes.empty()) throw Error{path.string() + ": file is empty"};
    std::vector<std::string> known;
    for (const BrdfFormat& each : readable_formats()) {
        known.push_back(each.name);
        if (how.format.empty() ? each.recognised(bytes, path) : each.name == how.format)
            return with_coverage(each.read(std::move(bytes), path, how));
    }
    if (!how.format.empty())
        throw Error{"format " + spectral::in_quotes(how.format) + ": must be one of " +
                    spectral::joined(known)};
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
        throw Error{path.string() + ": " + spectral::no_text(bytes)};
    throw Error{path.string() + ": of no format that is known: " + spectral::joined(known)};
}

}  // namespace hts::tables
