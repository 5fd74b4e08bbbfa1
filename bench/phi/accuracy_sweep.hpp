/// How wrong each method is, regime by regime and over the whole (g, t/g) plane, against 50 digits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bench/phi/chart_methods.hpp"
#include "bench/phi/phi_reference.hpp"

namespace hts::bench {

/// Largest t/g of the charts: beyond, a lobe holds less than 1e-300 of its peak.
inline constexpr double most_ratio = 700;

/// Arguments of Phi; times their Phi, `weights` are shares of the lobe's energy.
struct PhiInputs {
    std::vector<double> g, t, weights;

    [[nodiscard]] std::size_t size() const noexcept { return g.size(); }
};

/// A kind of surface and geometry, a panel of the chart.
enum class Regime { smooth, moderate, rough, very_rough, grazing, far_tail };
inline constexpr Regime regimes[] = {Regime::smooth,     Regime::moderate, Regime::rough,
                                     Regime::very_rough, Regime::grazing,  Regime::far_tail};

/// "g-below-1" for tables, "g < 1" for people.
[[nodiscard]] const char* key(Regime regime) noexcept;
[[nodiscard]] const char* title(Regime regime) noexcept;

/// Random inputs of a regime with t/g <= most_ratio, the same on every machine.
///   smooth ... very_rough   g log-uniform in 1e-3 ... 1, 1 ... 20, 20 ... 200, 200 ... 1e6;
///                           t uniform in 0 ... 10 max(g, 1), where the lobe has its energy
///   grazing                 pairs of directions at 80 ... 89.9 deg on surfaces of sigma_0 = 0.05 ... 2 um,
///                           tau = 3 ... 30 sigma_0, wavelength 0.4 ... 0.8 um
///   far_tail                g log-uniform in 1e-3 ... 1e6, t/g uniform in 50 ... most_ratio
[[nodiscard]] PhiInputs random_inputs(Regime regime, std::size_t count, std::uint64_t seed);

/// Inputs with their Phi; those with Phi < least_phi are left out.
struct ReferencePoints {
    PhiInputs inputs;
    std::vector<PhiReference> phi;
};
/// On all cores; about 1 ms each.
[[nodiscard]] ReferencePoints with_reference(const PhiInputs& inputs);

/// Relative errors of a method over a set of points.
struct ErrorSummary {
    std::size_t points = 0;
    std::size_t failures = 0;  ///< of them 0, infinite, NaN or wrong by 100 % or more
    double worst = 0;          ///< infinity for 0, an infinity or NaN
    double quantile = 0;       ///< 99.9 % of the points are better
    double energy = 0;         ///< weighted by the energy that goes there; a failure counts as wrong by 100 %
    double worst_g = 0, worst_t = 0;

    /// Whether it answers somewhere with no correct digit.
    [[nodiscard]] bool fails() const noexcept { return failures > 0; }
};

[[nodiscard]] ErrorSummary errors(const ChartMethod& method, const ReferencePoints& points);

/// The (g, t/g) plane as a grid, logarithmic along both.
struct PlaneGrid {
    std::size_t columns, rows;
    static constexpr double least_g = 1e-2, most_g = 1e6, least_ratio = 1e-2, greatest_ratio = most_ratio;

    /// Middle of a cell.
    [[nodiscard]] double g(std::size_t column) const noexcept;
    [[nodiscard]] double ratio(std::size_t row) const noexcept;
};

/// Phi at the middle of every cell, row by row; value 0 where Phi < least_phi.
struct PlaneReference {
    PlaneGrid grid;
    PhiInputs inputs;
    std::vector<PhiReference> phi;
};
[[nodiscard]] PlaneReference plane_reference(const PlaneGrid& grid);

/// Relative error in every cell: infinity where the method fails, NaN where Phi < least_phi.
[[nodiscard]] std::vector<double> plane_errors(const ChartMethod& method, const PlaneReference& plane);

}  // namespace hts::bench
