#include "spectral/models/reflected_terms.hpp"

#include <algorithm>

namespace hts::spectral {

ReflectedTerms reflected_terms(const Reflectance& reflectance, const DirectionPair& pair) {
    ReflectedTerms terms;
    reflected_terms(reflectance, pair, terms);
    return terms;
}

void reflected_terms(const Reflectance& reflectance, const DirectionPair& pair, ReflectedTerms& terms) {
    for (auto* values : {&terms.directional_diffuse, &terms.uniform_diffuse, &terms.specular_reflectance})
        values->resize(reflectance.size());
    reflectance.directional_diffuse(pair, terms.directional_diffuse);
    reflectance.uniform_diffuse(terms.uniform_diffuse);
    reflectance.specular_reflectance(pair.in, terms.specular_reflectance);
    if (std::ranges::find(terms.directional_diffuse, 0.0) == terms.directional_diffuse.end()) return;
    const auto brdf = reflectance.brdf(pair);
    std::ranges::transform(terms.uniform_diffuse, brdf, terms.uniform_diffuse.begin(),
                           [](double uniform, double all) { return std::min(uniform, all); });
}

}  // namespace hts::spectral
