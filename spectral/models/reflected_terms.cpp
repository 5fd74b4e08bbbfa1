#include "spectral/models/reflected_terms.hpp"

#include <algorithm>

namespace hts::spectral {

ReflectedTerms reflected_terms(const Reflectance& reflectance, const DirectionPair& pair) {
    ReflectedTerms terms{reflectance.directional_diffuse(pair), reflectance.uniform_diffuse(),
                         std::vector<double>(reflectance.size())};
    reflectance.specular_reflectance(pair.in, terms.specular_reflectance);
    if (pair.in.cos_theta() > 0 && pair.out.cos_theta() > 0) return terms;
    const auto brdf = reflectance.brdf(pair);
    std::ranges::transform(terms.uniform_diffuse, brdf, terms.uniform_diffuse.begin(),
                           [](double uniform, double all) { return std::min(uniform, all); });
    return terms;
}

}  // namespace hts::spectral
