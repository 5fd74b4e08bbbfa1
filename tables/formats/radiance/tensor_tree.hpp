/// A BRDF as Radiance's tensor tree (G. Ward, "Tensor Tree Representation" of BSDF): constant in cells that
/// halve where the function changes.
///
/// The view stands on the unit square: direction cosines (x, y) mapped from the disc by Shirley and Chiu (J.
/// Graphics Tools 2(3), 1997). Of isotropic surfaces (rank 3) the light is (1 - sin theta_i)/2 of the first
/// dimension, and the view is turned so that the light comes from azimuth 180 degrees; the upper half of the
/// first dimension is not used. Of others (rank 4) two dimensions are the square of the direction in which
/// the light travels on, (theta_i, phi_i + 180 deg).
#pragma once

#include <memory>
#include <string>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

class Tokens;

struct TensorTreeOptions {
    /// Halvings per dimension; 0 for 7 (isotropic, cells of 1/64 in direction cosines) or 5 (others).   1 ...
    /// 8, or 6; Radiance advises 7 at most
    int depth = 0;
    /// Cells become one whose values differ by at most this part of them, and of
    /// 1/1000 of the largest. 0 ... 1
    double merge = 0.02;
};

/// The tree as text, braces around the numbers [1/sr], six digits. The value of a cell is the mean of those
/// at the middles of its halves.
///   brdf   one wavelength, else hts::Error
[[nodiscard]] std::string tensor_tree_text(const spectral::Reflectance& brdf,
                                           const TensorTreeOptions& options = {});

/// The BRDF of a tree, constant in its cells as in Radiance.
///   rank   3 or 4
/// hts::Error "path:line: …" where braces or counts do not make a tree; trees deeper than 24 are refused.
[[nodiscard]] spectral::Reflectance tensor_tree_brdf(const std::string& name,
                                                     const spectral::WavelengthGrid& wavelength, int rank,
                                                     Tokens& tokens);

}  // namespace hts::tables
