#include "validation/fit/fit_model.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

using nlohmann::ordered_json;

/// Whether a parameter has a value of its own in every channel.
bool by_channel(const ParameterRange& range) {
    return range.motion == Motion::linear;
}

bool of_index(const FitFamily& family, const ParameterRange& range) {
    return family.has_index && (range.key == "n" || range.key == "k");
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
    if (const FitFamily* found = find_family(name)) return *found;
    std::vector<std::string> names;
    for (const FitFamily& family : fit_families()) names.push_back(family.name);
    throw RequestError{"model " + spectral::in_quotes(name) +
                       " is not known: " + spectral::must_be_one_of(name, names)};
}

}  // namespace

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
    if (!family_.has_index && !(layout_.index.empty() && layout_.films.empty())) {
        throw RequestError{"fit: model " + spectral::in_quotes(family) + " has no index"};
    }
    for (std::size_t i = 0; i < family_.parameters.size(); ++i) {
        if (layout_.index.empty() || !of_index(family_, family_.parameters[i]))
            place(family_.parameters[i], {}, i);
    }
    for (std::size_t lobe = 0; lobe < lobe_count(); ++lobe) {
        for (std::size_t i = 0; i < family_.lobe.size(); ++i) place(family_.lobe[i], lobe, i);
    }
    if (family_.has_index) read_substance();
}

std::size_t FitModel::lobe_count() const noexcept {
    return static_cast<std::size_t>(family_.lobe.empty() ? 0 : layout_.lobes);
}

void FitModel::read_substance() {
    try {
        const auto alone = [](const std::string& key, const std::string& text) {  // for its own errors
            if (!text.empty()) static_cast<void>(spectral::JsonValue::parse(text, "fit: " + key));
            return text;
        };
        const std::string index = alone("index", layout_.index), films = alone("films", layout_.films);
        const auto file =
            spectral::JsonValue::parse(R"({"index": )" + (index.empty() ? R"({"n": 1, "k": 0})" : index) +
                                           R"(, "films": )" + (films.empty() ? "[]" : films) + "}",
                                       "fit");
        substance_ = spectral::coated_constants_from(file, {});
        if (index.empty()) return;
        for (const double um : layout_.wavelengths)
            indices_.push_back(substance_->index(Wavelength::from_micrometres(um), layout_.outside));
    } catch (const Error& error) {
        throw RequestError{error.what()};
    }
}

void FitModel::place(const ParameterRange& range, std::optional<std::size_t> lobe, std::size_t number) {
    const std::string suffix = lobe && layout_.lobes > 1 ? std::to_string(*lobe + 1) : "";
    std::string pointer = of_index(family_, range) ? "/index/" : "/";
    if (lobe) pointer += "lobes/" + std::to_string(*lobe) + "/";
    FitParameter parameter{range, pointer + range.key, range.symbol + suffix, lobe, number};
    if (!range.tied_to.empty()) parameter.range.tied_to += suffix;
    if (!by_channel(range) || layout_.channel_count() == 1) {
        parameters_.push_back(parameter);
        return;
    }
    const std::string name = parameter.name;
    for (std::size_t channel = 0; channel < layout_.channel_count(); ++channel) {
        parameter.name = name + channel_name(layout_, channel);
        parameter.channel = channel;
        parameters_.push_back(parameter);
    }
}

std::size_t FitModel::layout_place(double um) const {
    const auto found = std::ranges::find(layout_.wavelengths, um);
    if (found == layout_.wavelengths.end())
        throw Error{"fit: wavelength " + shortest(um) + " um: must be one of the data's"};
    return static_cast<std::size_t>(found - layout_.wavelengths.begin());
}

std::vector<ModelNumbers> FitModel::numbers(const FitTrial& trial,
                                            const spectral::WavelengthGrid& wavelengths) const {
    const std::size_t lobes = trial.lobe ? 1 : lobe_count();
    const ModelNumbers empty{wavelengths[0],
                             {1, 0},
                             std::vector<double>(family_.parameters.size()),
                             {lobes, std::vector<double>(family_.lobe.size())}};
    std::vector<ModelNumbers> result(wavelengths.size(), empty);
    for (std::size_t w = 0; w < result.size(); ++w) {
        ModelNumbers& numbers = result[w];
        const std::size_t at = layout_place(wavelengths.micrometres()[w]);
        for (std::size_t i = 0; i < parameters_.size(); ++i) {
            const FitParameter& parameter = parameters_[i];
            if (parameter.channel && *parameter.channel != layout_.channels[at]) continue;
            if (trial.lobe && parameter.lobe != trial.lobe) continue;
            auto& place = parameter.lobe ? numbers.lobes[trial.lobe ? 0 : *parameter.lobe] : numbers.own;
            place[parameter.number] = trial.values[i];
        }
        numbers.wavelength = wavelengths[w];
        if (family_.has_index) {
            const std::size_t n = numbers.own.size() - 2;
            numbers.index = indices_.empty() ? substance_->on({numbers.own[n], numbers.own[n + 1]},
                                                              wavelengths[w], layout_.outside)
                                             : indices_[at];
        }
    }
    return result;
}

std::vector<Prediction::Answer> FitModel::answers(std::span<const FitTrial> trials,
                                                  const Prediction::Job& job) const {
    std::vector<Prediction::Answer> result;
    if (trials.size() == 1) return {family_.answer(numbers(trials[0], job.wavelengths), job)};
    if (family_.one_by_one) {
        for (const FitTrial& trial : trials)
            result.push_back(family_.answer(numbers(trial, job.wavelengths), job));
        return result;
    }
    std::vector<ModelNumbers> all;
    for (const FitTrial& trial : trials)
        std::ranges::move(numbers(trial, job.wavelengths), std::back_inserter(all));
    const auto [brdf, specular] = family_.answer(all, job);
    const std::size_t count = job.wavelengths.size();
    for (std::size_t first = 0; first < all.size(); first += count) {
        const auto part = [&, &columns = all](const std::vector<double>& values) {
            std::vector<double> own;
            own.reserve(values.size() / trials.size());
            for (std::size_t row = first; row < values.size(); row += columns.size())
                own.insert(own.end(), values.data() + row, values.data() + row + count);
            return own;
        };
        result.push_back({part(brdf), part(specular)});
    }
    return result;
}

bool FitModel::concerns(const FitParameter& parameter, const Prediction::Job& job) const {
    return !parameter.channel || std::ranges::any_of(job.wavelengths.micrometres(), [&](double um) {
        return layout_.channels[layout_place(um)] == *parameter.channel;
    });
}

std::string FitModel::material_text(std::span<const double> values, const std::string& name) const {
    ordered_json file{{"name", name}, {"model", family_.model}};
    for (const auto& [key, text] : family_.settings) file[key] = ordered_json::parse(text);
    if (!layout_.index.empty()) file["index"] = ordered_json::parse(layout_.index);
    if (!layout_.films.empty()) file["films"] = ordered_json::parse(layout_.films);
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
        ordered_json& place = file[ordered_json::json_pointer{parameters_[i].pointer}];
        if (parameters_[i].channel) {
            set_channel(place, layout_, *parameters_[i].channel, values[i]);
        } else {
            place = values[i];
        }
    }
    return file.dump(2) + "\n";
}

}  // namespace hts::validation
