#include "tables/formats/points/open_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/tokens.hpp"
#include "tables/formats/whole_file.hpp"

namespace hts::tables {
namespace {

using nlohmann::ordered_json;
using spectral::JsonValue;

constexpr double metre = 1e6;                // [um]
constexpr double room_temperature = 293.15;  // [K]
constexpr double degree = std::numbers::pi / 180;
constexpr double full_turn_written = 6.283185;                   // the schema's greatest azimuth
constexpr std::uint64_t largest_table = std::uint64_t{1} << 30;  // [bytes]

/// A number within a range, else an error that names the key and what it must be.
double number_within(const JsonValue& value, double least, double most, const char* must_be) {
    const double number = value.number();
    if (number >= least && number <= most) return number;
    throw value.error(shortest(number) + ": must be " + must_be);
}

double micrometres(const JsonValue& metres) {
    return metre * number_within(metres, 1e-9, 1, "a wavelength in m, from 1e-9 to 1");
}

void require_metadata(const JsonValue& file) {
    const JsonValue metadata = file["metadata"];
    for (const char* key : {"name", "uuid", "materialVersion", "openMaterial3dVersion", "license"})
        static_cast<void>(metadata[key].text());
    for (const char* key : {"copyrights", "authors"}) static_cast<void>(metadata[key].items());
}

// ---- optical constants

struct OpticalRow {
    double um, n, k;
};

/// Those at the temperature nearest to that of a room.
std::vector<OpticalRow> optical_rows(const std::filesystem::path& path, std::vector<std::string>& notes) {
    const std::string text = spectral::checked_text(read_whole_file(path, largest_table), path);
    const JsonValue file = JsonValue::parse(text, path.string());
    const auto rows = file["opticalProperties"].rows({"wavelength m", "temperature K", "n", "k"});
    std::map<double, std::vector<OpticalRow>> by_temperature;
    for (const JsonValue::Row& row : rows) {
        const auto& v = row.values;
        if (!(v[0] >= 1e-9 && v[0] <= 1))
            throw Error{row.place + ": " + out_of_range("wavelength", v[0], "m", "from 1e-9 to 1").what()};
        if (!(v[2] > 0 && v[3] >= 0))
            throw Error{row.place + ": n " + shortest(v[2]) + ", k " + shortest(v[3]) +
                        ": must be n > 0 and k >= 0"};
        by_temperature[v[1]].push_back({v[0] * metre, v[2], v[3]});
    }
    const auto nearest = std::ranges::min_element(
        by_temperature, {}, [](const auto& entry) { return std::abs(entry.first - room_temperature); });
    if (by_temperature.size() > 1)
        notes.push_back("optical constants at " + std::to_string(by_temperature.size()) +
                        " temperatures: those at " + shortest(nearest->first) + " K are taken");
    std::vector<OpticalRow> result = nearest->second;
    std::ranges::sort(result, {}, &OpticalRow::um);
    for (std::size_t i = 1; i < result.size(); ++i)
        if (result[i].um == result[i - 1].um)
            throw Error{path.string() + ": wavelength " + shortest(result[i].um) + " um: stands twice"};
    return result;
}

/// A relative path as the schema has them.
std::filesystem::path beside(const JsonValue& uri, const std::filesystem::path& material) {
    const std::filesystem::path path{uri.text()};
    if (path.empty() || path.is_absolute()) throw uri.error("must be a relative path");
    return material.parent_path() / path;
}

// ---- BRDF tables

/// Rows with `null` in place of wavelengths, for files that have one unnamed channel.
struct BrdfRow {
    double um;  // 0: not stated
    ScatterAngles angles;
    double value;
};

BrdfRow brdf_row(const JsonValue& row, double mirror_azimuth) {
    const auto cells = row.items();
    if (cells.size() != 5)
        throw row.error("must be [wavelength m, theta_i rad, theta_r rad, phi_r rad, BRDF 1/sr]");
    constexpr double right = std::numbers::pi / 2 + 1e-6;
    const double theta_i = number_within(cells[1], 0, right, "an angle from 0 to pi/2 rad");
    const double theta_r = number_within(cells[2], 0, right, "an angle from 0 to pi/2 rad");
    const double phi_r = number_within(cells[3], -7, 7, "an angle from 0 to 2 pi rad");
    const double value = number_within(cells[4], -largest_number, largest_number, "at most 1e100");
    return {cells[0].is_null() ? 0 : micrometres(cells[0]),
            {std::min(theta_i / degree, 90.0), 0, std::min(theta_r / degree, 90.0),
             phi_r / degree + 180 - mirror_azimuth},
            value};
}

// ---- writing

ordered_json metadata_of(const std::string& name, const std::string& content) {
    return {{"name", name},
            {"description", "Computed by hts, a physical-optics reflectance library."},
            {"uuid", uuid_of(content)},
            {"materialVersion", "1.0.0"},
            {"openMaterial3dVersion", "1.0.0"},
            {"copyrights", {"not stated"}},
            {"license", "NOASSERTION"},
            {"authors", {"hts"}},
            {"sources", "simulated by hts from a material file"}};
}

/// A text with `{…}` of the metadata and one more member, whose rows stand in lines.
std::string table_text(const std::string& name, const std::string& member) {
    std::string text = metadata_of(name, member).dump(2);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 3))
        text.insert(at + 1, "  ");
    return "{\n  \"metadata\": " + text + ",\n" + member + "}\n";
}

std::string optical_member(const spectral::Reflectance& brdf) {
    std::string text = "  \"opticalProperties\": [";
    const char* before = "\n    [";
    for (const SpectralSample& sample : brdf.samples()) {
        text += before;
        append_rounded(text, sample.wavelength.micrometres() / metre, 12);
        text += ", " + shortest(room_temperature) + ", ";
        text += shortest(sample.index.substrate().n()) + ", " + shortest(sample.index.substrate().k()) + "]";
        before = ",\n    [";
    }
    return text + "\n  ]\n";
}

/// All around the normal, in the azimuths of the file.
std::vector<double> full_turn(const AngularGrid& grid, double mirror_azimuth) {
    std::vector<double> turns;
    for (const double azimuth : grid.azimuth)
        for (const double each : {azimuth, 360 - azimuth})
            turns.push_back(std::fmod(each + mirror_azimuth + 180, 360));
    turns.push_back(360);
    std::ranges::sort(turns);
    turns.erase(std::unique(turns.begin(), turns.end()), turns.end());
    return turns;
}

std::string brdf_member(const spectral::Reflectance& brdf, double mirror_azimuth) {
    AngularGrid grid = csv_grid();
    grid.symmetric = false;
    const std::vector<double> turns = full_turn(csv_grid(), mirror_azimuth);
    grid.azimuth.clear();
    for (const double turn : turns)
        if (turn < 360) grid.azimuth.push_back(std::fmod(turn + 180 + mirror_azimuth, 360));
    std::vector<double> order = grid.azimuth;
    std::ranges::sort(order);
    const std::vector<double> asked = grid.azimuth;
    grid.azimuth = order;
    const std::vector<double> values = values_on(grid, brdf);
    const auto um = brdf.wavelengths().micrometres();
    std::string text = "  \"brdf\": {\n    \"wavelengths\": [", angles;
    for (std::size_t w = 0; w < um.size(); ++w) {
        text += w == 0 ? "" : ", ";
        append_rounded(text, um[w] / metre, 12);
    }
    text += "],\n    \"lookupTable\": [";
    const char* before = "\n      [";
    for (std::size_t w = 0; w < um.size(); ++w)
        for (std::size_t i = 0; i < grid.theta_i.size(); ++i)
            for (std::size_t r = 0; r < grid.polar.size(); ++r)
                for (std::size_t a = 0; a < turns.size(); ++a) {
                    const double azimuth = asked[a < asked.size() ? a : 0];
                    const auto place =
                        static_cast<std::size_t>(std::ranges::find(order, azimuth) - order.begin());
                    const std::size_t node = (i * order.size() + place) * grid.polar.size() + r;
                    text += before;
                    append_rounded(text, um[w] / metre, 12);
                    for (const double angle : {grid.theta_i[i], grid.polar[r], turns[a]}) {
                        text += ", ";
                        append_rounded(text, std::min(angle * degree, full_turn_written), 9);
                    }
                    text += ", ";
                    append_rounded(text, values[node * um.size() + w]);
                    text += "]";
                    before = ",\n      [";
                }
    return text + "\n    ]\n  }\n";
}

}  // namespace

bool is_open_material(std::string_view text) {
    return spectral::trimmed(text).starts_with('{') &&
           text.find("\"openMaterial3dVersion\"") != std::string_view::npos;
}

bool is_open_material_brdf(std::string_view text) {
    return text.find("\"lookupTable\"") != std::string_view::npos;
}

OpenMaterial open_material(const std::string& text, const std::filesystem::path& path) {
    const JsonValue file = JsonValue::parse(text, path.string());
    require_metadata(file);
    const JsonValue properties = file["materialProperties"];
    OpenMaterial result;
    if (const auto uris = properties.find("brdfUris")) {
        const auto all = uris->items();
        if (!all.empty()) result.brdf_table = beside(all.front(), path).string();
        if (all.size() > 1)
            result.notes.push_back(std::to_string(all.size()) + " tables of BRDFs: the first is read, " +
                                   all.front().text());
    }
    const auto roughness = properties.find("surfaceRoughness"),
               optical = properties.find("opticalPropertiesUri");
    if (!roughness || !optical) {
        if (result.brdf_table.empty())
            throw properties.error(
                "holds neither surfaceRoughness with opticalPropertiesUri nor brdfUris: must "
                "hold one of them");
        return result;
    }
    ordered_json material{{"name", file["metadata"]["name"].text()}, {"model", "he"}};
    material["rms_roughness_um"] =
        metre * number_within((*roughness)["surfaceHeightRms"], 0, 1, "a height in m, from 0 to 1");
    material["correlation_length_um"] = metre * number_within((*roughness)["surfaceCorrelationLength"], 1e-12,
                                                              1, "a length in m, from 1e-12 to 1");
    const auto rows = optical_rows(beside(*optical, path), result.notes);
    if (rows.size() == 1) {
        material["index"] = {{"n", rows[0].n}, {"k", rows[0].k}};
        result.notes.push_back("optical constants at " + shortest(rows[0].um) + " um alone: taken at all");
    } else {
        ordered_json table = ordered_json::array();
        for (const OpticalRow& row : rows) table.push_back({row.um, row.n, row.k});
        material["index"] = {{"table", table}};
    }
    result.material = material.dump(2) + "\n";
    result.notes.emplace_back("sigma_0 and tau of a Gaussian correlation, by model he");
    if (!result.brdf_table.empty())
        result.notes.push_back("has a table of its BRDF, too: read " + result.brdf_table + " for that");
    return result;
}

ScatterPoints points_of_open_material(const std::string& text, const std::string& name,
                                      const std::optional<spectral::WavelengthGrid>& wavelengths,
                                      double mirror_azimuth) {
    const JsonValue file = JsonValue::parse(text, name);
    require_metadata(file);
    const auto items = file["brdf"]["lookupTable"].items();
    if (items.empty()) throw file["brdf"]["lookupTable"].error("must have a row at least");
    // values of each direction by wavelength
    std::map<std::array<double, 3>, std::map<double, double>> found;
    std::map<double, std::size_t> counts;
    NegativeValues negative;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const BrdfRow row = brdf_row(items[i], mirror_azimuth);
        if (row.value < 0) negative.note(row.value, i + 1);
        const double value = std::max(row.value, 0.0);
        const auto [place, fresh] =
            found[{row.angles.theta_i, row.angles.theta_r, row.angles.phi_r}].emplace(row.um, value);
        if (!fresh && place->second != value)
            throw items[i].error(
                "the directions and wavelength of an earlier row again: must have one value");
        ++counts[row.um];
    }
    const bool unnamed = counts.contains(0);
    if (unnamed && counts.size() > 1)
        throw file["brdf"]["lookupTable"].error("wavelengths must all be numbers, or all null");
    if (unnamed && !wavelengths) throw Error{name + ": does not say its wavelength, which must be given"};
    if (!unnamed && wavelengths) throw Error{name + ": says its wavelengths, which must not be given"};
    if (unnamed && wavelengths->size() != 1)
        throw Error{name + ": holds 1 channel, not " + std::to_string(wavelengths->size())};
    std::vector<double> um;
    um.reserve(counts.size());
    for (const auto& [each, count] : counts) um.push_back(each);
    ScatterPoints points{unnamed ? *wavelengths : spectral::WavelengthGrid::from_micrometres(um), {}, {}};
    for (const auto& [at, values] : found) {
        if (values.size() != um.size())
            throw Error{name + ": " + std::to_string(values.size()) + " of " + std::to_string(um.size()) +
                        " wavelengths at theta_i " + shortest(at[0]) + ", theta_r " + shortest(at[1]) +
                        ", phi_r " + shortest(at[2]) + " deg: must be all"};
        points.angles.push_back({at[0], 0, at[1], at[2]});
        for (const auto& [each, value] : values) points.values.push_back(value);
    }
    points.notes.push_back("azimuths counted with the mirror direction at " + shortest(mirror_azimuth) +
                           " deg, which the format leaves open");
    if (negative.count > 0) points.notes.push_back(negative.text());
    return points;
}

Exported exported_open_material(const spectral::Reflectance& brdf, const std::filesystem::path& path,
                                double mirror_azimuth) {
    if (path.extension() != ".xomp") throw Error{path.string() + ": must end in .xomp"};
    if (!brdf.properties().isotropic)
        throw Error{brdf.name() + ": depends on the azimuth of the light, which OpenMATERIAL does not know"};
    Exported result;
    result.mirror_azimuth = mirror_azimuth;
    result.sidecar.format = "ASAM OpenMATERIAL 3D (.xomp, .xompt)";
    result.sidecar.value = "f, the BRDF without the cosine";
    result.sidecar.normalisation = "none";
    result.sidecar.notes = {"phi_r from the light's azimuth; the mirror direction is at " +
                                shortest(mirror_azimuth) + " deg, which the schema leaves open",
                            "no receiverSolidAngles: values are those of single directions",
                            "license is SPDX's NOASSERTION, copyrights are not stated: fill them in"};
    const std::string stem = path.stem().string();
    const auto beside_it = [&](const char* ending) {
        return (path.parent_path() / (stem + ending)).string();
    };
    ordered_json properties = ordered_json::object();
    const auto& surface = brdf.properties().surface;
    const bool bare = std::ranges::none_of(brdf.samples(), [](const auto& s) { return s.index.coated(); });
    const bool gaussian = surface && !surface->correlation();
    std::vector<spectral::TextFile> tables;
    if (gaussian && surface->rms_roughness() >= 0) {
        properties["surfaceRoughness"] = {{"surfaceHeightRms", surface->rms_roughness() / metre},
                                          {"surfaceCorrelationLength", surface->correlation_length() / metre},
                                          {"sources", "material file of hts"}};
    } else if (surface) {
        result.sidecar.notes.emplace_back("no surfaceRoughness: the correlation is not Gaussian");
    }
    if (surface && bare) {
        properties["opticalPropertiesUri"] = stem + "_optical.xompt";
        tables.push_back({beside_it("_optical.xompt"), table_text(brdf.name(), optical_member(brdf))});
    } else if (surface) {
        result.sidecar.notes.emplace_back("no optical properties: the surface has films");
    }
    properties["brdfUris"] = {stem + "_brdf.xompt"};
    tables.push_back({beside_it("_brdf.xompt"), table_text(brdf.name(), brdf_member(brdf, mirror_azimuth))});
    const ordered_json material{{"metadata", metadata_of(brdf.name(), properties.dump())},
                                {"materialProperties", properties}};
    result.files.push_back({path.string(), material.dump(2) + "\n"});
    std::ranges::move(tables, std::back_inserter(result.files));
    return result;
}

}  // namespace hts::tables
