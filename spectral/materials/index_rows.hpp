/// Rows of a table of optical constants, whatever kind of file they come from. Private to the readers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spectral/materials/dispersion.hpp"

namespace hts::spectral {

class IndexRows {
  public:
    /// Real part at a wavelength [um]; hts::Error if wavelength or n is none.
    void add_n(double um, double n);
    /// Imaginary part at a wavelength [um]; hts::Error if wavelength or k is none.
    void add_k(double um, double k);

    /// The same of a page of a database, of which one row far from where it is needed should not refuse all:
    /// what is no n or no k there is unknown up to the rows beside it, and noted.
    ///   quantity   'n' or 'k'      place   "path:line"
    void add_if_physical(char quantity, double um, double value, const std::string& place);
    /// A line for each of those, and one for n and one for k where rows of the same wavelength differ, whose
    /// mean is taken.
    ///   file   begins the lines about rows that differ
    [[nodiscard]] std::vector<std::string> notes(const std::string& file) const;
    /// hts::Error if no row of a quantity that has rows is physical.
    void require_physical() const;

    /// The rows joined by straight lines, in order of wavelength; none if there are no rows.
    [[nodiscard]] std::optional<Dispersion> n() const;
    [[nodiscard]] std::optional<Dispersion> k() const;

  private:
    std::vector<PiecewiseLinear::Point> n_, k_;
    std::vector<std::string> notes_;
};

}  // namespace hts::spectral
