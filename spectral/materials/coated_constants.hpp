/// Optical constants of a substance with the thin films that cover it: what the keys "index" and
/// "films" of a material file say.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hts/films/coated_index.hpp"
#include "spectral/materials/optical_constants.hpp"
#include "spectral/text/json_value.hpp"

namespace hts::spectral {

/// A film of one substance.
struct FilmConstants {
    OpticalConstants constants;
    double thickness;  ///< [um]
};

class CoatedConstants {
  public:
    ///   films   outermost first, as CoatedIndex wants them, else hts::Error
    CoatedConstants(
        OpticalConstants substrate,  // NOLINT(google-explicit-constructor): without films it is one
        std::vector<FilmConstants> films = {});

    [[nodiscard]] const OpticalConstants& substrate() const noexcept { return substrate_; }
    [[nodiscard]] const std::vector<FilmConstants>& films() const noexcept { return films_; }
    /// "Al", or "Al under Al2O3 0.004 um", outermost film first.
    [[nodiscard]] std::string name() const;
    /// Those of the substrate and of each film.
    [[nodiscard]] std::vector<std::string> warnings() const;

    /// At a wavelength; outside the range of any of the substances as `policy` says.
    [[nodiscard]] CoatedIndex index(const Wavelength& wavelength,
                                    OutsideRange policy = OutsideRange::error) const;
    /// The films on a substrate whose index the caller knows better.
    [[nodiscard]] CoatedIndex on(const RefractiveIndex& substrate, const Wavelength& wavelength,
                                 OutsideRange policy = OutsideRange::error) const;

  private:
    OpticalConstants substrate_;
    std::vector<FilmConstants> films_;
};

/// The keys "index" and "films" of a material file: "films" is a list of {"index": …,
/// "thickness_um": …}, empty if left out.
///   folder   relative paths of files start here
[[nodiscard]] CoatedConstants coated_constants_from(const JsonValue& material,
                                                    const std::filesystem::path& folder);

}  // namespace hts::spectral
