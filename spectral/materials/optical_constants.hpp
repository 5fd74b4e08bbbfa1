/// Optical constants: the complex refractive index of a material as a function of wavelength.
///
/// Index n + ik, k >= 0, relative to vacuum, against vacuum wavelength. n and k come from a table (straight
/// lines between rows), from one of the nine dispersion formulas of refractiveindex.info, or are constant.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hts/fresnel.hpp"
#include "hts/wavelength.hpp"
#include "spectral/materials/dispersion.hpp"
#include "spectral/materials/piecewise_linear.hpp"

namespace hts::spectral {

class OpticalConstants {
  public:
    /// The same index at every wavelength.
    [[nodiscard]] static OpticalConstants constant(const RefractiveIndex& index);

    ///   name      for messages and lists, "Al" or a path
    ///   source    where the numbers come from, with licence
    ///   n         real part
    ///   k         imaginary part; none means 0
    /// hts::Error if there is no wavelength at which both are known.
    ///   warnings  what a user should know of the file they come from, a line each
    OpticalConstants(std::string name, std::string source, Dispersion n, std::optional<Dispersion> k,
                     std::vector<std::string> warnings = {});

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const std::string& source() const noexcept { return source_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    /// Where both n and k are known.
    [[nodiscard]] WavelengthRange range() const noexcept;

    /// Index at a wavelength; outside the range as `policy` says, where n and k are held each at the end of
    /// its own range. A table or formula that yields n <= 0 or k < 0 there is an hts::Error too.
    [[nodiscard]] RefractiveIndex index(const Wavelength& wavelength,
                                        OutsideRange policy = OutsideRange::error) const;

  private:
    std::string name_;
    std::string source_;
    Dispersion n_;
    std::optional<Dispersion> k_;
    std::vector<std::string> warnings_;
};

}  // namespace hts::spectral
