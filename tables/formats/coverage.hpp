/// How much of the hemisphere measured data cover, and how much they reflect. Private to the formats
/// and to who reports on them.
#pragma once

#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

/// Data that cover this share of the hemisphere are taken to cover all of it where they are integrated or
/// drawn from; what lacks is then held at the nearer end.
inline constexpr double whole_share = 0.98;

/// Share of the hemisphere of views, weighted by the cosine, that is known for light from `in`; to some 1e-3.
[[nodiscard]] double share_of_views(const spectral::Evaluator& brdf, const Direction& in);
/// The same of all pairs, light weighted by the cosine too.
[[nodiscard]] double share_of_pairs(const spectral::Evaluator& brdf);

/// "covers 0.55 um, theta_i 0 to 75 deg (6 values), …: 100 % of the hemisphere of
/// views from theta_i 0 deg, …".
[[nodiscard]] std::string coverage_note(const spectral::Reflectance& brdf);

/// Directional-hemispherical reflectance per wavelength [1], of what is evaluated:
/// held where nothing is known.
///   error   some 1e-3
[[nodiscard]] std::vector<double> measured_albedo(const spectral::Evaluator& brdf, const Direction& in,
                                                  double slope);

}  // namespace hts::tables
