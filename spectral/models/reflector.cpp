#include "spectral/models/reflector.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/materials/optical_constants_json.hpp"
#include "spectral/models/reflector_json.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

double checked_albedo(double albedo) {
    if (!(albedo >= 0 && albedo <= 1)) throw out_of_range("diffuse albedo", albedo, "", "from 0 to 1");
    return albedo;
}

// One length at a time, so that the message has the key of the one that is wrong.
Surface surface_from(const JsonValue& file) {
    const JsonValue roughness_key = file["rms_roughness_um"];
    const JsonValue correlation_key = file["correlation_length_um"];
    const double roughness = roughness_key.number();
    const double correlation = correlation_key.number();
    located(roughness_key.place(), [&] { return Surface{roughness, longest_length}; });
    return located(correlation_key.place(), [&] { return Surface{roughness, correlation}; });
}

Material constant_from(const JsonValue& index) {
    index.require_keys_among({"n", "k"});
    const JsonValue n = index["n"];
    const JsonValue k = index["k"];
    const double n_value = n.number();
    const double k_value = k.number();
    located(n.place(), [&] { return RefractiveIndex{n_value, 0}; });
    return located(k.place(), [&] { return Material::constant({n_value, k_value}); });
}

Material file_from(const JsonValue& index, const std::filesystem::path& folder) {
    index.require_keys_among({"file"});
    const JsonValue file = index["file"];
    const std::filesystem::path path = folder / file.text();
    return located(file.place(), [&] { return read_material(path); });
}

DiffuseAlbedo albedo_from(const std::optional<JsonValue>& albedo) {
    if (!albedo) return DiffuseAlbedo{0};
    if (albedo->is_object()) {
        albedo->require_keys_among({"table"});
        return DiffuseAlbedo{number_table((*albedo)["table"], "a", checked_albedo)};
    }
    const double value = albedo->number();
    return located(albedo->place(), [&] { return DiffuseAlbedo{value}; });
}

}  // namespace

DiffuseAlbedo::DiffuseAlbedo(double albedo) : value_{ConstantValue{checked_albedo(albedo)}} {}

DiffuseAlbedo::DiffuseAlbedo(PiecewiseLinear table) : value_{ConstantValue{0}} {
    for (const auto& point : table.points()) static_cast<void>(checked_albedo(point.value));
    value_ = std::move(table);
}

double DiffuseAlbedo::operator()(const Wavelength& wavelength, OutsideRange policy) const {
    return value_at(value_, range_of(value_).admit(wavelength, policy, "diffuse albedo"));
}

Material material_from(const JsonValue& index, const std::filesystem::path& folder) {
    if (index.is_text()) return located(index.place(), [&] { return built_in_material(index.text()); });
    if (!index.is_object()) {
        throw index.error(R"(must be a built-in name, {"n", "k"}, {"file"} or {"table"})");
    }
    if (index.find("file")) return file_from(index, folder);
    if (index.find("table")) return material_from_json(index, index.place());
    if (index.find("n") || index.find("k")) return constant_from(index);
    throw index.error(R"(must have "n" and "k", or "file", or "table")");
}

PiecewiseLinear number_table(const JsonValue& table, const char* column, const NumberCheck& check) {
    std::vector<PiecewiseLinear::Point> points;
    for (const auto& row : table.rows({"um", column})) {
        located(row.place, [&] {
            const auto wavelength = Wavelength::from_micrometres(row.values[0]);
            points.push_back({wavelength.micrometres(), check(row.values[1])});
        });
    }
    return PiecewiseLinear{std::move(points)};
}

Reflector reflector_from_json(const JsonValue& description, const std::filesystem::path& folder,
                              const std::string& default_name) {
    const JsonValue model = description["model"];
    if (model.text() != "he") {
        throw model.error(in_quotes(model.text()) + ": must be he, the He-Torrance model");
    }
    description.require_keys_among(
        {"name", "model", "rms_roughness_um", "correlation_length_um", "index", "diffuse_albedo"});
    const auto name = description.find("name");
    return {name ? name->text() : default_name, surface_from(description),
            material_from(description["index"], folder), albedo_from(description.find("diffuse_albedo"))};
}

Reflector read_reflector(const std::filesystem::path& path) {
    return reflector_from_json(JsonValue::read(path), path.parent_path(), path.stem().string());
}

}  // namespace hts::spectral
