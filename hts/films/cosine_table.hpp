// Smooth functions of the cosine of an angle of incidence, tabulated: amplitudes of films, which take long.
// Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hts/films/coated_index.hpp"

namespace hts {

namespace accuracy {
/// Of amplitudes and fields of films from tables, absolute, at tolerances of 1e-6 and coarser: of the
/// reflectance F^2 the relative error is twice this over |F|.
inline constexpr double tabled_films = 1e-10;
}  // namespace accuracy

/// Several quantities by polynomials of degree 7 over equal cells of sqrt(cos theta), which are narrow near
/// the horizon, where amplitudes of metals turn.
class CosineTable {
  public:
    /// Most cells: some thousand fringes of the quantities.
    static constexpr std::size_t most_cells = 512;

    /// None where most_cells do not reach the error: of films of very many fringes, and where the quantities
    /// have a kink, as where total reflection begins.
    ///   of      fills the values of all quantities at a cosine, 0 ... 1
    ///   error   absolute, measured between the nodes of every cell
    [[nodiscard]] static std::optional<CosineTable> made(
        std::size_t quantities, const std::function<void(double cosine, std::span<double> values)>& of,
        double error);

    ///   values   as many as there are quantities
    void at(double cosine, std::span<double> values) const noexcept {
        const Place place = place_of(cosine);
        constexpr std::size_t together = 6;
        std::size_t first = 0;
        for (; first + together <= values.size(); first += together)
            std::ranges::copy(some<together>(place, first),
                              values.begin() + static_cast<std::ptrdiff_t>(first));
        for (; first < values.size(); ++first) values[first] = some<1>(place, first)[0];
    }
    template <std::size_t quantities>
    [[nodiscard]] std::array<double, quantities> at(double cosine) const noexcept {
        return some<quantities>(place_of(cosine), 0);
    }
    [[nodiscard]] std::size_t bytes() const noexcept { return coefficients_.size() * sizeof(double); }

  private:
    static constexpr std::size_t terms = 8;

    struct Place {
        const double* of;  // coefficients of the cell, by power, then by quantity
        double x;          // -1 ... 1
    };
    /// Quantities from the first on.
    template <std::size_t count>
    [[nodiscard]] std::array<double, count> some(const Place& place, std::size_t first) const noexcept {
        const double* row = place.of + (terms - 1) * quantities_ + first;
        std::array<double, count> values;
        for (std::size_t q = 0; q < count; ++q) values[q] = row[q];
        for (std::size_t k = terms - 1; k-- > 0;) {
            row -= quantities_;
            for (std::size_t q = 0; q < count; ++q) values[q] = values[q] * place.x + row[q];
        }
        return values;
    }
    CosineTable(std::size_t quantities, std::size_t cells)
        : quantities_{quantities}, cells_{cells}, coefficients_(cells * terms * quantities) {}
    [[nodiscard]] Place place_of(double cosine) const noexcept {
        const double position = std::sqrt(cosine) * static_cast<double>(cells_);
        const std::size_t cell = std::min(static_cast<std::size_t>(position), cells_ - 1);
        return {coefficients_.data() + cell * terms * quantities_,
                2 * (position - static_cast<double>(cell)) - 1};
    }

    std::size_t quantities_, cells_;
    std::vector<double> coefficients_;
};

/// Amplitudes of films at the angles of incidence.
class FilmTable {
  public:
    explicit FilmTable(const CoatedIndex& index);

    /// As of CoatedIndex, with accuracy::tabled_films; by its own means where there is no table.
    [[nodiscard]] FresnelAmplitudes amplitudes(double cos_theta) const noexcept {
        if (!table_) return index_.amplitudes(cos_theta);
        const auto [s, s_imaginary, p, p_imaginary] = table_->at<4>(cos_theta);
        return {{s, s_imaginary}, {p, p_imaginary}};
    }
    [[nodiscard]] const CoatedIndex& index() const noexcept { return index_; }
    [[nodiscard]] bool tabled() const noexcept { return table_.has_value(); }
    [[nodiscard]] std::size_t bytes() const noexcept { return sizeof *this + (table_ ? table_->bytes() : 0); }

  private:
    CoatedIndex index_;
    std::optional<CosineTable> table_;  // none of bare surfaces
};

}  // namespace hts
