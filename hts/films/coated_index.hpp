/// Thin films on a substrate: amplitudes that take the place of Fresnel's, and what enters the substrate.
///
/// A stack of plane films, coherent, by Abeles' characteristic matrices: F. Abeles, Ann. Phys. (Paris) 12,
/// 596 and 706 (1950); Born and Wolf, Principles of Optics, section 1.6; Macleod, Thin-Film Optical Filters,
/// chapter 2. Conventions of fresnel.hpp: N = n + ik for exp(-i omega t), F_s = -F_p at normal incidence.
/// Phases are those of reflection at the outermost surface.
///
///   (B, A)   of the field along an interface: B its part across the plane of incidence, electric for s and
///            magnetic for p, A the other part along the interface; (1, Y) in the substrate, Y = r for s and
///            r/N^2 for p, r = sqrt(N^2 - sin^2)
///   a film   B' = C B - i S A, A' = C A - i r^2 S B for s; B' = C B - i N^2 S A, A' = C A - i (r^2/N^2) S B
///            for p, C = cos(delta) e^(i delta), S = sin(delta)/r e^(i delta), delta = k d r. The common
///            factor e^(i delta) has no effect on A/B and keeps C and S bounded however thick
///            and absorbing the film is
///   answer   F = (c - A/B)/(c + A/B) for s and for p
///
/// Both are even in r, so no sign of a root and no film at its own critical angle needs care.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hts/fresnel.hpp"
#include "hts/wavelength.hpp"

namespace hts {

namespace accuracy {
/// Of `CoatedIndex::amplitudes` and of `transmittance`, absolute, times 1 plus the optical thickness of all
/// films in radians, the sum of k d |N|, where all |N| lie from 0.05 to 20, and away from where Fresnel's
/// amplitudes of the substrate are worse.
inline constexpr double films = 1e-14;
/// Of `CoatedIndex::gradient`, each derivative beside 1 plus itself, times the same and away from there too.
inline constexpr double films_gradient = 5e-15;
}  // namespace accuracy

/// Derivatives of amplitudes by what a film is.
struct FilmGradient {
    FresnelAmplitudes by_n;
    FresnelAmplitudes by_phase;  ///< by k d, 2 pi thickness over the wavelength

    [[nodiscard]] FresnelAmplitudes by_k() const noexcept {
        const std::complex<double> i{0, 1};
        return {i * by_n.s, i * by_n.p};
    }
};

/// A layer of one substance.
struct Film {
    RefractiveIndex index;
    double thickness;  ///< [um]
};

/// What a surface is made of at one wavelength: a medium and the films that cover it, if any.
/// Immutable; copies share the films.
///
///     const std::vector<hts::Film> oxide{{{1.77, 0}, 0.004}};
///     const hts::CoatedIndex aluminium{{0.77, 6.08}, oxide, hts::Wavelength::from_micrometres(0.5)};
///     const double reflectance = aluminium.amplitudes(1).unpolarised_reflectance();
class CoatedIndex {
  public:
    static constexpr std::size_t most_films = 100;
    static constexpr double thickest = 1000;  ///< [um]

    /// No film.
    CoatedIndex(const RefractiveIndex& substrate)  // NOLINT(google-explicit-constructor): what a surface was
        : substrate_{substrate} {}
    CoatedIndex(double n, double k) : substrate_{n, k} {}
    ///   films   outermost first; those of thickness 0 are left out
    /// hts::Error for more than most_films, and for thicknesses that are not 0 ... thickest.
    CoatedIndex(const RefractiveIndex& substrate, std::span<const Film> films, const Wavelength& wavelength);

    /// The same seen from a transparent medium that takes the place of vacuum.
    ///   exterior   its index, > 0
    [[nodiscard]] CoatedIndex seen_from(double exterior) const;
    /// The stack turned over: what light in the substrate meets, relative to the substrate.
    ///   domain   a transparent substrate, k = 0
    [[nodiscard]] CoatedIndex turned_over() const;

    [[nodiscard]] const RefractiveIndex& substrate() const noexcept { return substrate_; }
    /// Whether there is a film.
    [[nodiscard]] bool coated() const noexcept { return layers_ != nullptr; }

    /// Reflected over incident field; `fresnel` where there is no film.
    ///   cos_theta   c, cosine of the angle of incidence   [1]   0 ... 1
    ///   limits      c = 0: both -1
    ///   error       accuracy::films, see there, or accuracy::fresnel
    ///   cost        of one film two of `fresnel`, of each further film one more; allocates nothing
    [[nodiscard]] FresnelAmplitudes amplitudes(double cos_theta) const noexcept;
    /// Amplitudes with their derivatives by cos theta and by the substrate's n; `fresnel_gradient` where
    /// there is no film.
    ///   films    film_count() of them, filled with the derivatives by each film, outermost first; or none
    ///   formula  with (B, A) above, dF = 2 (A d(cB) - cB dA)/(cB + A)^2. A dB - B dA that a film adds at its
    ///            upper side passes through the films above it times their determinants e^(2 i delta), which
    ///            neither overflow nor cancel
    ///   error    accuracy::films_gradient
    [[nodiscard]] FresnelGradient gradient(double cos_theta, std::span<FilmGradient> films) const noexcept;
    /// Of those that are not of thickness 0.
    [[nodiscard]] std::size_t film_count() const noexcept { return interfaces() - 1; }
    /// Share of unpolarised light that enters the substrate, just below its surface [1]; films may absorb the
    /// rest of what is not reflected.
    ///   error   as of amplitudes
    [[nodiscard]] double transmittance(double cos_theta) const noexcept;

    /// Fields at an interface for incident waves s and p of unit strength, over 2c.
    struct Fields {
        std::complex<double> s, p;        ///< B: electric field across the plane of incidence, and magnetic
        std::complex<double> p_electric;  ///< A: electric field of p along the interface
    };
    /// At every interface, from the outermost to the substrate's.
    ///   lift     what is added to c at the outermost surface, for p alone   [1]
    ///   fields   interfaces() of them
    void fields(double cos_theta, double lift, std::span<Fields> fields) const noexcept;
    [[nodiscard]] std::size_t interfaces() const noexcept { return layers_ ? layers_->size() + 1 : 1; }
    /// N^2 below an interface.
    [[nodiscard]] std::complex<double> square_below(std::size_t interface_number) const noexcept;
    /// Y of p at normal incidence, seen from outside: 1/N where there is no film.
    [[nodiscard]] std::complex<double> normal_impedance() const noexcept;
    /// Each film by n, k and 2 pi thickness over the wavelength, for checksums.
    [[nodiscard]] std::vector<std::array<double, 3>> film_numbers() const;

  private:
    struct Layer {
        Layer(const RefractiveIndex& of, double k_d);

        RefractiveIndex index;
        double phase;                                 // k d
        std::complex<double> square, inverse_square;  // N^2 and 1/N^2
    };
    struct Ray;
    CoatedIndex(const RefractiveIndex& substrate, std::vector<Layer> layers);
    [[nodiscard]] Ray deepest(double cos_theta) const noexcept;
    template <class Visit>
    [[nodiscard]] Ray walk(double cos_theta, Visit&& visit) const noexcept;

    RefractiveIndex substrate_;
    std::shared_ptr<const std::vector<Layer>> layers_;  // null where there is no film
};

}  // namespace hts
