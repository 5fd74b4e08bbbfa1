// The recipe of an import: what the imported file itself does not say.

#include <algorithm>
#include <array>
#include <cmath>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "validation/curves/curve_import.hpp"
#include "validation/curves/curve_json.hpp"

namespace hts::validation {

static const char* name(ImportFormat format) noexcept {
    constexpr std::array names{"csv", "fred", "astm", "digitised"};
    return names[static_cast<std::size_t>(format)];
}

static const char* name(Sweep sweep) noexcept {
    constexpr std::array names{"outgoing", "incident", "scattered"};
    return names[static_cast<std::size_t>(sweep)];
}

namespace {

using spectral::JsonValue;

constexpr std::array formats{ImportFormat::csv, ImportFormat::fred, ImportFormat::astm,
                             ImportFormat::digitised};
constexpr std::array sweeps{Sweep::outgoing, Sweep::incident, Sweep::scattered};

double number_or(const JsonValue& object, const char* key, double otherwise, double least, double most) {
    const auto found = object.find(key);
    if (!found) return otherwise;
    const double value = found->number();
    if (value >= least && value <= most) return value;
    throw found->error(
        shortest(value).append(": must be ").append(shortest(least)).append(" ... ").append(shortest(most)));
}

bool flag(const JsonValue& object, const char* key) {
    const auto found = object.find(key);
    return found && found->boolean();
}

/// A key that may hold one of two numbers only.
double one_of(const JsonValue& object, const char* key, double usual, double other) {
    const double value = number_or(object, key, usual, -180, 180);
    if (value == usual || value == other) return value;
    throw object[key].error(
        shortest(value).append(": must be ").append(shortest(usual)).append(" or ").append(shortest(other)));
}

Selection selection_from(const JsonValue& keep) {
    keep.require_keys_among({"least_theta_deg", "largest_theta_deg", "least_apart_deg",
                             "least_from_mirror_deg", "positive_only", "in_plane_only", "every",
                             "all_within_deg_of_mirror"});
    Selection result;
    result.least_theta = number_or(keep, "least_theta_deg", 0, 0, 90);
    result.largest_theta = number_or(keep, "largest_theta_deg", 90, 0, 90);
    result.least_apart = number_or(keep, "least_apart_deg", 0, 0, 180);
    result.least_from_mirror = number_or(keep, "least_from_mirror_deg", 0, 0, 180);
    result.positive_only = flag(keep, "positive_only");
    result.in_plane_only = flag(keep, "in_plane_only");
    const double every = number_or(keep, "every", 1, 1, 1000);
    if (every != std::floor(every)) throw keep["every"].error(shortest(every) + ": must be a whole number");
    result.every = static_cast<int>(every);
    result.all_within = number_or(keep, "all_within_deg_of_mirror", 0, 0, 180);
    return result;
}

std::map<std::string, std::string> columns_from(const JsonValue& columns, bool hemispherical) {
    columns.require_keys_among({"theta_i", "phi_i", "theta_r", "phi_r"});
    std::map<std::string, std::string> result;
    for (const char* angle : {"theta_i", "phi_i", "theta_r", "phi_r"})
        if (const auto found = columns.find(angle)) result[angle] = found->text();
    if (result.contains("phi_i") != result.contains("phi_r"))
        throw columns.error(
            "one azimuth alone: must be both phi_i and phi_r, or none for the plane of incidence");
    for (const char* angle : {"theta_i", "theta_r"}) {
        const bool view = hemispherical && std::string_view{angle} != "theta_i";
        if (view == result.contains(angle))
            throw view ? columns[angle].error("must not be there: the light leaves into all directions")
                       : columns[angle].error("missing");
    }
    return result;
}

std::vector<ValueColumn> values_from(const JsonValue& list, ImportFormat format) {
    std::vector<ValueColumn> result;
    for (const JsonValue& item : list.items()) {
        item.require_keys_among({"column", "uncertainty_column", "wavelength_um", "band_um"});
        const bool named = format == ImportFormat::csv || format == ImportFormat::astm;
        ValueColumn value{named ? item["column"].text() : "", {}};
        if (const auto own = item.find("uncertainty_column")) {
            if (format != ImportFormat::csv) throw own->error("must come with format \"csv\"");
            value.uncertainty = own->text();
        }
        const bool lit = item.find("wavelength_um") || item.find("band_um");
        if (lit || format != ImportFormat::astm) value.band = band_from(item);
        result.push_back(std::move(value));
    }
    if (result.empty()) throw list.error("must name at least one column of values");
    return result;
}

/// Uncertainties of the values come from one source.
void require_one_uncertainty(const JsonValue& file, const ImportRecipe& recipe) {
    const auto own = [](const ValueColumn& value) { return !value.uncertainty.empty(); };
    const auto columns = std::ranges::count_if(recipe.values, own);
    if (columns > 0 && columns < std::ranges::ssize(recipe.values))
        throw file["values"].error("\"uncertainty_column\" of some: must be of all or of none");
    const bool relative = recipe.relative_uncertainty > 0;
    if (recipe.uncertainty_from_reciprocity && (columns > 0 || relative))
        throw file["uncertainty_from_reciprocity"].error(
            "true: must not stand beside uncertainties that are known");
    if (columns > 0 && relative)
        throw file["relative_uncertainty"].error("must not stand beside \"uncertainty_column\"");
}

}  // namespace

ImportRecipe read_recipe(const std::filesystem::path& path, const std::string& surface) {
    const JsonValue file = JsonValue::read(path);
    auto keys = head_keys();
    keys.insert(keys.end(),
                {"format", "sweep", "columns", "values", "mirror_sign", "mirror_azimuth_deg", "keep", "rows",
                 "resolution", "relative_uncertainty", "uncertainty_from_reciprocity"});
    file.require_keys_among(keys);
    ImportRecipe recipe;
    recipe.format = named(file["format"], formats);
    recipe.emissivity = file["quantity"].text() == "emissivity";
    recipe.head = head_from(file, surface, recipe.emissivity);
    const bool digitised = recipe.format == ImportFormat::digitised;
    const bool hemispherical = recipe.head.quantity == Quantity::hemispherical_reflectance;
    if (hemispherical && recipe.format != ImportFormat::csv)
        throw file["quantity"].error("must come with format \"csv\"");
    recipe.sweep = Sweep::incident;
    if (!digitised && !hemispherical) recipe.sweep = named(file["sweep"], sweeps);
    if (recipe.format == ImportFormat::csv)
        recipe.angle_columns = columns_from(file["columns"], hemispherical);
    if (const auto rows = file.find("rows")) {
        rows->require_keys_among({"column", "text"});
        recipe.row_column = (*rows)["column"].text();
        recipe.row_text = (*rows)["text"].text();
    }
    if (!digitised && (recipe.format != ImportFormat::astm || file.find("values")))
        recipe.values = values_from(file["values"], recipe.format);
    recipe.mirror_sign = one_of(file, "mirror_sign", 1, -1);
    recipe.mirror_azimuth = one_of(file, "mirror_azimuth_deg", 180, 0);
    if (const auto keep = file.find("keep")) recipe.selection = selection_from(*keep);
    recipe.resolution = number_or(file, "resolution", 0, 0, 1e6);
    recipe.relative_uncertainty = number_or(file, "relative_uncertainty", 0, 0, 10);
    recipe.uncertainty_from_reciprocity = flag(file, "uncertainty_from_reciprocity");
    require_one_uncertainty(file, recipe);
    return recipe;
}

}  // namespace hts::validation
