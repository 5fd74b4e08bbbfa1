// Whole tables, and fields as they are written.
#include <algorithm>

#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {

CsvTable CsvTable::read(const std::filesystem::path& path) {
    return parse(read_text_file(path), path.string());
}

CsvTable CsvTable::parse(std::string_view text, const std::string& name) {
    return CsvTable{CsvReader::from_text(text, name)};
}

CsvTable::CsvTable(CsvReader rows) : CsvHeader{static_cast<const CsvHeader&>(rows)} {
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

void append_csv_field(std::string& row, std::string_view text) {
    const bool plain = std::ranges::none_of(text, [](char c) { return c == ',' || c == '"'; }) &&
                       !text.starts_with('#') && trimmed(text).size() == text.size();
    if (plain) {
        row += text;
        return;
    }
    row += '"';
    for (const char character : text) row.append(character == '"' ? 2 : 1, character);
    row += '"';
}

std::string csv_field(std::string_view text) {
    std::string field;
    append_csv_field(field, text);
    return field;
}

}  // namespace hts::spectral
