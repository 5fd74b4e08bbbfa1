/// Numbers of a material file that may depend on wavelength.
#pragma once

#include <string>

#include "spectral/materials/dispersion.hpp"
#include "spectral/materials/optical_constants_json.hpp"

namespace hts::spectral {

/// A number, or {"table": [[um, value], …]}.
class SpectralNumber {
  public:
    ///   check   is asked about every value
    SpectralNumber(const JsonValue& value, const NumberCheck& check);
    /// The value of a key, or `otherwise` if the key is left out.
    SpectralNumber(const JsonValue& object, const char* key, double otherwise, const NumberCheck& check);

    /// Outside a table's range as `policy` says.
    [[nodiscard]] double operator()(const Wavelength& wavelength, OutsideRange policy) const;

  private:
    Dispersion value_{ConstantValue{0}};
    std::string place_;  // for messages
};

/// The value of a key that may be left out.
[[nodiscard]] bool truth_or(const JsonValue& object, const char* key, bool otherwise);

}  // namespace hts::spectral
