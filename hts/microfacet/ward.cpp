#include "hts/microfacet/ward.hpp"

#include <cmath>

namespace hts {

double SlopeLobe::height(const Direction& in, const Direction& out) const noexcept {
    return slopes_.shape(half_direction(in, out)) / (4 * std::numbers::pi * slopes_.mx() * slopes_.my());
}

double WardLobe::brdf(const Direction& in, const Direction& out) const noexcept {
    return height(in, out) / std::sqrt(in.cos_theta() * out.cos_theta());
}

double WardDuerLobe::brdf(const Direction& in, const Direction& out) const noexcept {
    return height(in, out) / (in.cos_theta() * out.cos_theta());
}

}  // namespace hts
