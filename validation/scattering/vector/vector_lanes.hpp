/// The two sums over all nodes of a patch, in vector lanes of single precision: the field of currents at the
/// nodes, and their radiation. Private to vector/; the wavelength is the unit of length.
///
/// Currents are summed for several right-hand sides at once, `group` of them in registers; the kernel is
/// computed once for all. Sums go over the sources in their order, so that the bits depend on the processor's
/// instruction set alone.
#pragma once

#include <cstddef>
#include <vector>

namespace hts::validation {

/// Right-hand sides that are summed together.
inline constexpr std::size_t group = 4;
/// Points that are summed at together; arrays of places are padded to a multiple of it.
inline constexpr std::size_t block = 16;

/// Places and slopes of nodes as arrays, padded.
struct NodeArrays {
    std::vector<float> x, y, z, slope_x, slope_y;
    std::size_t count;  ///< without the padding
};

/// Adds to sums[point][group][component], at the `block` points from `first` on, 2 N x (grad G x j) step^2 of
/// all nodes, the node itself left out.
///   currents   [node][group][4]: x real, imaginary, y real, imaginary; so are the sums
///   sums       [4 group][block]
void add_field(const NodeArrays& nodes, float area, const float* currents, std::size_t groups,
               std::size_t first, float* sums);

/// Adds to sums the integrals of j exp(-i k s r) in the `block` directions from `first` on.
///   s          unit vectors as arrays, padded
///   currents   [node][group][6]: x, y and z, real and imaginary
///   sums       [group 6][block]
struct DirectionArrays {
    std::vector<float> x, y, z;
};
void add_radiation(const NodeArrays& nodes, const DirectionArrays& s, const float* currents,
                   std::size_t groups, std::size_t first, float* sums);

}  // namespace hts::validation
