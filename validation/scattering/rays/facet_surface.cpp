#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "validation/scattering/rays/facet_tracing.hpp"

namespace hts::validation {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t wrapped(std::ptrdiff_t i, std::size_t period) {
    const auto n = static_cast<std::ptrdiff_t>(period);
    return static_cast<std::size_t>(((i % n) + n) % n);
}

/// A plane over a cell, height + slopes times the place in it, and where a ray is above it.
struct Facet {
    double height, slope_x, slope_y;

    [[nodiscard]] double above(const Vector3& at) const {
        return at.z - (height + slope_x * at.x + slope_y * at.y);
    }
};

/// One coordinate of a walk from cell to cell, in units of cells.
struct Axis {
    std::ptrdiff_t cell;
    std::ptrdiff_t step;
    double next, per_cell;  // of the ray's parameter: at the next border, and from border to border

    Axis(double origin, double direction)
        : cell{static_cast<std::ptrdiff_t>(std::floor(origin))}, step{direction < 0 ? -1 : 1} {
        if (direction < 0 && origin == static_cast<double>(cell)) --cell;
        const auto border = static_cast<double>(direction < 0 ? cell : cell + 1);
        next = direction == 0 ? infinity : (border - origin) / direction;
        per_cell = direction == 0 ? infinity : std::fabs(1 / direction);
    }
    void advance() {
        cell += step;
        next += per_cell;
    }
};

}  // namespace

FacetSurface::FacetSurface(RandomField field)
    : field_{std::move(field)}, highest_{*std::max_element(field_.height.begin(), field_.height.end())} {}

double FacetSurface::period() const noexcept {
    return field_.step * static_cast<double>(field_.samples);
}

FacetSurface::Cell FacetSurface::cell(std::ptrdiff_t i, std::ptrdiff_t j) const {
    const std::size_t n = field_.samples, column = wrapped(i, n), row = wrapped(j, n) * n;
    const std::size_t next_column = column + 1 == n ? 0 : column + 1,
                      next_row = row + n == n * n ? 0 : row + n;
    const auto& z = field_.height;
    return {z[row + column], z[row + next_column], z[next_row + column], z[next_row + next_column]};
}

namespace {

/// The triangle at (0,0), or that at (1,1).
template <class Cell>
Facet facet_of(const Cell& cell, bool lower) {
    if (lower) return {cell.low, cell.along - cell.low, cell.across - cell.low};
    return {cell.along + cell.across - cell.high, cell.high - cell.across, cell.high - cell.along};
}

/// A ray's way over one cell, in the coordinates of the cell.
struct Passage {
    Vector3 start, direction;
    double from, to;  // of the ray's parameter

    [[nodiscard]] Vector3 point(double where) const { return start + where * direction; }
    [[nodiscard]] double least_height() const { return std::min(point(from).z, point(to).z); }
};

struct Crossing {
    double where;
    Facet facet;
};

/// Where a ray that comes from above goes below a facet.
std::optional<Crossing> crossing(const Facet& facet, const Passage& way) {
    const double after = facet.above(way.point(way.to));
    if (after >= 0) return std::nullopt;
    const double before = std::max(0.0, facet.above(way.point(way.from)));
    return Crossing{way.from + (way.to - way.from) * before / (before - after), facet};
}

/// The same over both triangles of a cell.
template <class Cell>
std::optional<Crossing> crossing(const Cell& heights, const Passage& way) {
    if (way.least_height() > std::max({heights.low, heights.along, heights.across, heights.high}))
        return std::nullopt;
    const double turn = way.direction.x + way.direction.y, begin = way.start.x + way.start.y;
    const double diagonal = (1 - begin) / turn;
    const bool both = diagonal > way.from && diagonal < way.to;
    const double first_end = both ? diagonal : way.to;
    const bool lower = begin + (way.from + first_end) / 2 * turn < 1;
    const auto met = crossing(facet_of(heights, lower), {way.start, way.direction, way.from, first_end});
    if (met || !both) return met;
    return crossing(facet_of(heights, !lower), {way.start, way.direction, diagonal, way.to});
}

}  // namespace

FacetSurface::Hit FacetSurface::at(double x, double y) const {
    const double u = x / field_.step, v = y / field_.step;
    const double i = std::floor(u), j = std::floor(v);
    const Facet facet =
        facet_of(cell(static_cast<std::ptrdiff_t>(i), static_cast<std::ptrdiff_t>(j)), (u - i) + (v - j) < 1);
    const double z = -facet.above({u - i, v - j, 0});
    return {{x, y, z}, {-facet.slope_x / field_.step, -facet.slope_y / field_.step, 1}};
}

/// From cell to cell along the ray; in each, along the one or two triangles that it passes over. The ray is
/// above the surface until it is below a triangle at the end of its way over it: heights agree along edges,
/// so nothing slips through.
std::optional<FacetSurface::Hit> FacetSurface::first_hit(const Ray& ray) const {
    Vector3 origin = ray.origin;
    const bool outside = origin.z > highest_;
    if (outside && ray.direction.z >= 0) return std::nullopt;
    if (outside) origin = origin + ((highest_ - origin.z) / ray.direction.z) * ray.direction;
    const double per_step = 1 / field_.step;
    const Vector3 start{origin.x * per_step, origin.y * per_step, origin.z};
    const Vector3 direction{ray.direction.x * per_step, ray.direction.y * per_step, ray.direction.z};
    Axis x{start.x, direction.x}, y{start.y, direction.y};
    for (double from = 0;;) {
        const double to = std::max(from, std::min(x.next, y.next));
        if (to == infinity && direction.z < 0) return at(origin.x, origin.y);
        if (to == infinity) return std::nullopt;
        const Vector3 corner{static_cast<double>(x.cell), static_cast<double>(y.cell), 0};
        if (const auto met = crossing(cell(x.cell, y.cell), {start - corner, direction, from, to}))
            return Hit{origin + met->where * ray.direction,
                       {-met->facet.slope_x * per_step, -met->facet.slope_y * per_step, 1}};
        if (direction.z >= 0 && start.z + to * direction.z > highest_) return std::nullopt;
        from = to;
        (x.next < y.next ? x : y).advance();
    }
}

}  // namespace hts::validation
