/// Rows of a table of optical constants, whatever kind of file they come from. Private to the readers.
#pragma once

#include <optional>
#include <vector>

#include "spectral/materials/dispersion.hpp"

namespace hts::spectral {

class IndexRows {
  public:
    /// Real part at a wavelength [um]; hts::Error if wavelength or n is none.
    void add_n(double um, double n);
    /// Imaginary part at a wavelength [um]; hts::Error if wavelength or k is none.
    void add_k(double um, double k);

    /// The rows joined by straight lines, in order of wavelength; none if there are no rows.
    [[nodiscard]] std::optional<Dispersion> n() const;
    [[nodiscard]] std::optional<Dispersion> k() const;

  private:
    std::vector<PiecewiseLinear::Point> n_, k_;
};

}  // namespace hts::spectral
