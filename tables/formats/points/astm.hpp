/// ASTM E1392 (E2387) scatter files as text: lines of a keyword and its value, of which VARS names the
/// columns and NUM_POINTS may count the rows; below VARS a row of numbers for each point, angles
/// in radians. Not installed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hts::tables {

/// What such a file holds, its rows in their order. Names and numbers stand between commas, or in a line
/// without commas between blanks; empty lines and those that begin with # are passed over.
struct AstmFile {
    /// Columns of the angles; a file without phi_i has light from azimuth 0.
    std::size_t theta_i = 0, theta_s = 0, phi_s = 0;
    std::optional<std::size_t> phi_i{};
    /// All other columns, with their names: "450nm".
    std::vector<std::size_t> channels{};
    std::vector<std::string> channel_names{};

    std::size_t columns = 0;
    std::vector<double> numbers{};     ///< row by row
    std::vector<std::size_t> lines{};  ///< of each row in the file

    [[nodiscard]] std::span<const double> row(std::size_t i) const {
        return std::span{numbers}.subspan(i * columns, columns);
    }
};

/// Whether a text has such a line VARS.
[[nodiscard]] bool is_astm_file(std::string_view text);

/// hts::Error "name:line: …" for what is no such file: no VARS, columns missing or named twice, a row of
/// other length, an empty cell or a word that is no number, rows that are not as many as NUM_POINTS says.
[[nodiscard]] AstmFile astm_file(std::string_view text, const std::string& name);

}  // namespace hts::tables
