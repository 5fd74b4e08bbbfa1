/// From heights as measured to a rough surface about a level: outliers go, tilt and form are taken off, gaps
/// are masked or filled.
#pragma once

#include <string_view>

#include "validation/topography/maps/height_map.hpp"

namespace hts::validation {

/// What is taken off: a mean height, a plane, or a paraboloid for the form of curved parts.
enum class Level { mean, plane, quadratic };
[[nodiscard]] std::string_view name(Level level);
/// How many coefficients that has; so many degrees of freedom the heights lose.
[[nodiscard]] int coefficient_count(Level level) noexcept;

enum class Gaps {
    fill,  ///< by heights that curve as little as they can (harmonic); smoother than the surface
    mask   ///< no part in anything; the window with its holes is accounted for, but a few holes leak much
};
[[nodiscard]] std::string_view name(Gaps gaps);

struct Levelling {
    Level level = Level::plane;
    Gaps gaps = Gaps::fill;
    /// A height is an outlier where its distance from the median of the 3 by 3 points about it is more than
    /// so many times the map's robust standard deviation of that distance (1.4826 times
    /// the median); 0: none is.
    double outlier = 8;
};

/// A map about its level, and what was done to it.
struct LevelledMap {
    HeightMap map;  ///< mean 0; NaN where masked
    Levelling how;
    std::size_t gaps;       ///< points without a value in the file
    std::size_t outliers;   ///< points taken for outliers, now gaps as well
    double tilt_x, tilt_y;  ///< slopes of the plane that fits best [1]
};

/// hts::Error as of HeightMap if outliers leave too little, or a paraboloid all.
[[nodiscard]] LevelledMap levelled(const HeightMap& map, const Levelling& how);

}  // namespace hts::validation
