#include "hts/wavelength.hpp"

#include <numbers>

#include "hts/error.hpp"

namespace hts {

Wavelength Wavelength::from_micrometres(double micrometres) {
    if (!(micrometres >= shortest_length && micrometres <= longest_length)) {
        throw out_of_range("wavelength", micrometres, "um", "> 0 (from 1e-24 to 1e+24 um)");
    }
    return Wavelength{micrometres};
}

Wavelength Wavelength::from_nanometres(double nanometres) {
    return from_micrometres(nanometres / 1000);
}

double Wavelength::wave_number() const noexcept {
    return 2 * std::numbers::pi / micrometres_;
}

}  // namespace hts
