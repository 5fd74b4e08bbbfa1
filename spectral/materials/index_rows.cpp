#include "spectral/materials/index_rows.hpp"

#include "hts/fresnel.hpp"
#include "hts/wavelength.hpp"

namespace hts::spectral {
namespace {

std::optional<Dispersion> curve(const std::vector<PiecewiseLinear::Point>& points) {
    if (points.empty()) return std::nullopt;
    return PiecewiseLinear{points};
}

}  // namespace

void IndexRows::add_n(double um, double n) {
    const RefractiveIndex index{n, 0};
    n_.push_back({Wavelength::from_micrometres(um).micrometres(), index.n()});
}

void IndexRows::add_k(double um, double k) {
    const RefractiveIndex index{1, k};
    k_.push_back({Wavelength::from_micrometres(um).micrometres(), index.k()});
}

std::optional<Dispersion> IndexRows::n() const {
    return curve(n_);
}

std::optional<Dispersion> IndexRows::k() const {
    return curve(k_);
}

}  // namespace hts::spectral
