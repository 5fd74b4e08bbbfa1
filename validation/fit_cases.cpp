#include "validation/fit_cases.hpp"

#include <map>

#include "validation/built_in_curves.hpp"

namespace hts::validation {
namespace {

/// What most sets get: sigma0, tau and a, and n where the optical constants are not known.
FitCase plain_case(const std::string& set) {
    return {set, set, {.index = known_index(set), .followed_starts = 4}};
}

FitCase blue_acrylic() {
    return {
        "blue-acrylic",
        "blue-acrylic, as smooth",
        {.index = known_index("blue-acrylic"), .fixed = {{"sigma0", 1e-4}, {"tau", 1}}, .followed_starts = 1},
        {},
        0,
        true,
        ""};
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
    effective.selection.largest_theta = 84;
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
    for (const std::string& set : built_in_curve_names()) {
        if (set == "blue-acrylic") {
            cases.push_back(blue_acrylic());
        } else if (set == "mwir-aluminium-sandblasted") {
            for (FitCase& one : sandblasted()) cases.push_back(std::move(one));
        } else {
            cases.push_back(plain_case(set));
        }
    }
    return cases;
}

std::string fits_text() {
    return "";
}

}  // namespace hts::validation
