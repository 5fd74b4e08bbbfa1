/// Height maps as text. Private to the room.
#pragma once

#include <string_view>

#include "validation/topography/maps/map_files.hpp"

namespace hts::validation {

/// Units as a file states them; what a map needs and nobody says is hts::Error, and what both say too.
class StatedUnits {
  public:
    explicit StatedUnits(const MapUnits& given) : given_{given} {}

    void state_step(double x, double y) { stated_.step_x = x, stated_.step_y = y; }
    void state_length(double um) { stated_.length = um; }
    void state_height(double um) { stated_.height = um; }

    [[nodiscard]] double step_x() const;
    [[nodiscard]] double step_y() const;
    [[nodiscard]] double length() const;
    [[nodiscard]] double height() const;

    /// hts::Error if units were given that the file has no use for.
    void refuse_step() const;
    void refuse_length() const;

  private:
    MapUnits given_, stated_;
};

/// A text that is an ESRI grid, Gwyddion's matrix, a matrix or points.
///   text   the whole file      name   of the map
/// hts::Error that begins with "line 3: " where a line is wrong.
[[nodiscard]] HeightMap map_from_text(std::string_view text, const std::string& name, const MapUnits& given);

}  // namespace hts::validation
