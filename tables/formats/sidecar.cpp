#include "tables/formats/sidecar.hpp"

#include <nlohmann/json.hpp>

namespace hts::tables {
namespace {

nlohmann::ordered_json specular_table(const spectral::Reflectance& brdf) {
    constexpr int angles = 37;  // every 2.5 degrees
    nlohmann::ordered_json thetas = nlohmann::json::array(), rows = nlohmann::json::array();
    std::vector<double> values(brdf.wavelengths().size());
    for (int i = 0; i < angles; ++i) {
        const double degrees = 90.0 * i / (angles - 1);
        brdf.specular_reflectance(Direction::from_degrees(degrees, 0), values);
        thetas.push_back(degrees);
        rows.push_back(values);
    }
    return {{"theta_i_deg", std::move(thetas)}, {"reflectance", std::move(rows)}};
}

}  // namespace

std::string sidecar_json(const std::filesystem::path& file, const spectral::Reflectance& brdf,
                         const Sidecar& sidecar) {
    const auto um = brdf.wavelengths().micrometres();
    nlohmann::ordered_json json{{"file", file.filename().string()},
                                {"format", sidecar.format},
                                {"name", brdf.name()},
                                {"value", sidecar.value},
                                {"units", sidecar.units},
                                {"normalisation", sidecar.normalisation},
                                {"wavelengths_um", std::vector<double>(um.begin(), um.end())},
                                {"notes", sidecar.notes}};
    if (sidecar.suggested_alpha) json["suggested_alpha"] = *sidecar.suggested_alpha;
    json["specular"] = {{"treatment", sidecar.specular}};
    json["specular"].update(specular_table(brdf));
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_with_sidecar(const std::filesystem::path& file, const spectral::Reflectance& brdf,
                        Exported exported) {
    exported.files.push_back({file.string() + ".json", sidecar_json(file, brdf, exported.sidecar)});
    spectral::write_files(exported.files);
}

}  // namespace hts::tables
