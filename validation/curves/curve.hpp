/// Reflectance curves as somebody measured, digitised or computed them, and the files that hold them.
///
/// A CurveSet is one surface seen by one instrument: curves, each at one wavelength or over one band, of
/// points that are a pair of directions, a value and its uncertainty. Conventions of directions in
/// hts/direction.hpp; here they are in degrees and the light of a point stands at azimuth 0 unless the point
/// says otherwise. Within the plane of incidence a scattering angle is positive on the mirror's side and
/// negative on the light's.
///
/// The file is JSON, described in validation/curves/data/README.md. `read_curves` accepts nothing that
/// `checked` would not.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hts/he_torrance_spectrum.hpp"

namespace hts::validation {

/// How the values came to be.
enum class CurveKind { measured, digitised, theory };

/// What the values are.
enum class Quantity {
    brdf,                ///< f [1/sr]
    brdf_cosine,         ///< f cos theta_r [1/sr]
    reflectance_factor,  ///< pi f [1]
    /// All light that leaves the surface over what comes along theta_i [1]; theta_r
    /// counts for nothing and is 0.
    hemispherical_reflectance,
};

/// What they may be compared with.
enum class Scale {
    absolute,
    specular,  ///< each curve divided by its own value in the mirror direction [He91 (11)]
    unknown,   ///< all curves of the set share one unknown factor > 0
};

/// What a curve sweeps, and so what its points are drawn against.
enum class Sweep {
    outgoing,  ///< the light stands still and the viewer moves in the plane of incidence
    incident,  ///< the viewer stands still and the light moves in the plane
    scattered  ///< pairs of directions in no order
};

[[nodiscard]] const char* name(CurveKind kind) noexcept;
[[nodiscard]] const char* name(Quantity quantity) noexcept;
[[nodiscard]] const char* name(Scale scale) noexcept;
[[nodiscard]] const char* unit(Quantity quantity) noexcept;

struct CurvePoint {
    double theta_i, phi_i, theta_r, phi_r;  ///< [deg], polar angles 0 … 90
    /// What it is: CurveSet::quantity and scale; >= 0, or noise about 0 where
    /// CurveSet::noise_floor is stated.
    double value;
    double uncertainty;  ///< one standard deviation, in the value's unit; 0 where the set states none

    [[nodiscard]] DirectionPair pair() const;
    /// -1 where viewer and light stand on the same side of the normal, 1 on opposite sides.
    [[nodiscard]] double side() const noexcept;
};

/// Wavelengths that a detector adds up, with equal weight for equal lengths of it.
struct Band {
    double first, last;  ///< [um]; equal for a single wavelength

    [[nodiscard]] bool single() const noexcept { return first == last; }
};

/// A point within the plane of incidence.
///   sweep    which direction moves; Sweep::scattered counts as outgoing
///   fixed    polar angle of the one that stands still, 0 … 90 [deg]
///   swept    angle of the other, -90 … 90, positive on the mirror's side of it [deg]
[[nodiscard]] CurvePoint in_plane_point(Sweep sweep, double fixed, double swept, double value,
                                        double uncertainty) noexcept;

struct Curve {
    Band band;
    Sweep sweep;
    std::vector<CurvePoint> points;

    /// The angle that stands still [deg]: theta_i, or theta_r for Sweep::incident; 0 for scattered pairs.
    [[nodiscard]] double fixed_angle() const noexcept;
    /// The other one, of a point, positive on the mirror's side of the direction that stands still [deg]; of
    /// scattered pairs theta_r.
    [[nodiscard]] double swept_angle(const CurvePoint& point) const noexcept;
};

/// A roughness that was measured by other means than scattering.
struct MeasuredRoughness {
    double rms_um;       ///< [um]
    std::string method;  ///< "optical profiler, 50x"
};

struct CurveSet {
    std::string stem;     ///< names files: "aluminium-sandblasted"; that of the file it was read from
    std::string surface;  ///< "sandblasted aluminium"
    CurveKind kind = CurveKind::measured;
    std::string by;                    ///< who: "measured by …" on every plot
    std::string source;                ///< publication or data base
    std::string licence;               ///< "CC0-1.0"
    std::string how;                   ///< command that regenerates the file from the original
    std::vector<std::string> notes{};  ///< what was left out and why, what is not known

    Quantity quantity = Quantity::brdf;
    Scale scale = Scale::absolute;
    /// Cones of source and detector [sr]; none where nobody stated them.
    std::optional<double> source_solid_angle{}, detector_solid_angle{};
    std::optional<MeasuredRoughness> roughness{};
    /// Standard deviation of the noise of values near 0, in their unit: where it is stated, values may be
    /// negative.
    std::optional<double> noise_floor{};
    /// Where the uncertainties come from; empty exactly if there are none.
    std::string uncertainty{};

    std::vector<Curve> curves;

    [[nodiscard]] std::size_t point_count() const noexcept;
};

/// ln(model / measured) where both are > 0, else none. With a noise floor f > 0 it is asinh(model/2f) -
/// asinh(measured/2f) for any values: the same far above the floor, their difference over 2f about 0.
[[nodiscard]] std::optional<double> log_ratio(double model, double measured, double noise_floor) noexcept;

/// The set itself if it holds together: hts::Error "place: …" that names quantity, value, unit and legal
/// range for a text that lacks, a set without points, angles outside 0 … 90 deg, values that are no numbers
/// or negative without a noise floor, uncertainties that only some points have, a solid angle outside 0 … 2
/// pi sr, and directions that stand twice in one curve.
[[nodiscard]] CurveSet checked(CurveSet set, const std::string& place);

/// Reads a curve file; hts::Error "path: key "curves[2].points": …" that names key and legal range.
[[nodiscard]] CurveSet read_curves(const std::filesystem::path& path);

/// What `read_curves` reads, every number to its last bit.
[[nodiscard]] std::string curves_text(const CurveSet& set);

}  // namespace hts::validation
