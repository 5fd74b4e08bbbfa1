#include "tables/formats/brdf_file.hpp"

#include <algorithm>
#include <fstream>

#include "hts/error.hpp"
#include "spectral/text/run_files.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/channels.hpp"
#include "tables/formats/merl.hpp"
#include "tables/formats/mitsuba/rgl.hpp"
#include "tables/formats/points/scatter_points.hpp"
#include "tables/formats/radiance/radiance_xml.hpp"
#include "tables/formats/whole_file.hpp"
#include "tables/formats/zemax.hpp"

namespace hts::tables {
namespace {

using Path = std::filesystem::path;
using Wavelengths = std::optional<spectral::WavelengthGrid>;

constexpr const char* no_wavelength =
    "channels without wavelength, named by 0.46, 0.55 and 0.62 um for blue, green and red or 0.55 um for "
    "luminance";

std::string head_of(const Path& path) {
    std::string head(4096, '\0');
    std::ifstream file{spectral::path_to_read(path), std::ios::binary};
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    return head;
}

// The first word that is no comment.
std::string_view first_word(std::string_view head) {
    for (const std::string_view line : spectral::split(head, '\n')) {
        const auto words = spectral::words(line);
        if (!words.empty() && !words.front().starts_with('#')) return words.front();
    }
    return {};
}

bool has_line_vars(std::string_view head) {
    return head.starts_with("VARS ") || head.find("\nVARS ") != std::string_view::npos;
}

BrdfFile read_merl(const Path& path, const Wavelengths& wavelengths) {
    const std::string bytes = read_whole_file(path, merl_size);
    BrdfFile file{merl_brdf(bytes, path.string(), wavelengths.value_or(rgb_wavelengths())), "merl", {}};
    if (!wavelengths) file.notes.emplace_back(no_wavelength);
    return file;
}

BrdfFile read_radiance(const Path& path, const Wavelengths& wavelengths) {
    BrdfFile file{radiance_brdf(spectral::read_text_file(path), path.string(), wavelengths), "radiance", {}};
    if (!wavelengths) file.notes.emplace_back(no_wavelength);
    return file;
}

BrdfFile file_of_points(const Path& path, const ScatterPoints& points, const char* format) {
    bool regular = false;
    BrdfFile file{brdf_from(path.string(), points, &regular), format, {}};
    const auto [low, high] =
        std::minmax_element(points.angles.begin(), points.angles.end(),
                            [](const auto& a, const auto& b) { return a.theta_i < b.theta_i; });
    file.notes.push_back(
        std::to_string(points.angles.size()) + " points, theta_i " + shortest(low->theta_i) + " to " +
        shortest(high->theta_i) + " deg, " +
        (regular ? "on a full grid: linear between them" : "scattered: the eight nearest count"));
    return file;
}

}  // namespace

const std::vector<BrdfFormat>& readable_formats() {
    static const std::vector<BrdfFormat> formats{
        {"merl", "MERL .binary, isotropic RGB",
         [](std::string_view head, const Path& path) {
             return head.starts_with(std::string_view{"\x5a\0\0\0\x5a\0\0\0\xb4\0\0\0", 12}) ||
                    path.extension() == ".binary";
         },
         read_merl},
        {"rgl", "spectral tensor .bsdf of RGL, Mitsuba 3 and pbrt-v4",
         [](std::string_view head, const Path& path) {
             return head.starts_with(std::string_view{"tensor_file\0", 12}) && path.extension() != ".pbsdf";
         },
         [](const Path& path, const Wavelengths& wavelengths) {
             if (wavelengths) throw Error{path.string() + ": says its wavelengths, which must not be given"};
             return BrdfFile{spectral::Reflectance{read_rgl(path)}, "rgl", {}};
         }},
        {"radiance", "Radiance and LBNL WINDOW XML, tensor tree or Klems' patches",
         [](std::string_view head, const Path&) { return spectral::trimmed(head).starts_with('<'); },
         read_radiance},
        {"zemax", "tabular .bsdf of OpticStudio, or the index (.json) of several",
         [](std::string_view head, const Path&) {
             return first_word(head) == "Source" || head.find("\"zemax_files\"") != std::string_view::npos;
         },
         [](const Path& path, const Wavelengths& wavelengths) {
             return BrdfFile{read_zemax(path, wavelengths), "zemax", {}};
         }},
        {"astm", "ASTM E1392 (E2387) scatter file, KEY value lines, VARS and points",
         [](std::string_view head, const Path&) { return has_line_vars(head); },
         [](const Path& path, const Wavelengths& wavelengths) {
             const std::string text = spectral::read_text_file(path);
             return file_of_points(path, points_of_astm(text, path.string(), wavelengths), "astm");
         }},
        {"csv", "CSV with theta_i_deg, theta_r_deg, phi_r_deg and brdf",
         [](std::string_view head, const Path& path) {
             return path.extension() == ".csv" ||
                    first_word(head).find("theta_i_deg") != std::string_view::npos;
         },
         [](const Path& path, const Wavelengths& wavelengths) {
             const std::string text = spectral::read_text_file(path);
             return file_of_points(path, points_of_csv(text, path.string(), wavelengths), "csv");
         }},
    };
    return formats;
}

BrdfFile read_brdf(const Path& path, const Wavelengths& wavelengths, std::string_view format) {
    std::vector<std::string> known;
    if (std::error_code ignored; !std::filesystem::is_regular_file(spectral::path_to_read(path), ignored))
        throw Error{path.string() + ": must be a file that exists"};
    const std::string head = head_of(path);
    for (const BrdfFormat& each : readable_formats()) {
        known.push_back(each.name);
        if (format.empty() ? each.recognised(head, path) : each.name == format)
            return each.read(path, wavelengths);
    }
    if (!format.empty())
        throw Error{"format " + spectral::in_quotes(format) + ": must be one of " + spectral::joined(known)};
    throw Error{path.string() + ": of no format that is known: " + spectral::joined(known)};
}

}  // namespace hts::tables
