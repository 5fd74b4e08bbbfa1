#include "cli/io/csv_reader.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <system_error>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::cli {
namespace {

std::unique_ptr<std::istream> opened(const std::string& path) {
    if (path == "-") return std::make_unique<std::istream>(std::cin.rdbuf());
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) {
        throw Error{path + ": is a directory: must be a CSV file"};
    }
    auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
    if (!*file) throw Error{path + ": cannot be opened: must be a readable CSV file"};
    return file;
}

bool to_be_skipped(std::string_view line) {
    return spectral::trimmed(line).empty() || line.front() == '#';
}

}  // namespace

CsvReader::CsvReader(const std::string& path) : CsvReader{path == "-" ? "<stdin>" : path, opened(path)} {}

CsvReader CsvReader::from_text(const std::string& text) {
    return {"", std::make_unique<std::istringstream>(text)};
}

CsvReader::CsvReader(std::string name, std::unique_ptr<std::istream> stream)
    : name_{std::move(name)}, stream_{std::move(stream)} {
    std::optional<CsvRow> header = next();
    if (!header) throw Error{name_ + ": is empty: must have a header line with the names of the columns"};
    header_ = std::move(*header);
}

std::optional<CsvRow> CsvReader::next() {
    std::string line;
    while (std::getline(*stream_, line)) {
        ++line_;
        if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
        if (line.ends_with('\r')) line.pop_back();
        if (to_be_skipped(line)) continue;
        return CsvRow{line_, spectral::located(name_ + ":" + std::to_string(line_),
                                               [&] { return spectral::csv_fields(line); })};
    }
    if (stream_->bad()) throw Error{name_ + ": reading failed after line " + std::to_string(line_)};
    return std::nullopt;
}

std::vector<CsvRow> CsvReader::read(std::size_t count) {
    std::vector<CsvRow> rows;
    while (rows.size() < count) {
        std::optional<CsvRow> row = next();
        if (!row) break;
        if (row->fields.size() != columns().size()) {
            throw Error{where(row->line) + std::to_string(row->fields.size()) + " fields: must be " +
                        std::to_string(columns().size()) + " as in the header"};
        }
        rows.push_back(std::move(*row));
    }
    return rows;
}

std::optional<std::size_t> CsvReader::column(std::string_view name) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < columns().size(); ++i) {
        if (columns()[i] != name) continue;
        if (found) throw Error{where_header() + "column " + std::string{name} + " twice: must be there once"};
        found = i;
    }
    return found;
}

std::size_t CsvReader::required_column(std::string_view name) const {
    const auto found = column(name);
    if (!found)
        throw Error{where_header() + "column " + std::string{name} + " missing: must be in the header"};
    return *found;
}

std::string CsvReader::where(std::size_t line) const {
    return name_.empty() ? "" : name_ + ":" + std::to_string(line) + ": ";
}

double number(std::string_view field, std::string_view quantity) {
    return spectral::located(std::string{quantity}, [field] { return spectral::number_in(field); });
}

}  // namespace hts::cli
