#include "spectral/text/csv.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

std::string place(const std::string& name, std::size_t line) {
    return name + ":" + std::to_string(line);
}

// Takes a field in quotation marks off the front of the line and returns what it holds.
std::string take_quoted(std::string_view& line) {
    std::string field;
    for (line.remove_prefix(1); !line.empty(); line.remove_prefix(1)) {
        if (line.front() == '"') {
            line.remove_prefix(1);
            if (!line.starts_with('"')) return field;
        }
        field += line.front();
    }
    throw Error{"quotation mark without its partner"};
}

std::string take_plain(std::string_view& line) {
    const auto end = std::min(line.find(','), line.size());
    std::string field{trimmed(line.substr(0, end))};
    line.remove_prefix(end);
    return field;
}

}  // namespace

std::vector<std::string> csv_fields(std::string_view line) {
    std::vector<std::string> fields;
    for (;;) {
        line = trimmed(line);
        fields.push_back(line.starts_with('"') ? take_quoted(line) : take_plain(line));
        line = trimmed(line);
        if (line.empty()) return fields;
        if (line.front() != ',') throw Error{"a comma must follow the closing quotation mark"};
        line.remove_prefix(1);
    }
}

CsvTable CsvTable::read(const std::filesystem::path& path) {
    return parse(read_text_file(path), path.string());
}

CsvTable CsvTable::parse(std::string_view text, std::string name) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    CsvTable table{std::move(name)};
    std::size_t number = 0;
    for (std::string_view line : split(text, '\n')) {
        ++number;
        line = trimmed(line);
        if (line.empty() || line.front() == '#') continue;
        auto fields = located(place(table.name_, number), [line] { return csv_fields(line); });
        if (table.columns_.empty()) {
            table.add_header(std::move(fields), number);
        } else {
            table.add_row(std::move(fields), number);
        }
    }
    if (table.columns_.empty()) throw Error{table.name_ + ": no header line with the names of the columns"};
    return table;
}

void CsvTable::add_header(std::vector<std::string> columns, std::size_t line) {
    for (auto name = columns.begin(); name != columns.end(); ++name) {
        if (name->empty()) {
            throw Error{place(name_, line) + ": column " + std::to_string(name - columns.begin() + 1) +
                        " has no name"};
        }
        if (std::find(columns.begin(), name, *name) != name) {
            throw Error{place(name_, line) + ": column " + in_quotes(*name) + ": stands twice"};
        }
    }
    columns_ = std::move(columns);
    header_line_ = line;
}

void CsvTable::add_row(std::vector<std::string> fields, std::size_t line) {
    if (fields.size() != columns_.size()) {
        throw Error{place(name_, line) + ": " + std::to_string(fields.size()) + " fields: must be " +
                    std::to_string(columns_.size()) + " as in the header"};
    }
    std::move(fields.begin(), fields.end(), std::back_inserter(fields_));
    lines_.push_back(line);
}

std::optional<std::size_t> CsvTable::find_column(std::string_view column) const noexcept {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::column(std::string_view column) const {
    const auto found = find_column(column);
    if (!found) throw Error{place(name_, header_line_) + ": column " + in_quotes(column) + ": missing"};
    return *found;
}

void CsvTable::require_known_columns(const std::vector<std::string>& known) const {
    for (const auto& name : columns_) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Error{place(name_, header_line_) + ": column " + in_quotes(name) +
                    ": not known; must be one of " + joined(known)};
    }
}

const std::string& CsvTable::text(std::size_t row, std::size_t column) const {
    return fields_.at(row * columns_.size() + column);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
    try {
        return number_in(text(row, column));
    } catch (const Error& failure) {
        throw error(row, column, failure.what());
    }
}

Error CsvTable::error(std::size_t row, std::string_view message) const {
    return Error{place(name_, line(row)) + ": " + std::string{message}};
}

Error CsvTable::error(std::size_t row, std::size_t column, std::string_view message) const {
    return error(row, "column " + in_quotes(columns_.at(column)) + ": " + std::string{message});
}

std::string csv_field(std::string_view text) {
    const bool plain = text.find_first_of(",\"") == std::string_view::npos && !text.starts_with('#') &&
                       trimmed(text) == text;
    if (plain) return std::string{text};
    std::string field = "\"";
    for (const char character : text) field.append(character == '"' ? 2 : 1, character);
    return field + '"';
}

}  // namespace hts::spectral
