#include "hts/films/cosine_table.hpp"

#include <algorithm>
#include <numbers>

namespace hts {
namespace {

constexpr std::size_t terms = 8;
using Powers = std::array<double, terms>;

double node(std::size_t j) {
    return std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / terms);
}

/// Powers of x of the polynomial that is 1 at a node and 0 at the others.
std::array<Powers, terms> cardinal_polynomials() {
    std::array<Powers, terms> all{};
    for (std::size_t j = 0; j < terms; ++j) {
        Powers& polynomial = all[j];
        polynomial[0] = 1;
        for (std::size_t i = 0, degree = 0; i < terms; ++i) {
            if (i == j) continue;
            const double over = 1 / (node(j) - node(i));
            for (std::size_t k = ++degree; k > 0; --k)
                polynomial[k] = (polynomial[k - 1] - node(i) * polynomial[k]) * over;
            polynomial[0] *= -node(i) * over;
        }
    }
    return all;
}

}  // namespace

std::optional<CosineTable> CosineTable::made(
    std::size_t quantities, const std::function<void(double cosine, std::span<double> values)>& of,
    double error) {
    static const std::array<Powers, terms> cardinals = cardinal_polynomials();
    constexpr std::size_t fewest_cells = 8;
    std::vector<double> values(quantities), tabled(quantities);
    for (std::size_t cells = fewest_cells; cells <= most_cells; cells *= 2) {
        CosineTable table{quantities, cells};
        bool enough = true;
        for (std::size_t cell = 0; cell < cells && enough; ++cell) {
            const auto cosine = [&](double x) {
                const double root = (static_cast<double>(cell) + (1 + x) / 2) / static_cast<double>(cells);
                return std::min(root * root, 1.0);
            };
            double* const coefficients = table.coefficients_.data() + cell * terms * quantities;
            for (std::size_t j = 0; j < terms; ++j) {
                of(cosine(node(j)), values);
                for (std::size_t k = 0; k < terms; ++k) {
                    for (std::size_t q = 0; q < quantities; ++q)
                        coefficients[k * quantities + q] += cardinals[j][k] * values[q];
                }
            }
            // what is left out is greatest at the ends and in the middle of a cell
            for (const double x : {-0.999, 0.0, 0.999}) {
                of(cosine(x), values);
                table.at(cosine(x), tabled);
                for (std::size_t q = 0; q < quantities; ++q)
                    enough = enough && std::abs(values[q] - tabled[q]) <= error / 2;
            }
        }
        if (enough) return table;
    }
    return std::nullopt;
}

FilmTable::FilmTable(const CoatedIndex& index) : index_{index} {
    if (!index.coated()) return;
    table_ = CosineTable::made(
        4,
        [&index](double cosine, std::span<double> values) {
            const FresnelAmplitudes f = index.amplitudes(cosine);
            const std::array<double, 4> parts{f.s.real(), f.s.imag(), f.p.real(), f.p.imag()};
            std::ranges::copy(parts, values.begin());
        },
        accuracy::tabled_films);
}

}  // namespace hts
