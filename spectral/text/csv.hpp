/// Comma-separated tables with a header line, read as a stream of rows or as a whole.
///
/// The first line names the columns; each further line is a row with as many fields. Lines that are blank or
/// begin with `#` are passed over anywhere. White space around a field does not count; a field may stand in
/// quotation marks, a quotation mark inside is doubled, and a line break ends the row even there. Line ends
/// LF or CR LF; UTF-8, with or without byte order mark.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hts/error.hpp"

namespace hts::spectral {

/// The columns of a table and where they are named.
class CsvHeader {
  public:
    /// The file as it stands in messages; "<stdin>" for standard input, empty for a text without a name.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }

    /// Position of a column, none if the table lacks it; hts::Error "path:line: column "n": stands twice".
    [[nodiscard]] std::optional<std::size_t> find_column(std::string_view column) const;
    /// Position of a column; hts::Error "path:line: column "n": missing" if the table lacks it, too.
    [[nodiscard]] std::size_t column(std::string_view column) const;
    /// hts::Error "path:line: column "x": not known; must be …" if there is a column outside `known`.
    void require_known_columns(const std::vector<std::string>& known) const;

    /// "path:line: ", the beginning of a message about a line; empty for a text without a name.
    [[nodiscard]] std::string where(std::size_t line) const;
    /// The same of the line that names the columns.
    [[nodiscard]] std::string where_header() const { return where(header_line_); }

  protected:
    explicit CsvHeader(std::string name) : name_{std::move(name)} {}
    void set_columns(std::vector<std::string> columns, std::size_t line);

  private:
    std::string name_;
    std::vector<std::string> columns_;
    std::size_t header_line_ = 0;
};

/// A row: its line in the file, counted from 1, and what its fields hold.
struct CsvRow {
    std::size_t line;
    std::vector<std::string> fields;
};

/// Reads row by row, so that a file may be of any length. A column that nobody asks for may lack a name or
/// have that of another.
class CsvReader : public CsvHeader {
  public:
    /// Opens a file, or standard input for "-", and reads its header. hts::Error "path: …" if it is missing,
    /// a directory, unreadable, empty or without a header.
    explicit CsvReader(const std::string& path);
    /// Reads a text.
    ///   name   stands for the path in messages
    [[nodiscard]] static CsvReader from_text(std::string_view text, const std::string& name = {});

    /// The next row, none at the end. hts::Error "path:line: …" if it is not UTF-8, a quotation mark has no
    /// partner, or it has more or fewer fields than the header.
    [[nodiscard]] std::optional<CsvRow> next();
    /// Up to `count` further rows, none at the end.
    [[nodiscard]] std::vector<CsvRow> read(std::size_t count);

  private:
    CsvReader(std::string name, std::unique_ptr<std::istream> stream);
    [[nodiscard]] std::optional<CsvRow> next_line();

    std::unique_ptr<std::istream> stream_;
    std::size_t line_ = 0;
};

/// A whole table. Every column has a name of its own.
class CsvTable : public CsvHeader {
  public:
    /// hts::Error as of CsvReader, and "path:line: …" if a column has no name or stands twice.
    [[nodiscard]] static CsvTable read(const std::filesystem::path& path);
    ///   text   the table      name   stands for the path in messages
    [[nodiscard]] static CsvTable parse(std::string_view text, const std::string& name);

    [[nodiscard]] std::size_t row_count() const noexcept { return rows_.size(); }

    /// A field as it stands. Rows and columns count from 0.
    [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const;
    /// A field as a finite number; hts::Error "path:line: column "k": "abc" is not a number" otherwise.
    [[nodiscard]] double number(std::size_t row, std::size_t column) const;

    /// Line of the file where a row stands, counted from 1.
    [[nodiscard]] std::size_t line(std::size_t row) const { return rows_.at(row).line; }
    /// hts::Error "path:line: message".
    [[nodiscard]] Error error(std::size_t row, std::string_view message) const;
    /// hts::Error "path:line: column "k": message".
    [[nodiscard]] Error error(std::size_t row, std::size_t column, std::string_view message) const;

  private:
    explicit CsvTable(CsvReader rows);

    std::vector<CsvRow> rows_;
};

/// A field as it must be written: in quotation marks where it holds a comma, a quotation mark, a `#` in front
/// or white space at an end.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace hts::spectral
