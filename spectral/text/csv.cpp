#include "spectral/text/csv.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
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

constexpr std::size_t rows_ahead = 16;

struct Separator {
    char character;
    const char* name;  // of many, "commas"
};
constexpr std::array separators{Separator{';', "semicolons"}, Separator{'\t', "tabs"},
                                Separator{',', "commas"}};

const char* name_of(char separator) {
    for (const Separator& each : separators)
        if (each.character == separator) return each.name;
    return "white space";
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

std::string_view without_blanks(std::string_view text, bool tabs_too) {
    const std::string_view blanks = tabs_too ? " \t\r\n\f\v" : " \r\n\f\v";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What the fields of one line hold, without the white space and quotation marks around them.
std::vector<std::string> fields_between(std::string_view line, char separator) {
    const bool blanks = separator == ' ', tabs_too = separator != '\t';
    const std::string_view ends = blanks ? std::string_view{" \t"} : std::string_view{&separator, 1};
    std::vector<std::string> fields;
    for (;;) {
        line = without_blanks(line, tabs_too);
        if (line.starts_with('"')) {
            fields.push_back(take_quoted(line));
        } else {
            const auto end = std::min(line.find_first_of(ends), line.size());
            fields.emplace_back(without_blanks(line.substr(0, end), tabs_too));
            line.remove_prefix(end);
        }
        if (!blanks) line = without_blanks(line, tabs_too);
        if (line.empty()) return fields;
        if (ends.find(line.front()) == std::string_view::npos) {
            const std::string name = name_of(separator);
            throw Error{"a " + (blanks ? name : name.substr(0, name.size() - 1)) +
                        " must follow the closing quotation mark"};
        }
        if (!blanks) line.remove_prefix(1);
    }
}

/// Outside quotation marks.
std::size_t count_of(std::string_view line, char separator) {
    std::size_t count = 0;
    bool quoted = false;
    for (const char character : line) {
        if (character == '"') quoted = !quoted;
        if (character == separator && !quoted) ++count;
    }
    return count;
}

bool is_number(std::string_view text) {
    try {
        static_cast<void>(number_in(text));
    } catch (const Error&) {
        return false;
    }
    return true;
}

/// "0.5" of "0,5", "" of what has no decimal comma.
std::string with_point(const std::string& field) {
    const auto comma = field.find(',');
    if (comma == std::string::npos || field.find('.') != std::string::npos) return {};
    const char after = comma + 1 < field.size() ? field[comma + 1] : ' ';
    if (after < '0' || after > '9') return {};
    std::string number = field;
    number[comma] = '.';
    return is_number(number) ? number : std::string{};
}

bool is_numeric(const std::string& field) {
    return is_number(field) || !with_point(field).empty();
}

/// How many fields of a row are numbers; 0 if they are not as many as the columns.
std::size_t numeric_fields(std::string_view row, char separator, std::size_t columns) {
    try {
        const auto fields = fields_between(row, separator);
        if (fields.size() < columns) return 0;
        return static_cast<std::size_t>(std::ranges::count_if(fields, is_numeric));
    } catch (const Error&) {
        return 0;
    }
}

/// The one that the header has; where it has several, that which leaves most numbers in the first row.
char separator_of(std::string_view header, std::string_view first_row) {
    std::optional<char> best;
    std::size_t most = 0;
    for (const Separator& each : separators) {
        const std::size_t columns = count_of(header, each.character) + 1;
        if (columns == 1) continue;
        const std::size_t numbers = numeric_fields(first_row, each.character, columns);
        if (best && numbers <= most) continue;
        best = each.character;
        most = numbers;
    }
    if (best) return *best;
    // a name may hold a blank: only numbers tell that white space separates
    const auto columns = words(header).size();
    const bool blanks =
        columns > 1 && words(first_row).size() == columns && numeric_fields(first_row, ' ', columns) > 0;
    return blanks ? ' ' : ',';
}

// As std::getline; of what has no lines, such as a device, no more than the beginning is read.
bool take_line(std::istream& stream, std::string& line) {
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

std::string CsvHeader::dialect_in_words() const {
    if (dialect_ == CsvDialect{}) return {};
    return std::string{name_of(dialect_.separator)} + " between fields" +
           (dialect_.decimal_comma ? ", decimal commas" : "");
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
    auto header = next_line();
    if (!header) throw Error{this->name() + ": no header line with the names of the columns"};
    find_dialect(*header);
    auto names = fields_of(*header);
    while (names.size() > 1 && names.back().empty()) names.pop_back();
    set_columns(std::move(names), header->number);
}

std::optional<CsvReader::Line> CsvReader::read_line() {
    std::string text;
    while (located(name(), [&] { return take_line(*stream_, text); })) {
        ++line_;
        bytes_read_ += text.size() + 1;
        if (line_ == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
        if (!is_text(text)) throw Error{where(line_) + "not UTF-8 text"};
        // spreadsheets keep the separators of empty rows
        const auto first = text.find_first_not_of(" \t\r\f\v,;");
        if (first == std::string::npos || trimmed(text).front() == '#') continue;
        return Line{line_, std::move(text)};
    }
    if (stream_->bad()) throw Error{name() + ": reading failed after line " + std::to_string(line_)};
    return std::nullopt;
}

std::optional<CsvReader::Line> CsvReader::next_line() {
    if (ahead_.empty()) return read_line();
    Line line = std::move(ahead_.front());
    ahead_.pop_front();
    return line;
}

void CsvReader::find_dialect(Line& header) {
    const std::string_view said = trimmed(header.text);
    const bool says = said.size() == 5 && said.starts_with("sep=");
    if (says) {
        dialect_.separator = said.back();
        auto next = read_line();
        if (!next) throw Error{name() + ": no header line with the names of the columns"};
        header = *std::move(next);
    }
    while (ahead_.size() < rows_ahead) {
        auto line = read_line();
        if (!line) break;
        ahead_.push_back(*std::move(line));
    }
    if (!says) dialect_.separator = separator_of(header.text, ahead_.empty() ? "" : ahead_.front().text);
    if (dialect_.separator == ',') return;
    for (const Line& line : ahead_) {
        for (const std::string& field : fields_of(line))
            dialect_.decimal_comma = dialect_.decimal_comma || !with_point(field).empty();
    }
}

std::vector<std::string> CsvReader::fields_of(const Line& line) const {
    try {
        return fields_between(line.text, dialect_.separator);
    } catch (const Error& error) {
        throw Error{where(line.number) + error.what()};
    }
}

void CsvReader::unify_decimals(CsvRow& row) {
    for (std::string& field : row.fields) {
        std::string number = with_point(field);
        const bool point = number.empty() && field.find('.') != std::string::npos && is_number(field);
        if (point && point_line_ == 0) point_line_ = row.line;
        if (!number.empty() && comma_line_ == 0) comma_line_ = row.line;
        if ((point || !number.empty()) && point_line_ > 0 && comma_line_ > 0) {
            throw Error{where(row.line) + in_quotes(field) + ": a decimal " + (point ? "point" : "comma") +
                        ", where line " + std::to_string(point ? comma_line_ : point_line_) +
                        " has a decimal " + (point ? "comma" : "point") + ": must be one of them"};
        }
        if (!number.empty()) field = std::move(number);
    }
}

std::optional<CsvRow> CsvReader::next() {
    const auto line = next_line();
    if (!line) return std::nullopt;
    CsvRow row{line->number, fields_of(*line)};
    while (row.fields.size() > columns().size() && row.fields.back().empty()) row.fields.pop_back();
    if (row.fields.size() != columns().size()) {
        std::string message = where(row.line) + std::to_string(row.fields.size()) + " fields: must be " +
                              std::to_string(columns().size()) + " as in the header";
        for (const Separator& other : separators) {
            if (other.character == dialect_.separator || count_of(line->text, other.character) == 0) continue;
            message += std::string{", which has "} + name_of(dialect_.separator) +
                       " between fields where this line has " + other.name;
            break;
        }
        if (words(line->text).size() == columns().size() && columns().size() > 1)
            message += std::string{", which has "} + name_of(dialect_.separator) +
                       " between fields where this line has white space";
        if (columns().size() == 1 && words(columns().front()).size() == row.fields.size())
            message += std::string{", which has white space between names where this line has "} +
                       name_of(dialect_.separator);
        if (dialect_.separator == ',' && columns().size() > 2 && row.fields.size() > columns().size() &&
            count_of(line->text, '.') == 0)
            message += "; numbers with decimal commas need semicolons or tabs between fields";
        throw Error{message};
    }
    if (dialect_.separator != ',') unify_decimals(row);
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
