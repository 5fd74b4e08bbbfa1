// The functions that the tables of Phi hold, and the polynomials fitted to them. The
// names are phi_table.hpp's.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hts/phi/tables/chebyshev.hpp"
#include "hts/phi/tables/phi_series.hpp"
#include "hts/phi/tables/phi_table.hpp"

namespace hts::phi_detail {

/// A cell: an interval of 1 + t (of v in the row above 2^emax) by an interval of zeta.
struct Cell {
    bool top, saddle;
    int exponent;  // of the row's g
    double v0, v1, zeta0, zeta1;
};

template <class Real>
struct Point {
    Real g, t;
};

/// The mantissa of g at zeta: the inverse of phi_table.hpp's coordinate.
template <class Real>
Real mantissa_at(Real zeta) {
    const Real s = (zeta - Real(0.5)) / Real(zeta_scale);
    return Real(root2) * (1 + s) / (1 - s);
}

/// x and z in [-1, 1]
template <class Spec, class Real>
Point<Real> point_of(const Cell& cell, Real x, Real z) {
    const Real v = Real(cell.v0) + Real(cell.v1 - cell.v0) * (x + 1) / 2;
    const Real zeta = Real(cell.zeta0) + Real(cell.zeta1 - cell.zeta0) * (z + 1) / 2;
    if (cell.top) {
        const Real g = Real(std::ldexp(1.0, Spec::emax)) / zeta;
        return {g, (v - 1) / Real(v_scale) * g * g};
    }
    if (cell.exponent < Spec::emin) return {zeta * Real(std::ldexp(1.0, Spec::emin)), v - 1};
    return {Real(std::ldexp(1.0, cell.exponent)) * mantissa_at(zeta), v - 1};
}

/// Whether ln Phi > least_log_phi, by the saddle point.
template <class Real>
bool counts(const Point<Real>& p) {
    using std::log;
    const Real w = half_lambert(Real(p.t / (p.g * p.g)));
    return p.g * saddle_exponent(w) - log(p.g) - w - log(1 + 2 * w) / 2 > Real(least_log_phi);
}

struct Row {
    int exponent;  // emin - 1: all g below 2^emin
    bool top;
    int octaves;
};

/// An octave in one piece.
inline Cell octave_of(const Row& row, int octave) {
    return {row.top, true, row.exponent, std::ldexp(1.0, octave), std::ldexp(2.0, octave), 0, 1};
}

template <class Spec>
Row row_of(int exponent) {
    if (exponent < Spec::emin) return {exponent, false, 3};
    Row row{exponent, exponent == Spec::emax, 0};
    // Phi is largest where an octave begins and g is largest (in the top row, at the same v, least)
    while (counts(point_of<Spec, long double>(octave_of(row, row.octaves), -1, 1))) ++row.octaves;
    return row;
}

/// The cells of an octave, cut into 2^log2_x by 2^log2_z.
inline std::vector<Cell> cut(const Row& row, int octave, const Entry& entry) {
    const int nx = 1 << entry.log2_x, nz = 1 << entry.log2_z;
    std::vector<Cell> cells;
    for (int i = 0; i < nx; ++i) {
        for (int j = 0; j < nz; ++j) {
            cells.push_back({row.top, entry.saddle, row.exponent, std::ldexp(1 + double(i) / nx, octave),
                             std::ldexp(1 + double(i + 1) / nx, octave), double(j) / nz, double(j + 1) / nz});
        }
    }
    return cells;
}

/// Q
template <class Real>
Real correction(bool saddle, const Point<Real>& p) {
    using std::log;
    const SeriesSums<Real> sums = series_sums(p.g, p.t);
    if (!saddle) return (sums.log_scale + p.t + log(sums.phi / p.g)) / boost::math::constants::ln_two<Real>();
    const Real w = half_lambert(Real(p.t / (p.g * p.g)));
    return (sums.log_scale - p.g * saddle_exponent(w) + log(sums.phi * p.g) + w + log(1 + 2 * w) / 2) /
           boost::math::constants::ln_two<Real>();
}

/// F and W
template <class Real>
struct Lines {
    Real slope, width;
};

template <class Real>
Lines<Real> lines_at(Real v) {
    using std::log;
    const Real u = (v - 1) / Real(v_scale);
    const Real ln2 = boost::math::constants::ln_two<Real>();
    if (!(u > Real(1e-40))) return {1 / ln2, Real(0)};
    const Real w = half_lambert(u);
    return {-saddle_exponent(w) / u / ln2, -(w + log(1 + 2 * w) / 2) / ln2};
}

/// The nearest multiple of what a sum of such coefficients resolves at |x|, |z| <= 1/2, which keeps the files
/// short; `bits` behind the binary point for the coefficient of power 0.
template <class Real>
double rounded(const Real& coefficient, int power, int bits) {
    const double grid = std::ldexp(1.0, power - bits);
    return std::round(static_cast<double>(coefficient / Real(grid))) * grid;
}

/// Coefficients by rows of powers of x, each of powers of z.
///   of   what is fitted, a function of whether the saddle point leads, and of a point
template <class Spec, class Real, class Function>
std::vector<double> fitted(const Cell& cell, Function of) {
    constexpr bool single = sizeof(typename Spec::Coefficient) == 4;
    const auto nx = static_cast<std::size_t>(Spec::rows), nz = static_cast<std::size_t>(Spec::lanes);
    std::vector<std::vector<Real>> by_z;  // at each node in x
    for (const Real& x : chebyshev_nodes<Real>(Spec::rows)) {
        std::vector<Real> values;
        for (const Real& z : chebyshev_nodes<Real>(Spec::lanes))
            values.push_back(of(cell.saddle, point_of<Spec>(cell, x, z)));
        by_z.push_back(interpolant(values));
    }
    std::vector<double> coefficients(nx * nz);
    for (std::size_t j = 0; j < nz; ++j) {
        std::vector<Real> values;
        for (const auto& polynomial : by_z) values.push_back(polynomial[j]);
        const std::vector<Real> polynomial = interpolant(values);
        for (std::size_t i = 0; i < nx; ++i) {
            const double c = rounded(polynomial[i], static_cast<int>(i + j), single ? 31 : 60);
            coefficients[i * nz + j] = single ? static_cast<double>(static_cast<float>(c)) : c;
        }
    }
    return coefficients;
}

template <class Spec>
long double value_of(const std::vector<double>& coefficients, long double x, long double z) {
    long double sum = 0;
    for (int k = Spec::lanes - 1; k >= 0; --k) {
        long double column = 0;
        for (int i = Spec::rows - 1; i >= 0; --i)
            column = column * x + coefficients[static_cast<std::size_t>(i * Spec::lanes + k)];
        sum = sum * z + column;
    }
    return sum;
}

/// Worst error, times ln 2, on a grid over the cell, as far as the cell is used; ends once above `limit`.
template <class Spec, class Function>
double worst_error(const Cell& cell, const std::vector<double>& coefficients, Function of, double limit) {
    constexpr int n = 7;
    double worst = 0;
    for (int i = 0; i < n && worst <= limit; ++i) {
        for (int j = 0; j < n; ++j) {
            const long double x = i == 0 ? -1 : i == n - 1 ? 1 : -1 + 2 * (i + 0.37L) / n;
            const long double first = cell.top && cell.zeta0 == 0 ? -1 + 2e-6L : -0.9999L;
            const long double z = j == 0 ? first : j == n - 1 ? 1 : -1 + 2 * (j + 0.61L) / n;
            const auto p = point_of<Spec>(cell, x, z);
            if (!counts(p)) continue;
            const long double error = value_of<Spec>(coefficients, x / 2, z / 2) - of(cell.saddle, p);
            worst = std::max(worst, static_cast<double>(std::abs(error) * std::log(2.0L)));
        }
    }
    return worst;
}

}  // namespace hts::phi_detail
