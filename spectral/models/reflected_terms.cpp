#include "spectral/models/reflected_terms.hpp"

#include <algorithm>

namespace hts::spectral {

ReflectedTerms reflected_terms(const Reflectance& reflectance, const DirectionPair& pair) {
    ReflectedTerms terms{reflectance.directional_diffuse(pair), reflectance.uniform_diffuse(),
                         std::vector<double>(reflectance.size())};
    reflectance.specular_reflectance(pair.in, terms.specular_reflectance);
    if (std::ranges::find(terms.directional_diffuse, 0.0) == terms.directional_diffuse.end()) return terms;
    const auto brdf = reflectance.brdf(pair);
    std::ranges::transform(terms.uniform_diffuse, brdf, terms.uniform_diffuse.begin(),
                           [](double uniform, double all) { return std::min(uniform, all); });
    return terms;
}

}  // namespace hts::spectral
