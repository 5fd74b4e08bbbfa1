/// The Jones matrix of he_unified under films at one wavelength, from tables of amplitudes and fields over
/// the angles. Not installed.
#pragma once

#include <optional>
#include <span>

#include "hts/films/cosine_table.hpp"
#include "hts/he_torrance_spectrum.hpp"
#include "hts/polarisation.hpp"

namespace hts {

/// Bragg's matrix of a stack: the sum over the interfaces, each with the step of N^2 there and the fields
/// that both waves have there.
[[nodiscard]] JonesMatrix bragg_of_fields(const Direction& in, const Direction& out, const CoatedIndex& index,
                                          std::span<const CoatedIndex::Fields> of_in,
                                          std::span<const CoatedIndex::Fields> of_out) noexcept;

/// What a pair of directions contributes, whatever the films.
struct FilmPair {
    explicit FilmPair(const DirectionPair& of) noexcept;

    const Direction &in, &out;
    double cos_theta_d, kirchhoff, bragg;  ///< |v|^2/(2 v_z), 2 c_i c_r/v_z
    JonesMatrix s, p;                      ///< of facets that reflect s alone, and p alone
};

class FilmLobe {
  public:
    ///   lift   Z, see bragg_lift
    FilmLobe(const CoatedIndex& index, double lift);

    /// The matrix whose squared elements are BRDFs.
    ///   lobe, share   of SharesOne      error   accuracy::tabled_films beside the largest element over the
    ///                                           root of lobe
    [[nodiscard]] JonesMatrix operator()(const FilmPair& pair, double lobe, double share) const noexcept;
    [[nodiscard]] std::size_t bytes() const noexcept;

  private:
    template <std::size_t room>
    [[nodiscard]] JonesMatrix bragg(const FilmPair& pair) const noexcept;
    void fields(double cosine, std::span<CoatedIndex::Fields> fields) const noexcept;

    FilmTable amplitudes_;
    double lift_;
    std::optional<CosineTable> fields_;  // none where no table of bounded size would do
};

}  // namespace hts
