#include "hts/microfacet/ward.hpp"

#include <cmath>

namespace hts {

namespace {

/// q/(4 pi mx my), which both lobes share.
double height(const GaussianSlopes& slopes, const Direction& in, const Direction& out) {
    return slopes.shape(half_direction(in, out)) / (4 * std::numbers::pi * slopes.mx() * slopes.my());
}

}  // namespace

LobeGeometry WardLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    return {height(slopes(), in, out) / std::sqrt(in.cos_theta() * out.cos_theta()), 0};
}

LobeGeometry WardDuerLobe::geometry(const Direction& in, const Direction& out) const noexcept {
    return {height(slopes(), in, out) / (in.cos_theta() * out.cos_theta()), 0};
}

}  // namespace hts
