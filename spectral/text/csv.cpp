#include "spectral/text/csv.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

#include "spectral/text/run_files.hpp"
#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

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

/// What the fields of one line hold, without the white space and quotation marks around them.
std::vector<std::string> fields_of(std::string_view line) {
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

// As std::getline; of what has no lines, such as a device, no more than the beginning is read.
bool read_line(std::istream& stream, std::string& line) {
    constexpr std::size_t longest = std::size_t{1} << 26;
    using Traits = std::istream::traits_type;
    line.clear();
    for (auto c = stream.get(); !Traits::eq_int_type(c, Traits::eof()); c = stream.rdbuf()->sbumpc()) {
        if (c == '\n') return true;
        line += Traits::to_char_type(c);
        if (c == '\0') return true;
        if (line.size() > longest) throw Error{"line of more than 64 MiB: must be text in lines"};
    }
    return !line.empty();
}

std::unique_ptr<std::istream> opened(const std::string& path) {
    if (path == "-") {
        // closed or a folder, which the stream would take for an empty file
        if (::read(STDIN_FILENO, nullptr, 0) != 0)
            throw Error{std::string{"<stdin>: cannot be read: "} + std::strerror(errno)};
        return std::make_unique<std::istream>(std::cin.rdbuf());
    }
    require_file(path);
    auto file = std::make_unique<std::ifstream>(path_to_read(path), std::ios::binary);
    if (!*file) throw Error{path + ": cannot be read: " + std::strerror(errno)};
    if (file->peek() == std::istream::traits_type::eof()) throw Error{path + ": file is empty"};
    return file;
}

}  // namespace

std::optional<std::size_t> CsvHeader::find_column(std::string_view column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) return std::nullopt;
    if (std::find(found + 1, columns_.end(), column) != columns_.end()) {
        throw Error{where_header() + "column " + in_quotes(column) + ": stands twice"};
    }
    return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvHeader::column(std::string_view column) const {
    const auto found = find_column(column);
    if (!found) throw Error{where_header() + "column " + in_quotes(column) + ": missing"};
    return *found;
}

void CsvHeader::require_known_columns(const std::vector<std::string>& known) const {
    for (const auto& name : columns_) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Error{where_header() + "column " + in_quotes(name) + ": not known; " +
                    must_be_one_of(name, known)};
    }
}

std::string CsvHeader::where(std::size_t line) const {
    return name_.empty() ? "" : name_ + ":" + std::to_string(line) + ": ";
}

void CsvHeader::set_columns(std::vector<std::string> columns, std::size_t line) {
    columns_ = std::move(columns);
    header_line_ = line;
}

CsvReader::CsvReader(const std::string& path) : CsvReader{path == "-" ? "<stdin>" : path, opened(path)} {}

CsvReader CsvReader::from_text(std::string_view text, const std::string& name) {
    return {name, std::make_unique<std::istringstream>(std::string{text})};
}

CsvReader::CsvReader(std::string name, std::unique_ptr<std::istream> stream)
    : CsvHeader{std::move(name)}, stream_{std::move(stream)} {
    std::optional<CsvRow> header = next_line();
    if (!header) throw Error{this->name() + ": no header line with the names of the columns"};
    set_columns(std::move(header->fields), header->line);
}

std::optional<CsvRow> CsvReader::next_line() {
    std::string text;
    while (located(name(), [&] { return read_line(*stream_, text); })) {
        ++line_;
        if (line_ == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
        if (!is_text(text)) throw Error{where(line_) + "not UTF-8 text"};
        const std::string_view line = trimmed(text);
        if (line.empty() || line.front() == '#') continue;
        try {
            return CsvRow{line_, fields_of(line)};
        } catch (const Error& error) {
            throw Error{where(line_) + error.what()};
        }
    }
    if (stream_->bad()) throw Error{name() + ": reading failed after line " + std::to_string(line_)};
    return std::nullopt;
}

std::optional<CsvRow> CsvReader::next() {
    auto row = next_line();
    if (row && row->fields.size() != columns().size()) {
        throw Error{where(row->line) + std::to_string(row->fields.size()) + " fields: must be " +
                    std::to_string(columns().size()) + " as in the header"};
    }
    return row;
}

std::vector<CsvRow> CsvReader::read(std::size_t count) {
    std::vector<CsvRow> rows;
    while (rows.size() < count) {
        auto row = next();
        if (!row) break;
        rows.push_back(std::move(*row));
    }
    return rows;
}

CsvTable CsvTable::read(const std::filesystem::path& path) {
    return parse(read_text_file(path), path.string());
}

CsvTable CsvTable::parse(std::string_view text, const std::string& name) {
    return CsvTable{CsvReader::from_text(text, name)};
}

CsvTable::CsvTable(CsvReader rows) : CsvHeader{rows} {
    for (std::size_t i = 0; i < columns().size(); ++i) {
        if (columns()[i].empty()) {
            throw Error{where_header() + "column " + std::to_string(i + 1) + " has no name"};
        }
    }
    std::vector<std::string_view> names{columns().begin(), columns().end()};
    std::ranges::sort(names);
    if (const auto twin = std::ranges::adjacent_find(names); twin != names.end())
        static_cast<void>(column(*twin));  // says where
    while (auto row = rows.next()) rows_.push_back(std::move(*row));
}

const std::string& CsvTable::text(std::size_t row, std::size_t column) const {
    return rows_.at(row).fields.at(column);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
    try {
        return number_in(text(row, column));
    } catch (const Error& failure) {
        throw error(row, column, failure.what());
    }
}

Error CsvTable::error(std::size_t row, std::string_view message) const {
    return Error{where(line(row)) + std::string{message}};
}

Error CsvTable::error(std::size_t row, std::size_t column, std::string_view message) const {
    return error(row, "column " + in_quotes(columns().at(column)) + ": " + std::string{message});
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
