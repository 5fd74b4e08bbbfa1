#include "spectral/output/map_cells.hpp"

#include <cstdlib>
#include <string_view>

namespace hts::output {

Rows map_cells(const std::vector<double>& across, const std::vector<double>& upwards,
               const std::function<const char*(std::size_t row, std::size_t column)>& colour) {
    Rows cells;
    const std::size_t columns = across.size() - 1;
    for (std::size_t row = 0; row + 1 < upwards.size(); ++row) {
        for (std::size_t first = 0, next = 0; first < columns; first = next) {
            const std::string_view own = colour(row, first);
            while (next < columns && colour(row, next) == own) ++next;
            cells.push_back({across[first], across[next], upwards[row], upwards[row + 1],
                             colour_number(colour(row, first))});
        }
    }
    return cells;
}

double colour_number(const char* colour) {
    return static_cast<double>(std::strtol(colour + 1, nullptr, 16));
}

}  // namespace hts::output
