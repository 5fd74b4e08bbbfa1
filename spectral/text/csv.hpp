/// Comma-separated tables with a header line, as the library and the command `hts` read them.
///
/// The first line names the columns; each further line is a row with as many fields. Lines that are blank or
/// begin with `#` are passed over anywhere. White space around a field does not count; a field may stand in
/// quotation marks, a quotation mark inside is doubled, and a line break ends the row even there. Line ends
/// LF or CR LF; UTF-8, with or without byte order mark.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hts/error.hpp"

namespace hts::spectral {

class CsvTable {
  public:
    /// hts::Error "path: …" or "path:line: …" if there is no header, a column has no name or stands twice,
    /// or a row has more or fewer fields than the header.
    [[nodiscard]] static CsvTable read(const std::filesystem::path& path);
    ///   text   the table      name   stands for the path in messages, "standard input"
    [[nodiscard]] static CsvTable parse(std::string_view text, std::string name);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
    [[nodiscard]] std::size_t row_count() const noexcept { return lines_.size(); }

    /// Position of a column, none if the table lacks it.
    [[nodiscard]] std::optional<std::size_t> find_column(std::string_view column) const noexcept;
    /// Position of a column; hts::Error "path:line: column "n": missing" if the table lacks it.
    [[nodiscard]] std::size_t column(std::string_view column) const;
    /// hts::Error "path:line: column "x": not known; must be …" if there is a column outside `known`.
    void require_known_columns(const std::vector<std::string>& known) const;

    /// A field as it stands. Rows and columns count from 0.
    [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const;
    /// A field as a finite number; hts::Error "path:line: column "k": "abc" is not a number" otherwise.
    [[nodiscard]] double number(std::size_t row, std::size_t column) const;

    /// Line of the file where a row stands, counted from 1.
    [[nodiscard]] std::size_t line(std::size_t row) const { return lines_.at(row); }
    /// hts::Error "path:line: message".
    [[nodiscard]] Error error(std::size_t row, std::string_view message) const;
    /// hts::Error "path:line: column "k": message".
    [[nodiscard]] Error error(std::size_t row, std::size_t column, std::string_view message) const;

  private:
    explicit CsvTable(std::string name) : name_{std::move(name)} {}
    void add_header(std::vector<std::string> columns, std::size_t line);
    void add_row(std::vector<std::string> fields, std::size_t line);

    std::string name_;
    std::vector<std::string> columns_;
    std::size_t header_line_ = 0;
    std::vector<std::string> fields_;  // all rows, one after the other
    std::vector<std::size_t> lines_;   // one per row
};

/// What the fields of one line hold, without the white space and quotation marks around them; hts::Error if a
/// quotation mark has no partner.
[[nodiscard]] std::vector<std::string> csv_fields(std::string_view line);

/// A field as it must be written: in quotation marks where it holds a comma, a quotation mark, a `#` in front
/// or white space at an end.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace hts::spectral
