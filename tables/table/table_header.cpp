// The header of tables: JSON in, JSON out.

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "hts/version.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"
#include "tables/table/spline.hpp"
#include "tables/table/table_contents.hpp"
#include "tables/table/table_lobe.hpp"

namespace hts::tables {
namespace {

using nlohmann::ordered_json;
using spectral::JsonValue;

constexpr std::size_t most_nodes = 65536;  // along one axis

double number_within(const JsonValue& key, double least, double most) {
    const double value = key.number();
    if (value >= least && value <= most) return value;
    throw key.error(shortest(value) + ": must be from " + shortest(least) + " to " + shortest(most));
}

std::size_t whole_within(const JsonValue& key, std::size_t least, std::size_t most) {
    const double value = number_within(key, static_cast<double>(least), static_cast<double>(most));
    if (value != std::floor(value)) throw key.error(shortest(value) + ": must be a whole number");
    return static_cast<std::size_t>(value);
}

std::size_t nodes_from(const JsonValue& nodes, const char* axis) {
    return whole_within(nodes[axis], fewest_nodes, most_nodes);
}

TableNodes nodes_from(const JsonValue& nodes) {
    nodes.require_keys_among({"grazing", "ratio", "turn", "specular", "albedo", "polarisation"});
    const bool polarised = nodes["polarisation"].number() != 0;
    return {nodes_from(nodes, "grazing"), nodes_from(nodes, "ratio"),
            nodes_from(nodes, "turn"),    nodes_from(nodes, "specular"),
            nodes_from(nodes, "albedo"),  polarised ? nodes_from(nodes, "polarisation") : 0};
}

spectral::WavelengthGrid wavelengths_from(const JsonValue& key) {
    std::vector<double> micrometres;
    for (const JsonValue& item : key.items()) micrometres.push_back(item.number());
    return spectral::located(
        key.place(), [&] { return spectral::WavelengthGrid::from_micrometres(std::move(micrometres)); });
}

TableError error_from(const JsonValue& error) {
    error.require_keys_among({"median", "percentile_99", "largest", "pairs", "seed"});
    constexpr double most = 1e300;
    constexpr std::size_t most_whole = std::size_t{1} << 53;
    return {number_within(error["median"], 0, most), number_within(error["percentile_99"], 0, most),
            number_within(error["largest"], 0, most), whole_within(error["pairs"], 0, most_whole),
            whole_within(error["seed"], 0, most_whole)};
}

bool is_clamp(const JsonValue& key) {
    if (key.text() == "clamp" || key.text() == "error") return key.text() == "clamp";
    throw key.error(spectral::in_quotes(key.text()) + ": must be clamp or error");
}

bool is_double(const JsonValue& key) {
    if (key.text() == "float" || key.text() == "double") return key.text() == "double";
    throw key.error(spectral::in_quotes(key.text()) + ": must be float or double");
}

}  // namespace

std::string library_version() {
    return HTS_VERSION;
}

std::string header_text(const TableInfo& info) {
    const auto um = info.wavelengths.micrometres();
    ordered_json header;
    header["name"] = info.source.name;
    header["library_version"] = info.library_version;
    header["quantity"] =
        "ln(f + floor), f the directional-diffuse BRDF without cosine [1/sr]; components of its spectrum";
    header["coordinates"] = "grazing, ratio, turn; up to 88 degrees";
    header["wavelengths_um"] = std::vector<double>(um.begin(), um.end());
    header["tolerance"] = info.tolerance;
    header["error"] = {{"median", info.error.median},
                       {"percentile_99", info.error.percentile_99},
                       {"largest", info.error.largest},
                       {"pairs", info.error.pairs},
                       {"seed", info.error.seed}};
    header["spacing"] = {{"grazing", info.spacing.grazing}, {"turn", info.spacing.turn}};
    header["nodes"] = {{"grazing", info.nodes.grazing}, {"ratio", info.nodes.ratio},
                       {"turn", info.nodes.turn},       {"specular", info.nodes.specular},
                       {"albedo", info.nodes.albedo},   {"polarisation", info.nodes.polarisation}};
    header["components"] = info.components;
    header["numbers"] = info.double_precision ? "double" : "float";
    header["outside_range"] = info.source.policy == spectral::OutsideRange::hold ? "clamp" : "error";
    header["material_path"] = info.source.material_path;
    header["material"] = info.source.material;
    return header.dump(1);
}

TableInfo info_from_header(std::string_view text, const std::string& name) {
    const JsonValue header = JsonValue::parse(std::string{text}, name);
    header.require_keys_among({"name", "library_version", "quantity", "coordinates", "wavelengths_um",
                               "tolerance", "error", "spacing", "nodes", "components", "numbers",
                               "outside_range", "material_path", "material"});
    const JsonValue spacing = header["spacing"];
    spacing.require_keys_among({"grazing", "turn"});
    constexpr double least_spacing = 0.1, most_spacing = 100;
    return {
        {header["name"].text(), header["material"].text(), header["material_path"].text(),
         is_clamp(header["outside_range"]) ? spectral::OutsideRange::hold : spectral::OutsideRange::error},
        wavelengths_from(header["wavelengths_um"]),
        number_within(header["tolerance"], hts::accuracy::finest_tolerance, 1),
        error_from(header["error"]),
        {number_within(spacing["grazing"], least_spacing, most_spacing),
         number_within(spacing["turn"], least_spacing, most_spacing)},
        nodes_from(header["nodes"]),
        whole_within(header["components"], 1, most_components),
        is_double(header["numbers"]),
        header["library_version"].text()};
}

}  // namespace hts::tables
