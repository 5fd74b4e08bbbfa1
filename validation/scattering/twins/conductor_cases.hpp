/// The kept exact lobes of perfect conductors, and how far any twin is from them.
#pragma once

#include <vector>

#include "validation/scattering/twins/model_distances.hpp"

namespace hts::validation {

/// A surface at an angle of incidence, with Kirchhoff's closed form in its bins.
struct ConductorCase {
    ExactLobe exact;
    std::vector<ProfileLobe> kirchhoff;
};
using ConductorCases = std::vector<ConductorCase>;

/// All of them, the cases of a surface together.
[[nodiscard]] ConductorCases conductor_cases();

/// Of each case, in order. Microfacets have the width of slopes, one per surface, with which they come
/// nearest to all its cases in unpolarised light.
[[nodiscard]] std::vector<Distances> all_distances(const ConductorCases& cases, TwinModel model);

}  // namespace hts::validation
