#include "tables/table/spline.hpp"

#include <algorithm>
#include <vector>

namespace hts::tables {
namespace {

/// One line of coefficients, each `inner` numbers that are treated alike.
class Line {
  public:
    Line(std::span<double> line, std::size_t inner) : line_{line}, inner_{inner} {}

    [[nodiscard]] double* operator[](std::size_t i) const noexcept { return line_.data() + i * inner_; }
    /// f(j) for each of the numbers.
    template <class Function>
    void each(Function&& f) const {
        for (std::size_t j = 0; j < inner_; ++j) f(j);
    }

  private:
    std::span<double> line_;
    std::size_t inner_;
};

/// Solves c[i-1] + 4 c[i] + c[i+1] = 6 v[i] for first <= i <= last, in place, with
/// c[first-1] and c[last+1] known.
///   diagonal   of the first row: 4, and 2 c[i+1] there if `even`
void solve(const Line& c, std::size_t first, std::size_t last, bool even, std::vector<double>& upper) {
    upper.resize(last + 1);
    for (std::size_t i = first; i <= last; ++i) {
        const bool top = i == first;
        const double before = top ? 0 : 1;
        const double pivot = 1 / (4 - (top ? 0 : before * upper[i - 1]));
        upper[i] = (top && even ? 2 : 1) * pivot;
        const double known =
            top && !even ? 1 : before;  // c[first-1] is known, but nothing stands there if even
        c.each([&](std::size_t j) {
            c[i][j] = (6 * c[i][j] - known * (top && even ? 0 : c[i - 1][j])) * pivot;
        });
    }
    for (std::size_t i = last + 1; i-- > first;) {
        c.each([&](std::size_t j) { c[i][j] -= upper[i] * c[i + 1][j]; });
    }
}

/// The coefficient one node from a free end, from the values there, and then those outside of it.
void free_end(const Line& c, std::size_t end, std::size_t inside, std::size_t deeper) {
    c.each([&](std::size_t j) { c[inside][j] = (8 * c[inside][j] - c[end][j] - c[deeper][j]) / 6; });
}

}  // namespace

void to_spline_coefficients(std::span<double> block, std::size_t nodes, std::size_t inner,
                            SplineStart start) noexcept {
    const std::size_t stride = (nodes + spline_ghosts) * inner;
    std::vector<double> upper, ends;
    for (std::size_t from = 0; from < block.size(); from += stride) {
        const Line c{block.subspan(from, stride), inner};
        const bool even = start == SplineStart::even;
        // The values at and next to a free end are needed again once the coefficients
        // have taken their places.
        ends.assign(4 * inner, 0);
        c.each([&](std::size_t j) {
            ends[j] = c[1][j];
            ends[inner + j] = c[2][j];
            ends[2 * inner + j] = c[nodes - 1][j];
            ends[3 * inner + j] = c[nodes][j];
        });
        free_end(c, nodes, nodes - 1, nodes - 2);
        if (!even) free_end(c, 1, 2, 3);
        solve(c, even ? 1 : 3, nodes - 2, even, upper);
        c.each([&](std::size_t j) {
            c[nodes][j] = 6 * ends[2 * inner + j] - 4 * c[nodes - 1][j] - c[nodes - 2][j];
            c[nodes + 1][j] = 6 * ends[3 * inner + j] - 4 * c[nodes][j] - c[nodes - 1][j];
            if (even) {
                c[0][j] = c[2][j];
            } else {
                c[1][j] = 6 * ends[inner + j] - 4 * c[2][j] - c[3][j];
                c[0][j] = 6 * ends[j] - 4 * c[1][j] - c[2][j];
            }
        });
    }
}

SplinePlace spline_place(double x, std::size_t nodes) noexcept {
    const double scaled = std::clamp(x, 0.0, 1.0) * static_cast<double>(nodes - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(scaled), nodes - 2);
    const double f = scaled - static_cast<double>(first), r = 1 - f;
    return {first,
            {r * r * r / 6, (3 * f * f * f - 6 * f * f + 4) / 6, (3 * r * r * r - 6 * r * r + 4) / 6,
             f * f * f / 6}};
}

}  // namespace hts::tables
