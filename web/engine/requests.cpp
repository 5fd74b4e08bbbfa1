// What can be asked of the engine.

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "engine.hpp"
#include "hts/error.hpp"
#include "hts/phi.hpp"
#include "hts/version.hpp"
#include "spectral/colour/colour.hpp"
#include "spectral/colour/display_colour.hpp"
#include "spectral/energy/judgement.hpp"
#include "spectral/materials/optical_constants.hpp"
#include "spectral/materials/optical_constants_files.hpp"
#include "spectral/models/reflected_terms.hpp"
#include "tables/formats/glsl/glsl.hpp"

namespace hts::page {
namespace {

using spectral::Reflectance;

// "evaluate": "of" each pair at all wavelengths.
json evaluate(const json& request, const Numbers& numbers) {
    const Reflectance& brdf = reflectance_of(request);
    const std::string of = request.at("of");
    const std::size_t pairs = numbers.in.size() / 3, count = brdf.size();
    const bool matrices = of == "mueller" || of == "specular_mueller";
    numbers.require(3 * pairs, pairs * count * (matrices ? 16 : 1));
    std::vector<Mueller> mueller(matrices ? count : 0);
    for (std::size_t i = 0; i < pairs; ++i) {
        const DirectionPair pair = pair_at(numbers.in, i);
        if (matrices) {
            of == "mueller" ? brdf.directional_diffuse_mueller(pair, mueller)
                            : brdf.specular_mueller(pair.in, mueller);
            for (std::size_t w = 0; w < count; ++w)
                for (std::size_t e = 0; e < 16; ++e)
                    numbers.out[(i * count + w) * 16 + e] = mueller[w].elements()[e];
            continue;
        }
        const auto values = numbers.out.subspan(i * count, count);
        if (of == "brdf") {
            brdf.brdf(pair, values);
        } else if (of == "directional_diffuse") {
            brdf.directional_diffuse(pair, values);
        } else if (of == "specular") {
            brdf.specular_reflectance(pair.in, values);
        } else {
            throw Error{"of " + of +
                        ": must be brdf, directional_diffuse, specular, mueller or specular_mueller"};
        }
    }
    return {{"count", count}};
}

// "describe": what a material is; its optical constants where it is a rough surface.
json describe(const json& request, const Numbers& numbers) {
    const Reflectance& brdf = reflectance_of(request);
    const auto& material = material_of_request(request);
    const auto& properties = brdf.properties();
    json result{{"name", material.name()},
                {"model", material.model_name()},
                {"source", material.model_source()},
                {"warnings", material.warnings()},
                {"polarised", properties.polarised},
                {"specular_term", properties.specular_term},
                {"rough_surface", properties.surface.has_value()},
                {"rms_roughness_um", properties.surface ? properties.surface->rms_roughness() : 0},
                {"n", json::array()},
                {"k", json::array()}};
    for (const SpectralSample& sample : brdf.samples()) {
        result["n"].push_back(sample.index.substrate().n());
        result["k"].push_back(sample.index.substrate().k());
    }
    numbers.require(0, 0);
    return result;
}

json verdict(const spectral::RoughSurface& surface, const DirectionPair& pair, const SpectralSample& sample) {
    const auto judged = spectral::judgement(surface, pair, sample);
    json result{{"severity", spectral::name(judged.severity)},
                {"findings", json::array()},
                {"perturbation_advised", false}};
    if (judged.error) result["decibels"] = {judged.error->least, judged.error->most};
    if (spectral::judged_by_distance(surface)) return result;
    const auto validity = spectral::validity(surface, pair, sample);
    for (const auto& finding : validity.findings) {
        const auto limits = spectral::limits(finding.criterion);
        result["findings"].push_back({{"criterion", spectral::name(finding.criterion)},
                                      {"quantity", spectral::quantity(finding.criterion)},
                                      {"reason", spectral::reason(finding.criterion)},
                                      {"measured", finding.measured},
                                      {"caution", limits.caution},
                                      {"outside", limits.outside},
                                      {"least", limits.least()},
                                      {"severity", spectral::name(finding.severity())}});
    }
    result["perturbation_advised"] = validity.perturbation_advised;
    return result;
}

json decibels_of(const spectral::TrueDecibels& of) {
    return {{"te", of.te}, {"tm", of.tm}, {"unpolarised", of.unpolarised}};
}

// What hts info says of the distance from exact scattering.
json distance(const spectral::RoughSurface& surface, const SpectralSample& sample, const Direction& in) {
    const auto expected = spectral::expected_distance(surface, sample, in);
    const auto& study = spectral::distance_study(surface, sample.index.substrate());
    json result{{"studied", expected.studied},
                {"he", decibels_of(expected.distance.he)},
                {"he_unified", decibels_of(expected.distance.unified)},
                {"substance", study.substance},
                {"cases", study.cases},
                {"range", study.range},
                {"fine", spectral::fine_distance},
                {"greatest", spectral::greatest_distance}};
    if (spectral::judged_by_distance(surface))
        result["severity"] = spectral::name(spectral::judgement(expected).severity);
    return result;
}

// "detail": what one value is made of, and whether the model can be believed there; the first wavelength.
json detail(const json& request, const Numbers& numbers) {
    const Reflectance& brdf = reflectance_of(request);
    numbers.require(3, 0);
    const DirectionPair pair = pair_at(numbers.in, 0);
    const auto terms = spectral::reflected_terms(brdf, pair);
    json result{{"directional_diffuse", terms.directional_diffuse[0]},
                {"uniform_diffuse", terms.uniform_diffuse[0]},
                {"specular_reflectance", terms.specular_reflectance[0]}};
    if (!brdf.properties().surface) return result;
    std::vector<spectral::LobeDetail> details(brdf.size());
    brdf.evaluator().detail(pair, details);
    const auto& first = details[0];
    result["g"] = first.phase_variance;
    result["t"] = first.lobe_argument;
    result["effective_roughness_um"] = first.effective_roughness;
    result["shadowing"] = first.shadowing;
    result["fresnel"] = first.fresnel;
    result["method"] = name(first.method);
    result["regime"] = spectral::name(spectral::regime(first.phase_variance));
    const auto& surface = *brdf.properties().surface;
    result["validity"] = verdict(surface, pair, brdf.samples()[0]);
    result["distance"] = distance(surface, brdf.samples()[0], pair.in);
    return result;
}

// "energy": what is reflected by each term, of light at "theta_i_deg"; the first wavelength.
json energy(const json& request, const Numbers& /*numbers*/) {
    const Reflectance& brdf = reflectance_of(request);
    const auto albedo = brdf.albedo(Direction::from_degrees(request.at("theta_i_deg"), 0), 0);
    return {{"specular", albedo.specular},
            {"directional_diffuse", albedo.directional_diffuse},
            {"uniform_diffuse", albedo.uniform_diffuse}};
}

// "colour": red, green and blue, linear, of spectra of radiance factors at "wavelengths" [um] under D65.
json colour(const json& request, const Numbers& numbers) {
    const auto wavelengths = request.at("wavelengths").get<std::vector<double>>();
    const auto white = spectral::Illuminant::D65;
    const auto weights = spectral::tristimulus_weights(wavelengths, white);
    const std::size_t spectra = numbers.in.size() / wavelengths.size();
    numbers.require(spectra * wavelengths.size(), 3 * spectra);
    for (std::size_t i = 0; i < spectra; ++i) {
        const auto spectrum = numbers.in.subspan(i * wavelengths.size(), wavelengths.size());
        const auto rgb = spectral::linear_srgb(weights(spectrum), white);
        numbers.out[3 * i] = rgb.red;
        numbers.out[3 * i + 1] = rgb.green;
        numbers.out[3 * i + 2] = rgb.blue;
    }
    return {{"count", spectra}};
}

// "phi": ln Phi of pairs g, t.
json log_phi(const json& /*request*/, const Numbers& numbers) {
    const std::size_t pairs = numbers.in.size() / 2;
    numbers.require(2 * pairs, pairs);
    for (std::size_t i = 0; i < pairs; ++i)
        numbers.out[i] = phi(numbers.in[2 * i], numbers.in[2 * i + 1]).log;
    return {{"count", pairs}};
}

// "index": range and source of optical constants, built-in "name" or dropped "file".
json index(const json& request, const Numbers& /*numbers*/) {
    const auto constants = request.contains("file")
                               ? spectral::read_optical_constants(request.at("file").get<std::string>())
                               : spectral::built_in_optical_constants(request.at("name").get<std::string>());
    const auto range = constants.range();
    return {{"name", constants.name()},
            {"source", constants.source()},
            {"warnings", constants.warnings()},
            {"from_um", range.shortest},
            {"to_um", range.longest}};
}

json catalogue(const json& /*request*/, const Numbers& /*numbers*/) {
    return {{"version", HTS_VERSION}, {"indices", spectral::optical_constants_names()}};
}

json shader(const json& request, const Numbers& /*numbers*/) {
    const auto reflectance = reflectance_of(request);
    const bool wgsl = request.at("language").get<std::string>() == "wgsl";
    return {{"text", wgsl ? tables::wgsl_text(reflectance) : tables::glsl_text(reflectance)}};
}

}  // namespace

json answer(const json& request, const Numbers& numbers) {
    using Request = std::function<json(const json&, const Numbers&)>;
    static const std::map<std::string, Request> requests{
        {"evaluate", evaluate},
        {"describe", describe},
        {"detail", detail},
        {"energy", energy},
        {"colour", colour},
        {"phi", log_phi},
        {"index", index},
        {"catalogue", catalogue},
        {"shader", shader},
        {"picture", picture},
        {"forget", [](const json&, const Numbers&) { return forget(); }},
        {"fit", fit},
        {"match", [](const json& r, const Numbers&) { return match(r); }},
        {"curve", [](const json& r, const Numbers&) { return curve(r); }},
        {"is_scatter_file", [](const json& r, const Numbers&) -> json {
             return {{"is", is_scatter_file(r.at("text"))}};
         }}};
    const auto found = requests.find(request.at("do"));
    if (found == requests.end()) throw Error{"request " + request.at("do").dump() + ": not known"};
    return found->second(request, numbers);
}

}  // namespace hts::page
