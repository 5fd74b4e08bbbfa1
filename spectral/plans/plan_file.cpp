// The plan file: what a plan decided, so that it need not be measured again, and what it was decided for.

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hts/error.hpp"
#include "hts/version.hpp"
#include "spectral/plans/plan.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* format = "hts plan";
constexpr int format_version = 1;

// ---- writing

ordered_json object(const MeasuredRung& measured) {
    const auto um = measured.rung.wavelengths.micrometres();
    ordered_json result;
    result["lobe"] = name(measured.rung.lobe);
    result["lobe_tolerance"] = measured.rung.lobe_tolerance.relative_error();
    result["specular"] = measured.rung.specular;
    result["wavelengths_um"] = std::vector<double>(um.begin(), um.end());
    if (const RungTable& table = measured.rung.table; !table.empty())
        result["table"] = {{"file", table.file}, {"checksum", table.checksum}};
    result["worst_error"] = measured.error.worst;
    result["error_99_percent"] = measured.error.percentile_99;
    return result;
}

ordered_json object(const PlannedMaterial& material) {
    ordered_json result;
    result["name"] = material.name;
    result["choice"] = object(material.choice);
    result["rejected"] = ordered_json::array();
    for (const MeasuredRung& rung : material.rejected) result["rejected"].push_back(object(rung));
    return result;
}

// ---- reading

Error made_for_another(const JsonValue& key, const std::string& found, const std::string& expected) {
    return key.error(found + ": the plan was made for another " + expected + "; plan the scene again");
}

void require_version(const JsonValue& file) {
    const JsonValue kind = file["format"];
    if (kind.text() != format) throw kind.error(in_quotes(kind.text()) + ": must be " + in_quotes(format));
    const JsonValue number = file["format_version"];
    if (number.number() != format_version) {
        throw made_for_another(number, shortest(number.number()),
                               "format than " + std::to_string(format_version));
    }
    const JsonValue library = file["library_version"];
    if (library.text() != HTS_VERSION) {
        throw made_for_another(library, in_quotes(library.text()),
                               "version of the library than " HTS_VERSION);
    }
}

void require_scene(const JsonValue& key, const Scene& scene) {
    const std::string now = fingerprint(scene);
    if (key.text() == now) return;
    throw made_for_another(key, in_quotes(key.text()),
                           "scene, or " + scene.path.string() + " or its materials have changed since (now " +
                               in_quotes(now) + ")");
}

double whole_number(const JsonValue& key) {
    constexpr double largest = 0x1p53;
    const double value = key.number();
    if (value >= 0 && value <= largest && value == std::floor(value)) return value;
    throw key.error(shortest(value) + ": must be a whole number from 0 to 2^53");
}

DiffuseLobe lobe_from(const JsonValue& key) {
    for (const DiffuseLobe lobe :
         {DiffuseLobe::none, DiffuseLobe::first_order, DiffuseLobe::rough_limit, DiffuseLobe::full}) {
        if (key.text() == name(lobe)) return lobe;
    }
    throw key.error(in_quotes(key.text()) + ": must be none, first_order, rough_limit or full");
}

WavelengthGrid wavelengths_from(const JsonValue& key) {
    std::vector<double> micrometres;
    for (const JsonValue& item : key.items()) micrometres.push_back(item.number());
    return located(key.place(), [&] { return WavelengthGrid::from_micrometres(std::move(micrometres)); });
}

RungTable table_from(const JsonValue& value) {
    value.require_keys_among({"file", "checksum"});
    return {value["file"].text(), value["checksum"].text()};
}

MeasuredRung rung_from(const JsonValue& value) {
    value.require_keys_among(
        {"lobe", "lobe_tolerance", "specular", "wavelengths_um", "table", "worst_error", "error_99_percent"});
    const JsonValue tolerance = value["lobe_tolerance"];
    const auto table = value.find("table");
    return {
        {lobe_from(value["lobe"]), located(tolerance.place(), [&] { return Tolerance{tolerance.number()}; }),
         value["specular"].boolean(), wavelengths_from(value["wavelengths_um"]),
         table ? table_from(*table) : RungTable{}},
        {value["worst_error"].number(), value["error_99_percent"].number()}};
}

void require_wavelengths(const JsonValue& key, const Rung& rung, const Scene& scene) {
    const auto um = rung.wavelengths.micrometres(), all = scene.wavelengths.micrometres();
    if (um.front() < all.front() || um.back() > all.back()) {
        throw key.error("must be from " + shortest(all.front()) + " to " + shortest(all.back()) +
                        " um, the range of the scene");
    }
}

/// Where a plan stands, and who opens the tables beside it.
struct PlanPlace {
    fs::path folder;
    const OpenTable& open_table;
};

PlannedForm form_from(const JsonValue& choice, const Scene& scene, const Material& material, const Rung& rung,
                      const PlanPlace& place) {
    if (rung.table.empty())
        return located(choice.place(), [&] { return MaterialForms{scene, material}.at(rung); });
    const JsonValue table = choice["table"];
    if (!place.open_table) throw table.error("must be read by a program that has tables");
    return located(table.place(), [&] {
        const fs::path file = place.folder / rung.table.file;
        auto opened = place.open_table(file, rung.table.checksum);
        if (opened.name() != material.name()) {
            throw Error{file.string() + ": table of " + in_quotes(opened.name()) + ": must be of " +
                        in_quotes(material.name())};
        }
        return PlannedForm{scene, rung, std::move(opened)};
    });
}

PlannedMaterial planned_from(const JsonValue& value, const Scene& scene, const Material& material,
                             const PlanPlace& place) {
    value.require_keys_among({"name", "choice", "rejected"});
    const JsonValue name = value["name"];
    if (name.text() != material.name()) {
        throw name.error(in_quotes(name.text()) + ": must be " + in_quotes(material.name()) +
                         ", as in the scene");
    }
    std::vector<MeasuredRung> rejected;
    for (const JsonValue& rung : value["rejected"].items()) rejected.push_back(rung_from(rung));
    const JsonValue choice = value["choice"];
    MeasuredRung chosen = rung_from(choice);
    require_wavelengths(choice["wavelengths_um"], chosen.rung, scene);
    PlannedForm form = form_from(choice, scene, material, chosen.rung, place);
    return {material.name(), std::move(chosen), std::move(rejected), std::move(form)};
}

std::vector<PlannedMaterial> materials_from(const JsonValue& list, const Scene& scene,
                                            const PlanPlace& place) {
    const auto items = list.items();
    if (items.size() != scene.materials.size()) {
        throw list.error(std::to_string(items.size()) + " materials: must be " +
                         std::to_string(scene.materials.size()) + ", as in the scene");
    }
    std::vector<PlannedMaterial> materials;
    for (std::size_t i = 0; i < items.size(); ++i)
        materials.push_back(planned_from(items[i], scene, scene.materials[i], place));
    return materials;
}

}  // namespace

std::string plan_text(const Plan& plan, const fs::path& folder) {
    ordered_json file;
    file["format"] = format;
    file["format_version"] = format_version;
    file["library_version"] = HTS_VERSION;
    file["scene"] = fs::proximate(plan.scene.path, folder.empty() ? "." : folder).generic_string();
    file["scene_fingerprint"] = fingerprint(plan.scene);
    file["measure"] = name(plan.scene.measure);
    file["tolerance"] = plan.tolerance;
    file["seed"] = plan.sampling.seed;
    file["pairs"] = plan.sampling.pairs;
    file["bytes"] = plan.bytes();
    for (const PlannedMaterial& material : plan.materials) file["materials"].push_back(object(material));
    return file.dump(2) + "\n";
}

Plan read_plan(const fs::path& path, const std::vector<ModelEntry>& models, const OpenTable& open_table) {
    const JsonValue file = JsonValue::read(path);
    require_version(file);
    file.require_keys_among({"format", "format_version", "library_version", "scene", "scene_fingerprint",
                             "measure", "tolerance", "seed", "pairs", "bytes", "materials"});
    const JsonValue scene_path = file["scene"];
    const Scene scene = located(scene_path.place(),
                                [&] { return read_scene(path.parent_path() / scene_path.text(), models); });
    require_scene(file["scene_fingerprint"], scene);
    const JsonValue tolerance = file["tolerance"];
    located(tolerance.place(), [&] { require_tolerance(scene.measure, tolerance.number()); });
    const PlanSampling sampling{static_cast<std::uint64_t>(whole_number(file["seed"])),
                                static_cast<std::size_t>(whole_number(file["pairs"]))};
    return {scene, tolerance.number(), sampling,
            materials_from(file["materials"], scene, {path.parent_path(), open_table})};
}

}  // namespace hts::spectral
