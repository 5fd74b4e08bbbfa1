/// FRED's scatter table: lines of `!` or `#` first as remarks, "type bsdf_data", "format angles=deg
/// bsdf=value scale=1", then a line "theta_i phi_i" before the lines "theta_s phi_s bsdf" it lights. VIAVI's
/// files have a head of lines "!! …". What a point means is left to who reads it. Private to the readers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hts::tables {

struct FredPoint {
    double theta_i, phi_i, theta_s, phi_s;  ///< [deg]
    double value;                           ///< [1/sr], times the scale that the file says
    std::size_t line;
};

struct FredFile {
    std::vector<std::string> remarks;  ///< of the head, a line each, without its marks
    std::vector<FredPoint> points;
};

/// Whether a text begins like one.
[[nodiscard]] bool is_fred_file(std::string_view text);

///   name   of the file
/// hts::Error "path:line: …" for anything else.
[[nodiscard]] FredFile fred_file(std::string_view text, const std::string& name);

}  // namespace hts::tables
