#include "validation/fit/sections/fit_cases.hpp"

#include <map>

#include "validation/curves/built_in_curves.hpp"

namespace hts::validation {
namespace {

/// What most sets get: sigma0, tau and a, and n where the optical constants are not known.
FitCase plain_case(const std::string& set) {
    return {set, set, {.index = known_index(set), .followed_starts = 4}};
}

/// A smooth surface scatters from within alone. At 70 and 80 deg of incidence the instrument's values fall to
/// nothing.
FitCase blue_acrylic() {
    FitCase result = plain_case("blue-acrylic");
    result.label = "blue-acrylic, as smooth";
    result.request.fixed = {{"sigma0", 1e-4}, {"tau", 1}};
    result.request.loss = Loss::huber;
    result.request.loss_scale = 0.1;
    result.selection.largest_theta = 60;
    return result;
}

/// A set whose rms roughness was measured by other means: fitted freely, and held there.
std::vector<FitCase> of_known_roughness(const std::string& set, double rms_um) {
    FitCase held = plain_case(set);
    held.label = set + ", sigma0 as measured";
    held.request.fixed = {{"sigma0", rms_um}};
    held.judged = false;
    return {plain_case(set), held};
}

/// The surface that a criterion is asked of, with and without aluminium's own optical constants.
std::vector<FitCase> sandblasted() {
    const std::string set = "mwir-aluminium-sandblasted";
    FitCase metal = plain_case(set), effective = plain_case(set);
    metal.label = set + ", index of Al";
    metal.judged = false;
    effective.label = set + ", n and scale free";
    effective.request.index = "";
    effective.request.freed = {"scale"};
    effective.quick_points = 0;
    return {metal, effective};
}

}  // namespace

std::string known_index(const std::string& set) {
    static const std::map<std::string, std::string> materials{{"mwir-aluminium", "\"Al\""},
                                                              {"mwir-aluminium-sandblasted", "\"Al\""},
                                                              {"curet-aluminium-foil", "\"Al\""},
                                                              {"mwir-brass", "\"Cu\""},
                                                              {"mwir-stainless-steel-brushed", "\"Fe\""},
                                                              {"blue-acrylic", "\"PMMA\""}};
    const auto found = materials.find(set);
    return found == materials.end() ? "" : found->second;
}

std::vector<FitCase> fit_cases() {
    std::vector<FitCase> cases;
    const auto add = [&](const std::vector<FitCase>& more) {
        cases.insert(cases.end(), more.begin(), more.end());
    };
    for (const std::string& set : built_in_curve_names()) {
        const CurveSet curves = built_in_curves(set);
        if (curves.quantity == Quantity::hemispherical_reflectance) continue;  // no fit sees it
        const auto roughness = curves.roughness;
        if (set == "blue-acrylic") {
            add({blue_acrylic()});
        } else if (set == "mwir-aluminium-sandblasted") {
            add(sandblasted());
        } else if (roughness) {
            add(of_known_roughness(set, roughness->rms_um));
        } else {
            add({plain_case(set)});
        }
    }
    return cases;
}

}  // namespace hts::validation
