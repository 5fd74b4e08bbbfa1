#include "spectral/materials/optical_constants.hpp"

#include <algorithm>
#include <utility>

#include "hts/error.hpp"

namespace hts::spectral {
namespace {

WavelengthRange common_part(const WavelengthRange& a, const WavelengthRange& b) noexcept {
    return {std::max(a.shortest, b.shortest), std::min(a.longest, b.longest)};
}

std::string in_words(const WavelengthRange& range) {
    return "from " + shortest(range.shortest) + " to " + shortest(range.longest) + " um";
}

// A curve may yield what is no refractive index; then the message says where on the curve.
RefractiveIndex checked_index(double n, double k, double um, const std::string& name) {
    try {
        return {n, k};
    } catch (const Error& error) {
        throw Error{name + " at " + shortest(um) + " um: " + error.what()};
    }
}

}  // namespace

OpticalConstants OpticalConstants::constant(const RefractiveIndex& index) {
    const std::string name = "n = " + shortest(index.n()) + ", k = " + shortest(index.k());
    return {name, "given", ConstantValue{index.n()}, ConstantValue{index.k()}};
}

OpticalConstants::OpticalConstants(std::string name, std::string source, Dispersion n,
                                   std::optional<Dispersion> k)
    : name_{std::move(name)}, source_{std::move(source)}, n_{std::move(n)}, k_{std::move(k)} {
    if (range().shortest > range().longest) {
        throw Error{"n is known " + in_words(range_of(n_)) + ", k " + in_words(range_of(*k_)) +
                    ": the two ranges must overlap"};
    }
}

WavelengthRange OpticalConstants::range() const noexcept {
    return k_ ? common_part(range_of(n_), range_of(*k_)) : range_of(n_);
}

RefractiveIndex OpticalConstants::index(const Wavelength& wavelength, OutsideRange policy) const {
    const double um = range().admit(wavelength, policy, name_);
    return checked_index(value_at(n_, um), k_ ? value_at(*k_, um) : 0, um, name_);
}

}  // namespace hts::spectral
