// What the worker calls: one function, and the state behind it.

#include "engine.hpp"

#include <emscripten.h>

#include <exception>
#include <list>
#include <utility>

#include "hts/error.hpp"

namespace hts::page {
namespace {

// The last few of what is costly to make, by the text it was made from.
template <class Value>
class Recent {
  public:
    template <class Make>
    const Value& operator()(const std::string& key, const Make& make) {
        for (auto each = values_.begin(); each != values_.end(); ++each) {
            if (each->first != key) continue;
            values_.splice(values_.begin(), values_, each);
            return values_.front().second;
        }
        values_.emplace_front(key, make());
        if (values_.size() > most) values_.pop_back();
        return values_.front().second;
    }

  private:
    static constexpr std::size_t most = 12;
    std::list<std::pair<std::string, Value>> values_;
};

std::string answered(const char* request, const Numbers& numbers) {
    try {
        return answer(json::parse(request), numbers).dump(-1, ' ', false, json::error_handler_t::replace);
    } catch (const std::exception& error) {
        return json{{"error", error.what()}}.dump(-1, ' ', false, json::error_handler_t::replace);
    }
}

}  // namespace

void Numbers::require(std::size_t in_count, std::size_t out_count) const {
    if (in.size() != in_count || out.size() != out_count)
        throw Error{"numbers of a request: " + std::to_string(in.size()) + " and " +
                    std::to_string(out.size()) + ": must be " + std::to_string(in_count) + " and " +
                    std::to_string(out_count)};
}

namespace {

// What was made from files that have been replaced is not asked for again: this stands in its key.
int generation = 0;

}  // namespace

json forget() {
    return {{"generation", ++generation}};
}

// Dropped files stand in the root folder of the page's file system.
const spectral::Material& material_of_request(const json& request) {
    static Recent<spectral::Material> materials;
    const std::string text = request.at("material").dump(), file = request.value("file", "material.json");
    return materials(json{generation, file, text}.dump(),
                     [&] { return spectral::material_from_text(text, "/" + file); });
}

namespace {

std::string key_of(const json& request) {
    return json{generation, request.at("material"), request.at("wavelengths"),
                request.value("tolerance", 1e-6), request.value("outside", "")}
        .dump();
}

}  // namespace

const spectral::Reflectance& reflectance_of(const json& request) {
    static Recent<spectral::Reflectance> reflectances;
    const auto tolerance = request.value("tolerance", 1e-6);
    const auto outside = request.value("outside", "error") == std::string{"hold"}
                             ? spectral::OutsideRange::hold
                             : spectral::OutsideRange::error;
    return reflectances(key_of(request), [&] {
        auto wavelengths =
            spectral::WavelengthGrid::from_micrometres(request.at("wavelengths").get<std::vector<double>>());
        return material_of_request(request).at(wavelengths,
                                               {.tolerance = Tolerance{tolerance}, .outside = outside});
    });
}

const spectral::Sampler& sampler_of(const json& request) {
    static Recent<spectral::Sampler> samplers;
    return samplers(key_of(request), [&] {
        const auto& brdf = reflectance_of(request);
        return brdf.sampler(brdf.size() / 2);
    });
}

DirectionPair pair_at(std::span<const double> triples, std::size_t index) {
    return {Direction::from_degrees(triples[3 * index], 0),
            Direction::from_degrees(triples[3 * index + 1], triples[3 * index + 2])};
}

}  // namespace hts::page

extern "C" {

/// Answers a request; the text stays valid until the next call.
EMSCRIPTEN_KEEPALIVE const char* hts_request(const char* request, const double* in, int in_count, double* out,
                                             int out_count) {
    static std::string text;
    text = hts::page::answered(
        request, {{in, static_cast<std::size_t>(in_count)}, {out, static_cast<std::size_t>(out_count)}});
    return text.c_str();
}
}
