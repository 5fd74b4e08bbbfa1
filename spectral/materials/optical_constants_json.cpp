#include "spectral/materials/optical_constants_json.hpp"

#include <utility>

#include "spectral/materials/index_rows.hpp"
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

}  // namespace

Material material_from_json(const JsonValue& object, const std::string& name) {
    object.require_keys_among({"table", "name", "source"});
    const IndexRows rows = index_rows(object["table"]);
    return {text_or(object.find("name"), name), text_or(object.find("source"), object.place()),
            rows.n().value(), rows.k()};
}

}  // namespace hts::spectral
