#include "validation/fit/fit_family.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "hts/microfacet/ashikhmin.hpp"
#include "hts/microfacet/cook_torrance.hpp"
#include "hts/microfacet/cosine_lobes.hpp"
#include "hts/microfacet/diffuse.hpp"
#include "hts/microfacet/kurt.hpp"
#include "hts/microfacet/walter.hpp"
#include "hts/microfacet/ward.hpp"
#include "spectral/models/he_torrance_material.hpp"

namespace hts::validation {
namespace {

using Numbers = std::span<const ModelNumbers>;

constexpr double degree = std::numbers::pi / 180;

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

// ---- what numbers make

/// The published model or its successor.
FitFamily::Answer rough_surface(spectral::RoughSurface theory) {
    return [theory = std::move(theory)](Numbers numbers, const Prediction::Job& job) {
        std::vector<SpectralSample> samples;
        for (const ModelNumbers& each : numbers)
            samples.push_back({each.wavelength, each.index, hts::uniform_diffuse(each.own[2])});
        const auto model = spectral::he_torrance_reflectance(
            "", theory.with({numbers[0].own[0], numbers[0].own[1]}), std::move(samples),
            Tolerance{hts::accuracy::finest_lane_tolerance});
        return Prediction::answer(job, model.evaluator());
    };
}

/// An order in which models that share their geometry are neighbours.
template <class Model>
std::vector<std::size_t> in_groups(const std::vector<Model>& models) {
    std::vector<std::size_t> order(models.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if constexpr (GeometrySharingModel<Model>) {
        for (auto first = order.begin(); first != order.end();) {
            first = std::stable_partition(first, order.end(), [&, leader = *first](std::size_t i) {
                return models[leader].shares_geometry(models[i]);
            });
        }
    }
    return order;
}

template <class Model>
Prediction::Answer answer_of(const std::vector<Model>& models, const Prediction::Job& job) {
    const std::size_t count = models.size();
    const auto order = in_groups(models);
    std::vector<Model> grouped;
    grouped.reserve(count);
    for (const std::size_t i : order) grouped.push_back(models[i]);
    Prediction::Answer answer{std::vector<double>(job.pairs.size() * count),
                              std::vector<double>(job.incidences.size() * count)};
    std::vector<double> values(count);
    for (std::size_t p = 0; p < job.pairs.size(); ++p) {
        spectral_brdf<Model>(grouped, job.pairs[p].in, job.pairs[p].out, values);
        for (std::size_t i = 0; i < count; ++i) answer.brdf[p * count + order[i]] = values[i];
    }
    return answer;
}

/// A model that `make` makes of numbers.
template <class Make>
FitFamily::Answer each_by(Make make) {
    return [make](Numbers numbers, const Prediction::Job& job) {
        std::vector<decltype(make(numbers[0]))> models;
        for (const ModelNumbers& each : numbers) models.push_back(make(each));
        return answer_of(models, job);
    };
}

/// Value{numbers[first], …}, N of them.
template <class Value, std::size_t N, std::size_t First = 0>
Value of_numbers(const std::vector<double>& numbers) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        return Value{numbers[First + I]...};
    }
    (std::make_index_sequence<N>{});
}

/// Model{kd, lobes}, lobes of ks and N numbers.
template <class Model, class Lobe, std::size_t N>
FitFamily::Answer with_lobes() {
    return each_by([](const ModelNumbers& numbers) {
        std::vector<WeightedLobe<Lobe>> lobes;
        for (const auto& lobe : numbers.lobes) lobes.push_back({lobe[0], of_numbers<Lobe, N, 1>(lobe)});
        return Model{numbers.own[0], std::move(lobes)};
    });
}

FitFamily facets(const char* name, const ParameterRange& shape, FacetDistribution (*of)(double)) {
    return {name,
            "walter",
            {{"distribution", '"' + std::string{name} + '"'}},
            {shape, albedo, index_n, index_k},
            {},
            each_by([of](const ModelNumbers& numbers) {
                return WalterInterface{of(numbers.own[0]), numbers.index, 1, numbers.own[1]};
            }),
            true};
}

/// Facets cost much: neighbours of the same widths share them.
Prediction::Answer ashikhmin(Numbers numbers, const Prediction::Job& job) {
    std::vector<AshikhminBrdf> models;
    std::optional<AshikhminFacets> facets;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::span own{numbers[i].own};
        if (i == 0 || !std::ranges::equal(own.last(2), std::span{numbers[i - 1].own}.last(2)))
            facets.emplace(NormalDensity::gaussian(own[2], own[3]));
        models.emplace_back(*facets, FacetFresnel::schlick(own[1]), own[0]);
    }
    return answer_of(models, job);
}

}  // namespace

// A line per model: its name here and in material files, keys that are no numbers, numbers, numbers of each
// lobe, and the model.
const std::vector<FitFamily>& fit_families() {
    static const std::vector<FitFamily> families{
        {"he",
         "he",
         {},
         {rms_roughness, correlation_length, albedo, index_n, index_k},
         {},
         rough_surface(Surface{0, 1}),
         true,
         false,
         true},
        {"he_unified",
         "he_unified",
         {},
         {rms_roughness, correlation_length, albedo, index_n, index_k},
         {},
         rough_surface({Surface{0, 1}, UnifiedChoices{}}),
         true,
         false,
         true},
        facets("beckmann", width("alpha"), [](double width) { return FacetDistribution::beckmann(width); }),
        facets("ggx", width("alpha"), FacetDistribution::ggx),
        facets("phong", exponent("exponent"), [](double power) { return FacetDistribution::phong(power); }),
        {"ashikhmin",
         "ashikhmin",
         {{"normals", R"({"type": "gaussian"})"}},
         {albedo, f0, slope("sigma_x"), slope("sigma_y", "sigma_x")},
         {},
         ashikhmin,
         false,
         true},
        {"kurt",
         "kurt",
         {},
         {kd},
         {ks, f0, width("mx"), width("my", "mx"), alpha},
         with_lobes<Kurt, KurtLobe, 4>()},
        {"ward", "ward", {}, {kd}, {ks, width("mx"), width("my", "mx")}, with_lobes<Ward, WardLobe, 2>()},
        {"ward_duer",
         "ward_duer",
         {},
         {kd},
         {ks, width("mx"), width("my", "mx")},
         with_lobes<WardDuer, WardDuerLobe, 2>()},
        {"cook_torrance",
         "cook_torrance",
         {},
         {kd},
         {ks, f0, width("m")},
         with_lobes<CookTorrance, CookTorranceLobe, 2>()},
        {"blinn_phong",
         "blinn_phong",
         {},
         {kd},
         {ks, exponent("exponent")},
         with_lobes<BlinnPhong, BlinnPhongLobe, 1>()},
        {"lafortune",
         "lafortune",
         {},
         {kd},
         {ks, stretch("cx"), stretch("cy", "cx"), exponent("exponent")},
         with_lobes<Lafortune, LafortuneLobe, 3>()},
        {"ashikhmin_shirley",
         "ashikhmin_shirley",
         {},
         {linear("rd", "rd", 1), ks, f0, exponent("nx"), exponent("ny", "nx")},
         {},
         each_by([](const ModelNumbers& numbers) {
             const auto& [rd, weight, mirror, nx, ny] =
                 std::tie(numbers.own[0], numbers.own[1], numbers.own[2], numbers.own[3], numbers.own[4]);
             return AshikhminShirley{rd, {mirror, nx, ny}, weight};
         })},
        {"lambert", "lambert", {}, {albedo}, {}, each_by([](const ModelNumbers& numbers) {
             return LambertianModel{numbers.own[0]};
         })},
        {"oren_nayar", "oren_nayar", {}, {albedo, slope_angle}, {}, each_by([](const ModelNumbers& numbers) {
             return OrenNayar{numbers.own[0], numbers.own[1] * degree};
         })},
    };
    return families;
}

const FitFamily* find_family(const std::string& name) {
    const auto& all = fit_families();
    const auto found = std::ranges::find(all, name, &FitFamily::name);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace hts::validation
