/// A BRDF on a regular grid of angles: what gonioreflectometers measure and text formats hold.
///
/// A grid runs over the light's azimuth and polar angle and over the view's azimuth and polar angle, all in
/// degrees as in files. The view's are taken about the normal (theta_r, phi_r - phi_i) or
/// about the mirror direction:
///   polar angle   between view and mirror direction
///   azimuth       about the mirror direction, 0 towards the normal, growing counter-clockwise seen
///                 against the mirrored ray
/// or about it in the plane of direction cosines, as optical designers have them:
///   polar         |beta - beta_0|, the distance there, 0 ... 2
///   azimuth       about the mirror direction, 0 away from the normal
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spectral/models/reflectance.hpp"

namespace hts::tables {

enum class PolarAxis { normal, mirror, mirror_sine };

/// Neighbouring points further apart [deg] say nothing of what lies between.
inline constexpr double largest_polar_gap = 45, largest_azimuth_gap = 90;

struct AngularGrid {
    PolarAxis axis = PolarAxis::normal;
    // [deg], each strictly increasing and not empty
    std::vector<double> phi_i{0};  ///< within 360; one of them says that the surface is isotropic
    std::vector<double> theta_i;   ///< 0 ... 90
    std::vector<double>
        azimuth;  ///< 0 ... 180 if the surface is symmetric to the plane of incidence, else within 360
    std::vector<double>
        polar;              ///< 0 ... 90 about the normal, 0 ... 180 about the mirror direction, or 0 ... 2
    bool symmetric = true;  ///< whether azimuths above 180 follow from those below
    /// Whether nothing is known between neighbours that are further apart than largest_polar_gap and
    /// largest_azimuth_gap: of a list of points, whose grid nobody promised.
    bool of_points = false;

    [[nodiscard]] std::size_t size() const noexcept {
        return phi_i.size() * theta_i.size() * azimuth.size() * polar.size();
    }
    /// The pair at a node; none if the view is below the horizon. Nodes are counted with `polar` fastest,
    /// then `azimuth`, `theta_i`, `phi_i`.
    [[nodiscard]] std::optional<DirectionPair> pair(std::size_t node) const;
    /// The same, the view raised to the horizon where it is below.
    [[nodiscard]] DirectionPair raised_pair(std::size_t node) const;
    /// hts::Error that names the axis and the value that is out of place.
    void check() const;
};

/// What stands at nodes whose view is below the horizon.
enum class BelowHorizon {
    empty,  ///< nothing: 0, which has no part in interpolation
    /// the horizon's value, so that a reader who interpolates between all nodes finds it at the horizon
    continued,
};

/// Values [1/sr] at every node, all wavelengths of a node together. Same bits for any number of threads.
[[nodiscard]] std::vector<double> values_on(const AngularGrid& grid, const spectral::Reflectance& brdf,
                                            BelowHorizon below = BelowHorizon::empty);

/// Linear interpolation in all angles; nodes below the horizon have no part in it if all of them are 0.
/// Beyond the ends of an axis, and in gaps of a list of points, the value of the nearest node; `knows` says
/// that nothing was measured there. An axis reaches to its pole or the horizon where that is at most half a
/// step away, and to the horizon from 89 deg. One azimuth about the mirror direction stands for all.
///   values   as `values_on` gives them, finite but for nodes of points that are NaN since nobody measured
///            there; grid.size() times the number of wavelengths; else hts::Error
[[nodiscard]] spectral::Reflectance gridded_brdf(const std::string& name,
                                                 const spectral::WavelengthGrid& wavelengths,
                                                 AngularGrid grid, std::vector<double> values);

/// "theta_i 0 to 75 deg (6 values)", or all of them if they are few.
[[nodiscard]] std::string axis_in_words(const char* name, const std::vector<double>& nodes,
                                        const char* unit = " deg");

/// Whether the BRDF is the same on both sides of the plane of incidence, as far as
/// random pairs can tell (1e-6).
[[nodiscard]] bool is_plane_symmetric(const spectral::Reflectance& brdf);

/// The same azimuths continued to 360 degrees, for surfaces that are not symmetric.
[[nodiscard]] AngularGrid without_symmetry(AngularGrid grid);

}  // namespace hts::tables
