#include "spectral/materials/optical_constants_json.hpp"

#include <utility>

#include "hts/error.hpp"
#include "spectral/materials/index_rows.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

IndexRows index_rows(const JsonValue& table) {
    IndexRows rows;
    for (const auto& row : table.rows({"um", "n", "k"})) {
        located(row.place, [&] {
            rows.add_n(row.values[0], row.values[1]);
            rows.add_k(row.values[0], row.values[2]);
        });
    }
    return rows;
}

std::string text_or(const std::optional<JsonValue>& value, const std::string& otherwise) {
    return value ? value->text() : otherwise;
}

OpticalConstants constant_from(const JsonValue& index) {
    index.require_keys_among({"n", "k"});
    const JsonValue n = index["n"];
    const JsonValue k = index["k"];
    const double n_value = n.number();
    const double k_value = k.number();
    located(n.place(), [&] { return RefractiveIndex{n_value, 0}; });
    return located(k.place(), [&] { return OpticalConstants::constant({n_value, k_value}); });
}

OpticalConstants file_from(const JsonValue& index, const std::filesystem::path& folder) {
    index.require_keys_among({"file"});
    const JsonValue file = index["file"];
    const std::filesystem::path path = folder / file.text();
    return located(file.place(), [&] { return read_optical_constants(path); });
}

}  // namespace

OpticalConstants optical_constants_from(const JsonValue& index, const std::filesystem::path& folder) {
    if (index.is_text())
        return located(index.place(), [&] { return built_in_optical_constants(index.text()); });
    if (!index.is_object()) {
        throw index.error(R"(must be a built-in name, {"n", "k"}, {"file"} or {"table"})");
    }
    if (index.find("file")) return file_from(index, folder);
    if (index.find("table")) return optical_constants_from_json(index, index.place());
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

OpticalConstants optical_constants_from_json(const JsonValue& object, const std::string& name) {
    object.require_keys_among({"table", "name", "source"});
    const IndexRows rows = index_rows(object["table"]);
    return {text_or(object.find("name"), name), text_or(object.find("source"), object.place()),
            rows.n().value(), rows.k(), rows.notes(object.place())};
}

}  // namespace hts::spectral
