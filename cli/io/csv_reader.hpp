/// Reads CSV files with a header, a chunk of rows at a time.
/// The format is that of spectral/text/csv.hpp; this reader does not hold the whole file, so it may be of any
/// length.
#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hts::cli {

/// One line and what its fields hold.
struct CsvRow {
    std::size_t line;
    std::vector<std::string> fields;
};

class CsvReader {
  public:
    /// Opens a file, or standard input for "-", and reads its header. Throws hts::Error "path: …" if it is a
    /// directory, cannot be read or is empty.
    explicit CsvReader(const std::string& path);
    /// Reads from memory; messages then carry neither path nor line.
    [[nodiscard]] static CsvReader from_text(const std::string& text);

    /// Names of the columns.
    [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return header_.fields; }
    /// Position of a column; hts::Error if the header has it twice.
    [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;
    /// The same, hts::Error if the header lacks it.
    [[nodiscard]] std::size_t required_column(std::string_view name) const;

    /// Up to `count` further rows, none at the end. hts::Error if a row has not as many fields as the header.
    [[nodiscard]] std::vector<CsvRow> read(std::size_t count);

    /// "path:line: ", the beginning of a message about a row.
    [[nodiscard]] std::string where(std::size_t line) const;
    [[nodiscard]] std::string where_header() const { return where(header_.line); }

  private:
    CsvReader(std::string name, std::unique_ptr<std::istream> stream);
    [[nodiscard]] std::optional<CsvRow> next();

    std::string name_;
    std::unique_ptr<std::istream> stream_;
    std::size_t line_ = 0;
    CsvRow header_{};
};

/// A field as a finite number; hts::Error `<quantity>: "abc" is not a number` otherwise.
[[nodiscard]] double number(std::string_view field, std::string_view quantity);

}  // namespace hts::cli
