#include "tables/sharing/own_constants.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "spectral/materials/optical_constants_json.hpp"
#include "spectral/text/json_value.hpp"
#include "tables/table/between_wavelengths.hpp"

namespace hts::tables {
namespace {

using Json = nlohmann::ordered_json;

/// What replaces files of constants.
class Replacement {
  public:
    Replacement(const TableSource& source, const spectral::WavelengthGrid& wavelengths)
        : source_{source}, um_{wavelengths.micrometres().begin(), wavelengths.micrometres().end()} {
        if (const auto between = half_way(wavelengths))
            um_.insert(um_.end(), between->micrometres().begin(), between->micrometres().end());
        std::ranges::sort(um_);
    }

    /// Whether there was one.
    // NOLINTNEXTLINE(misc-no-recursion): models nest
    bool in(Json& value) const {
        bool any = false;
        for (auto& [key, part] : value.items()) {
            if (key == "index" && part.is_object() && part.contains("file")) {
                part = tabulated(part);
                any = true;
            } else if (part.is_structured()) {
                any = in(part) || any;
            }
        }
        return any;
    }

  private:
    [[nodiscard]] Json tabulated(const Json& index) const {
        const auto constants =
            spectral::optical_constants_from(spectral::JsonValue::parse(index.dump(), source_.material_path),
                                             std::filesystem::path{source_.material_path}.parent_path());
        Json rows = Json::array();
        for (const double um : um_) {
            const auto at = constants.index(Wavelength::from_micrometres(um), source_.policy);
            rows.push_back({um, at.n(), at.k()});
        }
        return {{"name", constants.name()}, {"source", constants.source()}, {"table", rows}};
    }

    const TableSource& source_;
    std::vector<double> um_;
};

}  // namespace

TableSource with_own_constants(TableSource source, const spectral::WavelengthGrid& wavelengths) {
    Json material = Json::parse(source.material);
    if (Replacement{source, wavelengths}.in(material)) source.material = material.dump(2) + "\n";
    return source;
}

}  // namespace hts::tables
