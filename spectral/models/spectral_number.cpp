#include "spectral/models/spectral_number.hpp"

#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

Dispersion dispersion_from(const JsonValue& value, const NumberCheck& check) {
    if (value.is_object()) {
        value.require_keys_among({"table"});
        return number_table(value["table"], "value", check);
    }
    const double number = value.number();
    return ConstantValue{located(value.place(), [&] { return check(number); })};
}

}  // namespace

SpectralNumber::SpectralNumber(const JsonValue& value, const NumberCheck& check)
    : value_{dispersion_from(value, check)}, place_{value.place()} {}

SpectralNumber::SpectralNumber(const JsonValue& object, const char* key, double otherwise,
                               const NumberCheck& check)
    : value_{ConstantValue{otherwise}}, place_{object.place()} {
    if (const auto value = object.find(key)) *this = SpectralNumber{*value, check};
}

double SpectralNumber::operator()(const Wavelength& wavelength, OutsideRange policy) const {
    return value_at(value_, range_of(value_).admit(wavelength, policy, place_));
}

bool truth_or(const JsonValue& object, const char* key, bool otherwise) {
    const auto value = object.find(key);
    return value ? value->boolean() : otherwise;
}

}  // namespace hts::spectral
