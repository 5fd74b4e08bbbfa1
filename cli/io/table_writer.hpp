/// Writes tables as CSV with a header, as a JSON array with an object per row, or as a structured array of
/// NumPy.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cli/io/output.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {

enum class Format { csv, json, npy };

/// JSON if asked for or if the path ends in .json, a structured array if it ends in .npy.
[[nodiscard]] Format format_of(std::string_view path, bool json);

/// 17 significant digits, enough to read back the same double.
void append_number(std::string& text, double value);
using spectral::brief;
/// A JSON string with its quotes.
[[nodiscard]] std::string json_string(std::string_view text);

/// A table under construction. Rows are rendered as text first (by any thread) and then added in order.
class TableWriter {
  public:
    /// Throws hts::Error if JSON would get the same key twice.
    TableWriter(Output& output, Format format, const std::vector<std::string>& columns);

    /// One row, cell by cell, appended to a text.
    class Row {
      public:
        Row(const TableWriter& table, std::string& text);
        /// Any text; in JSON a number if it reads as one, else a string.
        Row& field(const std::string& text);
        /// A word without comma or quote.
        Row& word(std::string_view word);
        /// JSON knows neither infinity nor NaN: null.
        Row& number(double value);
        /// The same by the fewest digits that read back the same.
        Row& short_number(double value);
        void end();

      private:
        void begin_cell();
        void append_bytes(double value);
        const TableWriter& table_;
        std::string& text_;
        std::size_t cell_ = 0;
    };

    /// Adds rows rendered by `Row`.
    void add(std::string_view rows);
    void finish();

  private:
    Output& output_;
    Format format_;
    std::vector<std::string> columns_;
    std::vector<std::string> keys_;  // what stands before each cell
    std::size_t npy_bytes_ = 0;      // behind its header
    bool empty_ = true;
};

}  // namespace hts::cli
