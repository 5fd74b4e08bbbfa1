/// What a material reflects at the wavelengths of a picture: a material made ready for a renderer.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "spectral/models/material.hpp"

namespace hts::accuracy {
/// Of `Appearance::diffuse_albedo` against spectral::bihemispherical_reflectance, absolute.
inline constexpr double rendered_albedo = 4e-3;
/// Of the He-Torrance BRDF in a picture, relative; 1/255 of a picture's range is 4e-3.
inline constexpr double rendered_brdf = 1e-3;
}  // namespace hts::accuracy

namespace hts::validation {

/// Pictures are computed at 0.40, 0.41 ... 0.70 um, which is what a colour takes
/// (spectral/colour/colour.hpp).
inline constexpr std::size_t bands = 31;
[[nodiscard]] const spectral::WavelengthGrid& picture_wavelengths();

/// A value per wavelength of a picture. Radiances are relative to the illuminant's, D65: 1 is as white paper
/// in the sun.
struct Spectrum {
    std::array<double, bands> values{};

    [[nodiscard]] static Spectrum grey(double value) noexcept;
    Spectrum& operator+=(const Spectrum& other) noexcept;
    /// Adds factor * other.
    void add(double factor, const Spectrum& other) noexcept;
    /// Adds factor * one * other.
    void add(double factor, const Spectrum& one, const Spectrum& other) noexcept;
    [[nodiscard]] double mean() const noexcept;
    [[nodiscard]] double largest() const noexcept;
};
[[nodiscard]] Spectrum operator*(const Spectrum& a, const Spectrum& b) noexcept;
[[nodiscard]] Spectrum operator*(double factor, const Spectrum& a) noexcept;

/// A direction drawn for all wavelengths.
struct SpectralDraw {
    Direction out;
    Lobe lobe;
    double pdf;  ///< of all diffuse lobes together [1/sr]; of a specular draw its probability [1]; 0 of none
};

/// An immutable material; copies share it. Calls may run on any thread and allocate nothing.
class Appearance {
  public:
    ///   outside   what is reflected beyond what is known; for `error` the same as `hold`
    ///   error     accuracy::rendered_brdf; other models are exact      cost   some 100 ms
    explicit Appearance(const spectral::Material& material,
                        spectral::OutsideRange outside = spectral::OutsideRange::hold);

    /// BRDF of the diffuse terms [1/sr].
    [[nodiscard]] Spectrum brdf(const DirectionPair& pair) const noexcept;
    /// The same for many pairs at once, into as many spectra.
    void brdf(std::span<const DirectionPair> pairs, std::span<Spectrum> result) const noexcept;
    /// Reflectance into the mirror direction; 0 for models without a delta.
    [[nodiscard]] Spectrum specular_reflectance(const Direction& in) const noexcept;
    /// Whether there is a specular term at all.
    [[nodiscard]] bool has_specular() const noexcept { return mirror_.properties().specular_term; }

    /// Share of uniform incident light that the diffuse terms reflect, rho_hd of [He91 (12)], a function of
    /// wavelength alone.
    ///   error   accuracy::rendered_albedo
    [[nodiscard]] const Spectrum& diffuse_albedo() const noexcept { return diffuse_albedo_; }

    /// Draws for one of three wavelengths, which u[3] chooses; the density is that of all three together, so
    /// that no wavelength's weight brdf cos/pdf runs away. u four numbers in [0, 1)
    [[nodiscard]] SpectralDraw draw(const Direction& in, const std::array<double, 4>& u) const noexcept;
    /// Density in solid angle of `draw` drawing `out` from a diffuse lobe [1/sr].
    [[nodiscard]] double pdf(const Direction& in, const Direction& out) const noexcept;

  private:
    [[nodiscard]] double specular_probability(const Direction& in) const noexcept;

    spectral::Reflectance reflectance_, mirror_;  // the specular term is cheap, hence exact
    std::vector<spectral::Sampler> samplers_;
    Spectrum diffuse_albedo_;
};

}  // namespace hts::validation
