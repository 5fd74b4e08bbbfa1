#include "validation/topography/maps/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hts::validation {

void HeightMap::require_size(double columns, double rows) {
    const auto legal = [](double count) {
        return count >= fewest && count <= most && count == std::floor(count);
    };
    if (legal(columns) && legal(rows) && columns * rows <= most_points) return;
    throw Error{shortest(columns) + " by " + shortest(rows) + " points: must be " + std::to_string(fewest) +
                " to " + std::to_string(most) + " along each side, at most " + std::to_string(most_points) +
                " in all"};
}

HeightMap::HeightMap(std::string name, std::size_t columns, std::size_t rows, double step_x, double step_y,
                     std::vector<double> heights)
    : name_{std::move(name)},
      columns_{columns},
      rows_{rows},
      step_x_{step_x},
      step_y_{step_y},
      heights_{std::move(heights)} {
    require_size(static_cast<double>(columns), static_cast<double>(rows));
    for (const double step : {step_x, step_y}) {
        if (!(step >= 1e-6 && step <= 1e6))
            throw out_of_range("point spacing", step, "um", "must be 1e-6 to 1e6 um");
    }
    if (heights_.size() != columns * rows) {
        throw Error{std::to_string(heights_.size()) + " heights: must be " + std::to_string(columns) +
                    " times " + std::to_string(rows)};
    }
    double lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (const double z : heights_) {
        if (std::isnan(z)) continue;
        if (!(std::fabs(z) <= 1e9)) throw out_of_range("height", z, "um", "must be within 1e9 um of 0");
        ++value_count_;
        lowest = std::min(lowest, z);
        highest = std::max(highest, z);
    }
    if (4 * value_count_ < heights_.size()) {
        throw Error{std::to_string(value_count_) + " of " + std::to_string(heights_.size()) +
                    " points have a height: must be a quarter at least"};
    }
    if (!(highest > lowest)) throw Error{"all heights are " + shortest(lowest) + " um: must differ"};
}

HeightMap HeightMap::with(std::vector<double> heights) const {
    return {name_, columns_, rows_, step_x_, step_y_, std::move(heights)};
}

}  // namespace hts::validation
