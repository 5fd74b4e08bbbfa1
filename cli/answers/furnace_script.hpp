/// The furnace map as a picture: a panel per slope, angle of incidence across, roughness upwards.
#pragma once

#include <string>
#include <vector>

namespace hts::cli {

/// The grid of the map; rows of values run over slopes, then roughnesses, then angles.
struct FurnaceGrid {
    std::vector<double> slopes;       ///< sigma_0/tau
    std::vector<double> roughnesses;  ///< sigma_0/lambda, spaced by a constant factor
    std::vector<double> degrees;      ///< of incidence, equally spaced

    [[nodiscard]] std::size_t size() const noexcept {
        return slopes.size() * roughnesses.size() * degrees.size();
    }
};

/// Gnuplot script that holds its own data.
///   totals   total reflectance of each point of the grid
[[nodiscard]] std::string furnace_script(const FurnaceGrid& grid, const std::vector<double>& totals,
                                         const std::string& title, const std::string& subtitle);

}  // namespace hts::cli
