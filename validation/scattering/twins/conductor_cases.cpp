#include "validation/scattering/twins/conductor_cases.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "spectral/parallel.hpp"

namespace hts::validation {
namespace {

Distances case_distance(const ConductorCase& of, TwinModel model, double alpha) {
    return distances(of.exact, binned({model, of.exact.surface, perfect_conductor(), alpha}, of.exact),
                     of.kirchhoff);
}

bool is_microfacet(TwinModel model) {
    return model == TwinModel::beckmann || model == TwinModel::ggx;
}

/// The width of slopes with which microfacets come nearest to all cases of a surface, in unpolarised light:
/// golden section of ln(alpha) from a third to three times that of the surface.
double fitted_alpha(TwinModel model, const std::vector<const ConductorCase*>& of_surface) {
    const auto& surface = of_surface.front()->exact.surface;
    const auto error = [&](double log_alpha) {
        double squares = 0;
        for (const ConductorCase* each : of_surface) {
            const double distance = case_distance(*each, model, std::exp(log_alpha)).unpolarised;
            squares += distance * distance;
        }
        return squares;
    };
    constexpr double golden = 0.6180339887498949;
    const double middle = std::log(2 * surface.rms_roughness / surface.correlation_length);
    double low = middle - std::log(3.0), high = middle + std::log(3.0);
    double a = high - golden * (high - low), b = low + golden * (high - low), at_a = error(a),
           at_b = error(b);
    while (high - low > 0.01) {
        if (at_a < at_b) {
            high = std::exchange(b, a);
            at_b = at_a;
            at_a = error(a = high - golden * (high - low));
        } else {
            low = std::exchange(a, b);
            at_a = at_b;
            at_b = error(b = low + golden * (high - low));
        }
    }
    return std::exp((low + high) / 2);
}

}  // namespace

ConductorCases conductor_cases() {
    ConductorCases cases;
    for (const KeptSet& set : kept_sets()) {
        if (set.index.k() < perfect_conductor().k() || set.apart) continue;
        for (ExactLobe& exact : exact_lobes(kept_table(std::string{set.stem} + "-lobes")))
            cases.push_back({std::move(exact), {}});
    }
    spectral::parallel_for(cases.size(), [&](std::size_t i) {
        cases[i].kirchhoff =
            binned({TwinModel::kirchhoff, cases[i].exact.surface, perfect_conductor()}, cases[i].exact);
    });
    return cases;
}

std::vector<Distances> all_distances(const ConductorCases& cases, TwinModel model) {
    std::vector<std::vector<const ConductorCase*>> surfaces;
    for (const ConductorCase& each : cases) {
        const auto same = [&](const ConductorCase& other) {
            return other.exact.surface.rms_roughness == each.exact.surface.rms_roughness &&
                   other.exact.surface.correlation_length == each.exact.surface.correlation_length;
        };
        if (surfaces.empty() || !same(*surfaces.back().front())) surfaces.emplace_back();
        surfaces.back().push_back(&each);
    }
    std::vector<Distances> all(cases.size());
    spectral::parallel_for(surfaces.size(), [&](std::size_t i) {
        const double alpha = is_microfacet(model) ? fitted_alpha(model, surfaces[i]) : 0;
        for (const ConductorCase* each : surfaces[i])
            all[static_cast<std::size_t>(each - cases.data())] = case_distance(*each, model, alpha);
    });
    return all;
}

}  // namespace hts::validation
