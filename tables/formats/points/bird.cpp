#include "tables/formats/points/bird.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "hts/error.hpp"
#include "hts/version.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"
#include "tables/formats/points/tokens.hpp"

namespace hts::tables {
namespace {

using spectral::JsonValue;

/// Factor to degrees or micrometres of a unit.
double unit_of(const JsonValue& variable, const std::map<std::string, double>& known) {
    const JsonValue unit = variable["unit"];
    const auto found = known.find(unit.text());
    if (found != known.end()) return found->second;
    std::vector<std::string> names;
    names.reserve(known.size());
    for (const auto& [name, factor] : known) names.push_back(name);
    throw unit.error(spectral::in_quotes(unit.text()) + ": " + spectral::must_be_one_of(unit.text(), names));
}

const std::map<std::string, double> angles{{"deg", 1}, {"°", 1}, {"rad", 180 / std::numbers::pi}};
// "\u00b5m" of a keyboard and "\u03bcm" of the schema
const std::map<std::string, double> lengths{
    {"nm", 1e-3}, {"um", 1}, {"\u00b5m", 1}, {"\u03bcm", 1}, {"m", 1e6}};
const std::map<std::string, double> per_steradian{
    {"sr-1", 1}, {"1/sr", 1}, {"sr^-1", 1}, {"sr**-1", 1}, {"sr⁻¹", 1}};

std::vector<double> numbers_of(const JsonValue& variable, double factor) {
    std::vector<double> result;
    for (const JsonValue& value : variable["values"].items()) {
        const double number = value.number();
        if (!(std::abs(number) <= largest_number)) throw value.error("must be a number of at most 1e100");
        result.push_back(factor * number);
    }
    return result;
}

/// The lists of a file, equally long.
class Variables {
  public:
    explicit Variables(JsonValue data) : data_{std::move(data)} {
        const JsonValue brdf = data_["BRDF"];
        const auto unit = brdf.find("unit");
        values_ = numbers_of(brdf, unit ? unit_of(brdf, per_steradian) : 1);
        if (values_.empty()) throw brdf["values"].error("must have a value at least");
    }

    [[nodiscard]] const std::vector<double>& values() const noexcept { return values_; }
    [[nodiscard]] std::vector<double> angle(const char* name) const {
        return as_long(name, numbers_of(data_[name], unit_of(data_[name], angles)));
    }
    /// Of the light and of what is seen of it, which must be the same.
    [[nodiscard]] std::optional<std::vector<double>> wavelengths() const {
        std::optional<std::vector<double>> result;
        for (const char* name : {"wavelength", "wavelength_i", "wavelength_r"}) {
            const auto variable = data_.find(name);
            if (!variable) continue;
            auto list = as_long(name, numbers_of(*variable, unit_of(*variable, lengths)));
            const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * b; };
            if (result && !std::ranges::equal(list, *result, same))
                throw variable->error("differs from the wavelengths before it: must be one of each point");
            result = std::move(list);
        }
        return result;
    }
    /// What is said of polarisation; hts::Error where it is not the same of all points.
    [[nodiscard]] std::string polarisation() const {
        std::set<std::string> kinds;
        for (const char* name : {"polarisation", "polarization", "polarisation_i", "polarization_i",
                                 "polarisation_r", "polarization_r"}) {
            const auto variable = data_.find(name);
            if (!variable) continue;
            for (const JsonValue& value : (*variable)["values"].items())
                kinds.insert(value.is_text() ? value.text() : shortest(value.number()));
            if (kinds.size() > 1)
                throw variable->error("several kinds, " +
                                      spectral::joined(std::vector<std::string>{kinds.begin(), kinds.end()}) +
                                      ": must be one, since a BRDF is read for unpolarised light");
        }
        return kinds.empty() ? "" : *kinds.begin();
    }
    [[nodiscard]] bool has_uncertainty() const {
        return data_["BRDF"].find("uncertainty") || data_.find("uBRDF");
    }

  private:
    [[nodiscard]] std::vector<double> as_long(const char* name, std::vector<double> list) const {
        if (list.size() == values_.size()) return list;
        throw data_[name]["values"].error(std::to_string(list.size()) +
                                          " values: must be as many as BRDF has, " +
                                          std::to_string(values_.size()));
    }

    JsonValue data_;
    std::vector<double> values_;
};

/// What the schema requires, with "not stated" for what only the user knows.
nlohmann::ordered_json metadata_of(const spectral::Reflectance& brdf, const std::string& uuid) {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 32> timestamp{};
    static_cast<void>(std::strftime(timestamp.data(), timestamp.size(), "%Y-%m-%dT%H:%M:%S+00:00", &utc));
    using nlohmann::ordered_json;
    const char* const open = "not stated";
    ordered_json parameters = ordered_json::array();
    if (const auto& surface = brdf.properties().surface) {
        parameters.push_back({{"name", "rms roughness"},
                              {"description", "root mean square of the heights"},
                              {"value", surface->rms_roughness()},
                              {"unit", "um"}});
        parameters.push_back({{"name", "correlation length"},
                              {"description", "length of the heights' autocorrelation"},
                              {"value", surface->correlation_length()},
                              {"unit", "um"}});
    }
    return {{"schema",
             "https://raw.githubusercontent.com/BiRD-project/BiRD_view/master/BRDF_JSON_schema/"
             "brdf_json_schema_v1.0.json"},
            {"id", "urn:uuid:" + uuid},
            {"type", "BRDF"},
            {"timestamp", timestamp.data()},
            {"provenance",
             {{"organization", open},
              {"location",
               {{"country", open},
                {"city", open},
                {"street", open},
                {"building_nr", open},
                {"postal_code", open}}},
              {"email", "not.stated@example.invalid"},
              {"contact_person", open}}},
            {"license", {{"type", open}, {"rights_holder", open}}},
            {"method", "simulation"},
            {"instrumentation", "NA"},
            {"software",
             {{"name", "hts"},
              {"version", HTS_VERSION},
              {"description", "physical-optics reflectance of rough surfaces"},
              {"simulation_model",
               {{"name", brdf.name()},
                {"description", "model of a material file of hts; diffuse terms, without the mirror term"},
                {"parameters", parameters}}}}},
            {"sample",
             {{"name", brdf.name()},
              {"type", "computed surface"},
              {"shape", "plane"},
              {"dimensions", ordered_json::object()},
              {"zero_azimuth_location", "x axis of the surface"}}},
            {"environment", "NA"}};
}

double polar_angle(double degrees, const std::string& name, const char* variable, std::size_t i) {
    if (degrees >= 0 && degrees <= 90 + 1e-4) return std::min(degrees, 90.0);
    throw Error{name + ": " + variable + ", value " + std::to_string(i + 1) + ": " +
                out_of_range("polar angle", degrees, "deg", "from 0 to 90").what()};
}

}  // namespace

bool is_bird_file(std::string_view text) {
    if (!spectral::trimmed(text).starts_with('{')) return false;
    constexpr std::array keys{"\"data\"", "\"BRDF\"", "\"theta_i\"", "\"theta_r\""};
    return std::ranges::all_of(keys,
                               [&](const char* key) { return text.find(key) != std::string_view::npos; });
}

bool bird_names_wavelengths(const std::string& text, const std::string& name) {
    return Variables{JsonValue::parse(text, name)["data"]}.wavelengths().has_value();
}

ScatterPoints points_of_bird(const std::string& text, const std::string& name,
                             const std::optional<spectral::WavelengthGrid>& wavelengths,
                             double mirror_azimuth) {
    const JsonValue file = JsonValue::parse(text, name);
    const Variables data{file["data"]};
    const auto theta_i = data.angle("theta_i"), phi_i = data.angle("phi_i"), theta_r = data.angle("theta_r"),
               phi_r = data.angle("phi_r");
    const auto own = data.wavelengths();
    if (own && wavelengths) throw Error{name + ": says its wavelengths, which must not be given"};
    if (!own && !wavelengths) throw Error{name + ": does not say its wavelength, which must be given"};
    if (!own && wavelengths->size() != 1)
        throw Error{name + ": holds 1 channel, not " + std::to_string(wavelengths->size())};
    std::map<std::array<double, 4>, std::map<double, double>> found;
    std::set<double> um;
    NegativeValues negative;
    for (std::size_t i = 0; i < data.values().size(); ++i) {
        const double at = own ? (*own)[i] : wavelengths->micrometres()[0];
        const double value = data.values()[i];
        if (value < 0) negative.note(value, i + 1);
        const std::array<double, 4> angles_of{polar_angle(theta_i[i], name, "theta_i", i), phi_i[i],
                                              polar_angle(theta_r[i], name, "theta_r", i),
                                              phi_r[i] + 180 - mirror_azimuth};
        const auto [place, fresh] = found[angles_of].emplace(at, std::max(value, 0.0));
        if (!fresh && place->second != std::max(value, 0.0))
            throw Error{name + ": value " + std::to_string(i + 1) +
                        ": the directions and wavelength of an earlier one again: must have one value"};
        um.insert(at);
    }
    ScatterPoints points{
        spectral::located(name,
                          [&] {
                              return spectral::WavelengthGrid::from_micrometres({um.begin(), um.end()});
                          }),
        {},
        {}};
    for (const auto& [at, values] : found) {
        if (values.size() != um.size())
            throw Error{name + ": " + std::to_string(values.size()) + " of " + std::to_string(um.size()) +
                        " wavelengths at theta_i " + shortest(at[0]) + ", theta_r " + shortest(at[2]) +
                        ", phi_r " + shortest(at[3]) + " deg: must be all"};
        points.angles.push_back({at[0], at[1], at[2], at[3]});
        for (const auto& [each, value] : values) points.values.push_back(value);
    }
    points.notes.push_back("azimuths counted with the mirror direction at phi_i + " +
                           shortest(mirror_azimuth) + " deg");
    if (const std::string kind = data.polarisation(); !kind.empty())
        points.notes.push_back("polarisation " + spectral::in_quotes(kind) + ": taken for unpolarised light");
    if (data.has_uncertainty())
        points.notes.emplace_back("has uncertainties, which a reflectance does not hold");
    if (negative.count > 0) {
        points.notes.push_back(std::to_string(negative.count) + " values are negative, the least " +
                               spectral::brief(negative.least) + " 1/sr: taken as 0");
    }
    return points;
}

std::string bird_text(const spectral::Reflectance& brdf, AngularGrid grid) {
    grid.check();
    if (grid.symmetric && !is_plane_symmetric(brdf)) {
        grid = without_symmetry(std::move(grid));
        grid.azimuth.pop_back();  // 360 is 0 again
    }
    const std::vector<double> values = values_on(grid, brdf);
    const auto um = brdf.wavelengths().micrometres();
    std::array<std::string, 6> lists;  // theta_i, phi_i, theta_r, phi_r, wavelength, BRDF
    const auto append = [&](std::size_t list, double value, int digits) {
        if (!lists[list].empty()) lists[list] += lists[list].size() % 4096 < 8 ? ",\n" : ",";
        append_rounded(lists[list], value, digits);
    };
    for (std::size_t node = 0; node < grid.size(); ++node) {
        const std::size_t row = node / grid.polar.size(), slice = row / grid.azimuth.size();
        const double phi_i = grid.phi_i[slice / grid.theta_i.size()];
        for (std::size_t w = 0; w < um.size(); ++w) {
            append(0, grid.theta_i[slice % grid.theta_i.size()], 9);
            append(1, phi_i, 9);
            append(2, grid.polar[node % grid.polar.size()], 9);
            append(3, std::fmod(phi_i + grid.azimuth[row % grid.azimuth.size()], 360), 9);
            append(4, 1000 * um[w], 9);
            append(5, values[node * um.size() + w], 6);
        }
    }
    for (std::string& list : lists) list.insert(0, 1, '[') += ']';
    const auto unit = [](const char* name) {
        return std::string{"\"unit\": \""} + name + "\", \"values\": ";
    };
    std::string data;
    constexpr std::array names{"theta_i", "phi_i", "theta_r", "phi_r", "wavelength_i"};
    for (std::size_t i = 0; i < names.size(); ++i)
        data += std::string{"\""} + names[i] + "\": {" + unit(i < 4 ? "deg" : "nm") + lists[i] + "},\n";
    data +=
        "\"BRDF\": {\"uncertainty\": {\"value\": 0.001, \"unit\": \"%\"}, \"comments\": "
        "\"uncertainty of the numbers; that of the model is not in it\", " +
        unit("1/sr") + lists[5] + "}\n";
    return "{\n\"metadata\": " + metadata_of(brdf, uuid_of(data)).dump(2) + ",\n\"data\": {\n" + data +
           "}\n}\n";
}

}  // namespace hts::tables
