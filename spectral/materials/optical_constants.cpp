#include "spectral/materials/optical_constants.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

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
    const std::string name = "n = " + brief(index.n(), 6) + ", k = " + brief(index.k(), 6);
    return {name, "given", ConstantValue{index.n()}, ConstantValue{index.k()}};
}

OpticalConstants::OpticalConstants(std::string name, std::string source, Dispersion n,
                                   std::optional<Dispersion> k, std::vector<std::string> warnings)
    : name_{std::move(name)},
      source_{std::move(source)},
      n_{std::move(n)},
      k_{std::move(k)},
      warnings_{std::move(warnings)} {
    if (range().shortest > range().longest) {
        throw Error{"n is known " + in_words(range_of(n_)) + ", k " + in_words(range_of(*k_)) +
                    ": the two ranges must overlap"};
    }
}

WavelengthRange OpticalConstants::range() const noexcept {
    return k_ ? common_part(range_of(n_), range_of(*k_)) : range_of(n_);
}

RefractiveIndex OpticalConstants::index(const Wavelength& wavelength, OutsideRange policy) const {
    static_cast<void>(range().admit(wavelength, policy, name_));
    const double um = wavelength.micrometres();
    const double n = value_at(n_, range_of(n_).clamp(um));
    const double k = k_ ? value_at(*k_, range_of(*k_).clamp(um)) : 0;
    if ((std::isnan(n) || std::isnan(k)) && !warnings_.empty())
        throw Error{name_ + " at " + shortest(um) +
                    " um: no index beside a row that has none: " + warnings_.front()};
    return checked_index(n, k, um, name_);
}

}  // namespace hts::spectral
