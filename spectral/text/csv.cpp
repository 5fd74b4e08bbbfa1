#include "spectral/text/csv.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "spectral/text/line_source.hpp"
#include "spectral/text/npy.hpp"
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
    if (!text.empty() && text.front() > ' ' && text.back() > ' ') return text;
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

/// The fields of a line without quotation marks, between commas, in strings whose memory is used again.
void take_fields(std::string_view line, std::vector<std::string>& fields) {
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
        const auto end = line.find(',');
        more = end != std::string_view::npos;
        const std::string_view field = without_blanks(line.substr(0, end), true);
        if (count < fields.size()) {
            fields[count].assign(field);
        } else {
            fields.emplace_back(field);
        }
        if (more) line.remove_prefix(end + 1);
    }
    fields.resize(count);
}

/// What to say of a header in which the name stands, and a character beside it that separates nothing.
std::string other_separator(std::string_view header, std::string_view name) {
    const auto at = header.find(name);
    if (at == std::string_view::npos || header.size() == name.size()) return {};
    const char beside = at > 0 ? header[at - 1] : header[name.size()];
    if (std::isalnum(static_cast<unsigned char>(beside)) != 0 || beside == '_') return {};
    return "; fields must stand between commas, semicolons, tabs or white space, not " +
           in_quotes(std::string{beside});
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
    if (const auto found = find_column(column)) return *found;
    std::string message = where_header() + "column " + in_quotes(column) + ": missing";
    const auto meant =
        std::ranges::find_if(columns_, [&](const std::string& name) { return same_letters(name, column); });
    if (meant != columns_.end()) message += "; must be written so, not " + in_quotes(*meant);
    if (columns_.size() == 1) message += other_separator(columns_.front(), column);
    throw Error{message};
}

std::optional<WavelengthColumn> CsvHeader::find_wavelength() const {
    const auto um = find_column("wavelength_um"), nm = find_column("wavelength_nm");
    if (um && nm)
        throw Error{where_header() +
                    R"(columns "wavelength_um" and "wavelength_nm": must be one of the two)"};
    if (nm) return WavelengthColumn{*nm, true};
    return um ? std::optional{WavelengthColumn{*um, false}} : std::nullopt;
}

WavelengthColumn CsvHeader::wavelength() const {
    const auto found = find_wavelength();
    return found ? *found : WavelengthColumn{column("wavelength_um"), false};
}

void CsvHeader::require_known_columns(const std::vector<std::string>& known) const {
    for (const auto& name : columns_) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Error{where_header() + "column " + in_quotes(name) + ": not known; " +
                    must_be_one_of(name, known)};
    }
}

std::string CsvHeader::where(std::size_t line) const {
    if (name_.empty()) return {};
    return line == 0 ? name_ + ": " : name_ + ":" + std::to_string(line) + ": ";
}

std::string CsvHeader::dialect_in_words() const {
    if (dialect_ == CsvDialect{}) return {};
    return std::string{name_of(dialect_.separator)} + " between fields" +
           (dialect_.decimal_comma ? ", decimal commas" : "");
}

double CsvRow::number(std::size_t column, std::string_view quantity) const {
    if (numbers.empty()) return number_in(fields[column], quantity);
    const double value = numbers[column];
    if (!std::isfinite(value))
        throw Error{std::string{quantity} + ": " + brief(value) + " is not a finite number"};
    return value;
}

void CsvHeader::set_columns(std::vector<std::string> columns, std::size_t line) {
    columns_ = std::move(columns);
    header_line_ = line;
}

CsvReader::CsvReader(const std::string& path)
    : CsvReader{path.ends_with(".npy")
                    ? CsvReader{path, std::make_shared<NpyReader>(path)}
                    : CsvReader{path == "-" ? "<stdin>" : path, LineSource::of_file(path)}} {}

CsvReader::CsvReader(const std::string& path, std::shared_ptr<NpyReader> npy)
    : CsvHeader{path}, npy_{std::move(npy)} {
    set_columns(npy_->columns(), 0);
}

CsvReader CsvReader::from_text(std::string_view text, const std::string& name) {
    return {name, std::make_shared<LineSource>(std::string{text})};
}

CsvReader::CsvReader(std::string name, std::shared_ptr<LineSource> source)
    : CsvHeader{std::move(name)}, source_{std::move(source)} {
    Line header;
    if (source_->is_empty_file()) throw Error{this->name() + ": file is empty"};
    if (!next_line(header)) throw Error{this->name() + ": no header line with the names of the columns"};
    if (const auto end = header.text.find('\r'); end < header.text.size() - 1)
        throw Error{where(header.number) + "lines end with CR alone: must end with LF or CR LF"};
    find_dialect(header);
    auto names = fields_of(header.number, header.text);
    while (names.size() > 1 && names.back().empty()) names.pop_back();
    set_columns(std::move(names), header.number);
}

bool CsvReader::read_line(Line& line) {
    while (located(name(), [&] { return source_->take_line(line.text); })) {
        ++line_;
        bytes_read_ += line.text.size() + 1;
        std::string& text = line.text;
        if (line_ == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
        if (!is_text(text)) throw Error{where(line_) + no_text(text)};
        // spreadsheets keep the separators of empty rows
        const auto first = text.find_first_not_of(" \t\r\f\v,;");
        if (first == std::string::npos || trimmed(text).front() == '#') continue;
        line.number = line_;
        return true;
    }
    if (source_->failed()) throw Error{name() + ": reading failed after line " + std::to_string(line_)};
    return false;
}

bool CsvReader::next_line(Line& line) {
    if (ahead_.empty()) return read_line(line);
    line = std::move(ahead_.front());
    ahead_.pop_front();
    return true;
}

void CsvReader::find_dialect(Line& header) {
    const std::string_view said = trimmed(header.text);
    const bool says = said.size() == 5 && said.starts_with("sep=");
    if (says) {
        dialect_.separator = said.back();
        if (!read_line(header)) throw Error{name() + ": no header line with the names of the columns"};
    }
    for (Line line; ahead_.size() < rows_ahead && read_line(line);) ahead_.push_back(std::move(line));
    if (!says) dialect_.separator = separator_of(header.text, ahead_.empty() ? "" : ahead_.front().text);
    if (dialect_.separator == ',') return;
    for (const Line& line : ahead_) {
        for (const std::string& field : fields_of(line.number, line.text))
            dialect_.decimal_comma = dialect_.decimal_comma || !with_point(field).empty();
    }
}

std::vector<std::string> CsvReader::fields_of(std::size_t line, std::string_view text) const {
    try {
        return fields_between(text, dialect_.separator);
    } catch (const Error& error) {
        throw Error{where(line) + error.what()};
    }
}

void CsvReader::require_one_decimal_sign(const Line& line) {
    for (const std::string& field : fields_of(line.number, line.text)) {
        const bool comma = !with_point(field).empty();
        const bool point = !comma && field.find('.') != std::string::npos && is_number(field);
        if (point && point_line_ == 0) point_line_ = line.number;
        if (comma && comma_line_ == 0) comma_line_ = line.number;
        if ((point || comma) && point_line_ > 0 && comma_line_ > 0) {
            throw Error{where(line.number) + in_quotes(field) + ": a decimal " + (point ? "point" : "comma") +
                        ", where line " + std::to_string(point ? comma_line_ : point_line_) +
                        " has a decimal " + (point ? "comma" : "point") + ": must be one of them"};
        }
    }
}

void CsvReader::refuse_count(const CsvRow& row, std::string_view text) const {
    std::string message = where(row.line) + std::to_string(row.fields.size()) + " fields: must be " +
                          std::to_string(columns().size()) + " as in the header";
    for (const Separator& other : separators) {
        if (other.character == dialect_.separator || count_of(text, other.character) == 0) continue;
        message += std::string{", which has "} + name_of(dialect_.separator) +
                   " between fields where this line has " + other.name;
        break;
    }
    if (words(text).size() == columns().size() && columns().size() > 1)
        message += std::string{", which has "} + name_of(dialect_.separator) +
                   " between fields where this line has white space";
    if (columns().size() == 1 && words(columns().front()).size() == row.fields.size())
        message += std::string{", which has white space between names where this line has "} +
                   name_of(dialect_.separator);
    if (dialect_.separator == ',' && columns().size() > 2 && row.fields.size() > columns().size() &&
        count_of(text, '.') == 0)
        message += "; numbers with decimal commas need semicolons or tabs between fields";
    throw Error{message};
}

void CsvReader::parse(std::size_t line, std::string_view text, CsvRow& row) const {
    row.line = line;
    if (npy_) return npy_->numbers(text, row.numbers);
    if (dialect_.separator == ',' && text.find('"') == std::string_view::npos) {
        take_fields(text, row.fields);
    } else {
        row.fields = fields_of(line, text);
    }
    while (row.fields.size() > columns().size() && row.fields.back().empty()) row.fields.pop_back();
    if (row.fields.size() != columns().size()) refuse_count(row, text);
    if (dialect_.separator == ',') return;
    for (std::string& field : row.fields)
        if (std::string number = with_point(field); !number.empty()) field = std::move(number);
}

std::optional<CsvRow> CsvReader::next() {
    CsvLines one;
    take(1, one);
    if (one.empty()) return std::nullopt;
    CsvRow row;
    parse(one, 0, row);
    return row;
}

void CsvReader::take(std::size_t count, CsvLines& lines) {
    lines.clear();
    if (npy_) {
        for (std::string bytes; lines.size() < count && npy_->take(bytes); bytes_read_ += bytes.size())
            lines.add(++line_, bytes);
        return;
    }
    for (Line line; lines.size() < count && next_line(line);) {
        if (dialect_.separator != ',') require_one_decimal_sign(line);
        lines.add(line.number, line.text);
    }
}

}  // namespace hts::spectral
