/// The scenes that `hts render` knows: those of He et al. 1991, and shapes on which any material is looked
/// at.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/pictures/renderer.hpp"

namespace hts::validation {

/// Scenes that belong side by side.
struct Gallery {
    std::string name;          ///< "fig12"
    std::string caption;       ///< what is shown, panel by panel
    std::size_t columns;       ///< panels in a row
    double height_over_width;  ///< of a panel
    std::function<std::vector<Scene>()> scenes;
};

/// Its panels in one picture, lettered where the caption speaks of (a).
///   settings   width is that of the whole picture; height is not asked for
[[nodiscard]] Picture picture_of(const Gallery& gallery, RenderSettings settings,
                                 const Progress& progress = {});

/// fig12, fig13 and fig14 of He et al. 1991; Ashikhmin et al. 2000, Figs 1, 5, 7, 9 and 11; Kurt et al. 2010,
/// Figs 4 and 13.
[[nodiscard]] const std::vector<Gallery>& galleries();

/// Of the cylinders of fig12 and fig13, which stand upright about the scene's z axis.
inline constexpr double cylinder_radius = 1.05, cylinder_height = 2.2;

/// A sphere of a material under one small light, its poles up and down.
[[nodiscard]] Scene sphere_scene(const Appearance& material);
/// A folded cloth of it.
[[nodiscard]] Scene cloth_scene(const Appearance& material);
/// A plate of it that bulges upwards, seen from above.
[[nodiscard]] Scene plate_scene(const Appearance& material);

}  // namespace hts::validation
