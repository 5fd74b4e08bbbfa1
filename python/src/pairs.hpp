/// Pairs of directions from arrays of angles or of unit vectors.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "arrays.hpp"
#include "hts/he_torrance_spectrum.hpp"

namespace hts::python {

/// A direction from angles in degrees or in radians.
[[nodiscard]] Direction direction(double theta, double phi, bool degrees);

/// Reads pairs of directions from operands, a block at a time.
class Pairs {
  public:
    static constexpr std::size_t most = 256;  ///< of a block

    ///   angles    theta_i, phi_i, and for pairs theta_r, phi; or none
    ///   vectors   incident, and for pairs reflected; or none
    Pairs(std::span<const Operand> angles, std::span<const Operand> vectors, const Broadcast& broadcast,
          bool degrees);

    /// Those of so many elements, until the thread's next call. Without an outgoing direction the incident
    /// one stands for it.
    ///   element   the first; after an error, the one that is wrong
    [[nodiscard]] std::span<const DirectionPair> of_block(const Walk& walk, std::size_t& element,
                                                          std::size_t number) const;

  private:
    using Numbers = std::array<double, most>;
    using Columns = std::array<Numbers, 6>;

    void add(const Operand& operand, std::ptrdiff_t offset, const Broadcast& broadcast);
    [[nodiscard]] DirectionPair pair(const Columns& of, std::size_t i) const;
    /// All together; false if one is wrong.
    [[nodiscard]] bool from_degrees(Columns& of, std::span<DirectionPair> pairs) const;

    std::vector<const double*> data_;
    std::vector<Shape> steps_;
    bool degrees_, vectors_;
};

}  // namespace hts::python
