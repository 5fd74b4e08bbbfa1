/// Tables with a header line, read as a stream of rows or as a whole: what
/// spreadsheets and instruments write.
///
/// The first line names the columns; each further line is a row with as many fields. Fields stand between
/// commas, semicolons or tabs, or between white space where header and first row have no other: one separator
/// a file, found from the header, from a first line "sep=;" where there is one. Where it is no comma, numbers
/// may have decimal commas, all of them. Lines that are blank, hold separators alone or begin with `#` are
/// passed over anywhere, empty fields behind the last column too. White space around a field does not count;
/// a field may stand in quotation marks, a quotation mark inside is doubled, and a line break ends the row
/// even there. Line ends LF or CR LF; UTF-8, with or without byte order mark.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hts/error.hpp"

namespace hts::spectral {

class LineSource;
class NpyReader;

/// How a table is written.
struct CsvDialect {
    char separator = ',';  ///< ' ' for any white space
    bool decimal_comma = false;

    friend bool operator==(const CsvDialect&, const CsvDialect&) = default;
};

/// A column of wavelengths, in either unit.
struct WavelengthColumn {
    std::size_t place;
    bool nanometres;

    [[nodiscard]] const char* name() const noexcept { return nanometres ? "wavelength_nm" : "wavelength_um"; }
    [[nodiscard]] double micrometres(double number) const noexcept {
        return nanometres ? number / 1000 : number;
    }
};

/// The columns of a table and where they are named.
class CsvHeader {
  public:
    /// The file as it stands in messages; "<stdin>" for standard input, empty for a text without a name.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }

    /// Position of a column, none if the table lacks it; hts::Error "path:line: column "n": stands twice".
    [[nodiscard]] std::optional<std::size_t> find_column(std::string_view column) const;
    /// Position of a column; hts::Error "path:line: column "n": missing" if the table lacks it, too, with
    /// what stands there in other letters, or the character between the names that separates none.
    [[nodiscard]] std::size_t column(std::string_view column) const;
    /// The column wavelength_um or wavelength_nm, none if there is neither; hts::Error if there are both.
    [[nodiscard]] std::optional<WavelengthColumn> find_wavelength() const;
    /// The same; hts::Error as of `column` if there is neither, too.
    [[nodiscard]] WavelengthColumn wavelength() const;
    /// hts::Error "path:line: column "x": not known; must be …" if there is a column outside `known`.
    void require_known_columns(const std::vector<std::string>& known) const;

    /// Found from the header and the first rows.
    [[nodiscard]] const CsvDialect& dialect() const noexcept { return dialect_; }
    /// "semicolons between fields, decimal commas"; "" where both are as usual.
    [[nodiscard]] std::string dialect_in_words() const;

    /// "path:line: ", the beginning of a message about a line; empty for a text without a name.
    [[nodiscard]] std::string where(std::size_t line) const;
    /// The same of the line that names the columns.
    [[nodiscard]] std::string where_header() const { return where(header_line_); }

  protected:
    explicit CsvHeader(std::string name) : name_{std::move(name)} {}
    void set_columns(std::vector<std::string> columns, std::size_t line);

    CsvDialect dialect_;

  private:
    std::string name_;
    std::vector<std::string> columns_;
    std::size_t header_line_ = 0;
};

/// A row: its line in the file, counted from 1, and what its fields hold.
struct CsvRow {
    std::size_t line;
    std::vector<std::string> fields;
    std::vector<double> numbers{};  ///< of a .npy file, instead of fields

    /// A field as a finite number; hts::Error "quantity: …" if it is none.
    [[nodiscard]] double number(std::size_t column, std::string_view quantity) const;
};

/// Lines of a table that hold a row each, not looked into yet.
class CsvLines {
  public:
    [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
    [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
    /// Line of the file where it stands, counted from 1.
    [[nodiscard]] std::size_t line(std::size_t i) const { return lines_[i].number; }
    [[nodiscard]] std::string_view text(std::size_t i) const {
        return std::string_view{texts_}.substr(lines_[i].begin, lines_[i].size);
    }
    void add(std::size_t number, std::string_view text) {
        lines_.push_back({number, texts_.size(), text.size()});
        texts_ += text;
    }
    void clear() noexcept {
        texts_.clear();
        lines_.clear();
    }

  private:
    struct Line {
        std::size_t number, begin, size;
    };
    std::string texts_;
    std::vector<Line> lines_;
};

/// Reads row by row, so that a file may be of any length. A column that nobody asks for may lack a name or
/// have that of another. A file whose name ends in .npy is a structured array of NumPy, whose fields are the
/// columns and whose "lines" are its elements, counted from 1.
class CsvReader : public CsvHeader {
  public:
    /// Opens a file, or standard input for "-", and reads its header. hts::Error "path: …" if it is missing,
    /// a directory, unreadable, empty or without a header.
    explicit CsvReader(const std::string& path);
    CsvReader(CsvReader&&) = default;
    CsvReader& operator=(CsvReader&&) = default;
    /// Reads a text.
    ///   name   stands for the path in messages
    [[nodiscard]] static CsvReader from_text(std::string_view text, const std::string& name = {});

    /// The next row, none at the end. hts::Error "path:line: …" if it is not UTF-8, a quotation mark has no
    /// partner, or it has more or fewer fields than the header.
    [[nodiscard]] std::optional<CsvRow> next();
    /// Up to `count` further rows as they stand, none at the end, so that threads may share what `parse`
    /// does; into lines whose memory is used again.
    void take(std::size_t count, CsvLines& lines);
    /// What a line holds, into a row whose memory is used again; hts::Error as of `next`. Any thread may
    /// call.
    void parse(const CsvLines& lines, std::size_t i, CsvRow& row) const {
        parse(lines.line(i), lines.text(i), row);
    }
    /// How much was read so far.
    [[nodiscard]] std::size_t bytes_read() const noexcept { return bytes_read_; }

  private:
    struct Line {
        std::size_t number;
        std::string text;
    };
    CsvReader(std::string name, std::shared_ptr<LineSource> source);
    CsvReader(const std::string& path, std::shared_ptr<NpyReader> npy);
    [[nodiscard]] bool read_line(Line& line);
    [[nodiscard]] bool next_line(Line& line);
    void find_dialect(Line& header);
    [[nodiscard]] std::vector<std::string> fields_of(std::size_t line, std::string_view text) const;
    void parse(std::size_t line, std::string_view text, CsvRow& row) const;
    [[noreturn]] void refuse_count(const CsvRow& row, std::string_view text) const;
    void require_one_decimal_sign(const Line& line);

    std::shared_ptr<LineSource> source_;
    std::shared_ptr<NpyReader> npy_;  // instead of a source of lines
    std::deque<Line> ahead_;          // read to find the dialect
    std::size_t line_ = 0, bytes_read_ = 0, point_line_ = 0, comma_line_ = 0;
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
/// The same at the end of a row.
void append_csv_field(std::string& row, std::string_view text);

}  // namespace hts::spectral
