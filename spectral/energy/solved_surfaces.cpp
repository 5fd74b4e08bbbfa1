#include "spectral/energy/solved_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/energy/expected_distance.hpp"
#include "spectral/energy/expected_distance_data.hpp"
#include "spectral/text/csv.hpp"

namespace hts::spectral {
namespace {

std::vector<SolvedSurface> read_cases() {
    const auto table = CsvTable::parse(std::string{embedded_text(distance_files(), "vector-distances")},
                                       "vector-distances.csv");
    std::vector<SolvedSurface> cases;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const auto number = [&](std::string_view column) { return table.number(row, table.column(column)); };
        const bool along = number("azimuth_deg") == 0;  // 0 or 90
        const double x = number("tau_x_over_lambda"), y = number("tau_y_over_lambda");
        cases.push_back({number("sigma0_over_lambda"),
                         along ? x : y,
                         along ? y : x,
                         number("theta_i_deg"),
                         {number("he_ss_db"), number("he_pp_db"), number("he_cross_db"), number("he_db")},
                         {number("he_unified_ss_db"), number("he_unified_pp_db"),
                          number("he_unified_cross_db"), number("he_unified_db")}});
    }
    return cases;
}

/// How much two cases differ: the greatest difference of four, each in units of the most that counts as near.
double difference(const SolvedSurface& a, const SolvedSurface& b) {
    constexpr double factor = 1.6, degrees = 12;
    const auto of_lengths = [](double x, double y) { return std::fabs(std::log(x / y)) / std::log(factor); };
    return std::max(
        {of_lengths(a.rms_roughness, b.rms_roughness), of_lengths(a.length_in_plane, b.length_in_plane),
         of_lengths(a.length_across, b.length_across), std::fabs(a.theta_i_deg - b.theta_i_deg) / degrees});
}

}  // namespace

std::optional<SolvedSurface> nearest_solved(const Surface& surface, const SpectralSample& sample,
                                            const Direction& in) {
    static const std::vector<SolvedSurface> cases = read_cases();
    if (surface.correlation() || surface.rms_roughness() == 0 || sample.index.coated() ||
        !reflects_as_metal(sample.index.substrate()))
        return std::nullopt;
    const double lambda = sample.wavelength.micrometres();
    const Direction across = Direction::from_vector({-in.sin_phi(), in.cos_phi(), 0});
    const double in_plane = surface.correlation_length(in), beside = surface.correlation_length(across);
    // every case has an axis in the plane of incidence; elsewhere the product is below tau_x tau_y
    if (in_plane * beside < 0.95 * surface.correlation_length() * surface.correlation_length())
        return std::nullopt;
    const SolvedSurface asked{surface.rms_roughness() / lambda,
                              in_plane / lambda,
                              beside / lambda,
                              std::acos(std::fmin(1, in.cos_theta())) * 180 / std::numbers::pi,
                              {},
                              {}};
    const auto nearest = std::min_element(cases.begin(), cases.end(), [&](const auto& a, const auto& b) {
        return difference(a, asked) < difference(b, asked);
    });
    if (nearest == cases.end() || difference(*nearest, asked) > 1) return std::nullopt;
    return *nearest;
}

}  // namespace hts::spectral
