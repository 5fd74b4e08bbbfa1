#include "validation/fit/fit_model.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "spectral/models/model_readers.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using nlohmann::ordered_json;

// ---- the numbers of material files

const std::vector<double> width_starts{0.03, 0.1, 0.25, 0.5, 1};
const std::vector<double> exponent_starts{3, 10, 40, 200, 1000};

ParameterRange linear(const char* key, const char* symbol, double highest) {
    return {key, symbol, "1", Motion::linear, 0, highest, {0.3 * std::min(highest, 1.0)}};
}
ParameterRange width(const char* key, const char* tied_to = "") {
    return {key, key, "1", Motion::factors, 1e-3, 30, width_starts, StartUnit::own, tied_to};
}
/// Of Ashikhmin's Gaussian density of normals.
ParameterRange slope(const std::string& name, const char* tied_to = "") {
    return {"normals/" + name, name,           "1",    Motion::factors, 0.02, 30,
            {0.1, 0.3, 0.8},   StartUnit::own, tied_to};
}
ParameterRange exponent(const char* key, const char* tied_to = "") {
    return {key, key, "1", Motion::factors, 0.1, 1e6, exponent_starts, StartUnit::own, tied_to};
}
ParameterRange stretch(const char* key, const char* tied_to = "") {
    return {key, key, "1", Motion::steps, -3, 3, {-1}, StartUnit::own, tied_to};
}

const ParameterRange rms_roughness{
    "rms_roughness_um",   "sigma0", "um", Motion::factors, 1e-4, 1e3, {0.05, 0.15, 0.5, 2},
    StartUnit::wavelength};
const ParameterRange correlation_length{
    "correlation_length_um", "tau", "um", Motion::factors, 1e-3, 1e5, {2.5, 6, 15, 50}, StartUnit::previous};
const ParameterRange albedo = linear("diffuse_albedo", "a", 1);
const ParameterRange kd = linear("kd", "kd", 1);
const ParameterRange ks = linear("ks", "ks", 1e6);
const ParameterRange f0{"f0", "f0", "1", Motion::steps, 0, 1, {0.05, 0.7}};
const ParameterRange slope_angle{"slope_angle_deg", "slope_angle", "deg", Motion::steps, 0, 90, {10, 40}};
const ParameterRange alpha{"alpha", "alpha", "1", Motion::steps, 0, 1.99, {0.1, 0.8}};
const ParameterRange index_n{"n", "n", "1", Motion::factors, 0.05, 50, {1.5}};
const ParameterRange index_k{"k", "k", "1", Motion::steps, 0, 100, {0}, StartUnit::own, "", true};

FitFamily facets(const char* name, const char* distribution, const ParameterRange& shape) {
    return {name, "walter", {{"distribution", ordered_json(distribution).dump()}}, {shape, index_n, index_k},
            {},   true};
}

// ---- JSON

/// Whether a parameter has a value of its own in every channel.
bool by_channel(const ParameterRange& range) {
    return range.motion == Motion::linear;
}

std::string channel_name(const FitLayout& layout, std::size_t channel) {
    double first = 0, last = 0;
    for (std::size_t i = layout.wavelengths.size(); i-- > 0;) {
        if (layout.channels[i] != channel) continue;
        if (last == 0) last = layout.wavelengths[i];
        first = layout.wavelengths[i];
    }
    const auto text = [](double um) { return ordered_json(um).dump(); };
    std::string name = std::string{"@"}.append(text(first));
    if (first != last) name.append("-").append(text(last));
    return name.append("um");
}

/// {"table": [[um, value], …]} under construction: the rows of one channel.
void set_channel(ordered_json& place, const FitLayout& layout, std::size_t channel, double value) {
    if (place.is_null()) place["table"] = ordered_json::array();
    auto& rows = place["table"];
    for (std::size_t i = 0; i < layout.wavelengths.size(); ++i) {
        if (layout.channels[i] == channel) rows.push_back({layout.wavelengths[i], value});
    }
    std::sort(rows.begin(), rows.end(),
              [](const ordered_json& a, const ordered_json& b) { return a[0] < b[0]; });
}

const FitFamily& family_named(const std::string& name) {
    const auto& all = fit_families();
    const auto found = std::ranges::find(all, name, &FitFamily::name);
    if (found != all.end()) return *found;
    std::vector<std::string> names;
    for (const FitFamily& family : all) names.push_back(family.name);
    throw RequestError{"model " + spectral::in_quotes(name) + " is not known: must be one of " +
                       spectral::joined(names)};
}

}  // namespace

// A line per model: its name here and in material files, keys that are no numbers, numbers, numbers of each lobe.
const std::vector<FitFamily>& fit_families() {
    static const std::vector<FitFamily> families{
        {"he", "he", {}, {rms_roughness, correlation_length, albedo, index_n, index_k}, {}, true},
        facets("beckmann", "beckmann", width("alpha")),
        facets("ggx", "ggx", width("alpha")),
        facets("phong", "phong", exponent("exponent")),
        {"ashikhmin",
         "ashikhmin",
         {{"normals", R"({"type": "gaussian"})"}},
         {albedo, f0, slope("sigma_x"), slope("sigma_y", "sigma_x")},
         {},
         false,
         true},
        {"kurt", "kurt", {}, {kd}, {ks, f0, width("mx"), width("my", "mx"), alpha}},
        {"ward", "ward", {}, {kd}, {ks, width("mx"), width("my", "mx")}},
        {"ward_duer", "ward_duer", {}, {kd}, {ks, width("mx"), width("my", "mx")}},
        {"cook_torrance", "cook_torrance", {}, {kd}, {ks, f0, width("m")}},
        {"blinn_phong", "blinn_phong", {}, {kd}, {ks, exponent("exponent")}},
        {"lafortune", "lafortune", {}, {kd}, {ks, stretch("cx"), stretch("cy", "cx"), exponent("exponent")}},
        {"ashikhmin_shirley",
         "ashikhmin_shirley",
         {},
         {linear("rd", "rd", 1), ks, f0, exponent("nx"), exponent("ny", "nx")}},
        {"lambert", "lambert", {}, {albedo}},
        {"oren_nayar", "oren_nayar", {}, {albedo, slope_angle}},
    };
    return families;
}

std::size_t FitLayout::channel_count() const noexcept {
    return channels.empty() ? 0 : *std::ranges::max_element(channels) + 1;
}

FitModel::FitModel(const std::string& family, FitLayout layout)
    : family_{family_named(family)}, layout_{std::move(layout)} {
    if (layout_.wavelengths.empty() || layout_.wavelengths.size() != layout_.channels.size()) {
        throw Error{"fit: as many channels as wavelengths, and at least one, must be given"};
    }
    if (layout_.lobes < 1 || layout_.lobes > 3) {
        throw RequestError{"fit: " + std::to_string(layout_.lobes) + " lobes: must be 1 ... 3"};
    }
    if (family_.lobe.empty() && layout_.lobes > 1) {
        throw RequestError{"fit: model " + spectral::in_quotes(family) +
                           " has no lobes: must be fitted with 1"};
    }
    if (!family_.has_index && !layout_.index.empty()) {
        throw RequestError{"fit: model " + spectral::in_quotes(family) + " has no index"};
    }
    for (const ParameterRange& range : family_.parameters) {
        const bool of_index = family_.has_index && (range.key == "n" || range.key == "k");
        if (of_index && !layout_.index.empty()) continue;
        place(range, std::string{of_index ? "/index/" : "/"}.append(range.key), "");
    }
    for (int lobe = 0; lobe < (family_.lobe.empty() ? 0 : layout_.lobes); ++lobe) {
        for (const ParameterRange& range : family_.lobe) {
            place(range, "/lobes/" + std::to_string(lobe) + "/" + range.key,
                  layout_.lobes > 1 ? std::to_string(lobe + 1) : "");
        }
    }
    if (!layout_.index.empty()) try_index();
}

void FitModel::try_index() const {
    std::vector<double> values;
    for (const FitParameter& parameter : parameters_) values.push_back(parameter.range.starts.front());
    try {
        static_cast<void>(spectral::JsonValue::parse(layout_.index, "fit: index"));
        static_cast<void>(reflector(values));
    } catch (const Error& error) {
        throw RequestError{error.what()};
    }
}

void FitModel::place(const ParameterRange& range, const std::string& pointer, const std::string& suffix) {
    FitParameter parameter{range, pointer, range.symbol + suffix};
    if (!range.tied_to.empty()) parameter.range.tied_to += suffix;
    if (!by_channel(range) || layout_.channel_count() == 1) {
        parameters_.push_back(parameter);
        return;
    }
    for (std::size_t channel = 0; channel < layout_.channel_count(); ++channel) {
        parameters_.push_back({parameter.range, pointer, parameter.name + channel_name(layout_, channel)});
    }
}

std::string FitModel::material_text(std::span<const double> values, const std::string& name) const {
    ordered_json file{{"name", name}, {"model", family_.model}};
    for (const auto& [key, text] : family_.settings) file[key] = ordered_json::parse(text);
    if (!layout_.index.empty()) file["index"] = ordered_json::parse(layout_.index);
    std::size_t channel = 0;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
        const FitParameter& parameter = parameters_[i];
        channel = i > 0 && parameters_[i - 1].pointer == parameter.pointer ? channel + 1 : 0;
        ordered_json& place = file[ordered_json::json_pointer{parameter.pointer}];
        if (by_channel(parameter.range) && layout_.channel_count() > 1) {
            set_channel(place, layout_, channel, values[i]);
        } else {
            place = values[i];
        }
    }
    return file.dump(2) + "\n";
}

spectral::Material FitModel::reflector(std::span<const double> values) const {
    return reflector_from(material_text(values, name()));
}

spectral::Material reflector_from(const std::string& material_text) {
    const auto file = spectral::JsonValue::parse(material_text, "fit");
    const std::string model = file["model"].text(), name = file["name"].text();
    const auto& models = spectral::built_in_models();
    const auto entry = std::ranges::find(models, model, &spectral::ModelEntry::name);
    if (entry == models.end()) throw file["model"].error(spectral::in_quotes(model) + " is not registered");
    return entry->read({file, {}, name});
}

}  // namespace hts::validation
