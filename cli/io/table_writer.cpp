#include "cli/io/table_writer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"

namespace hts::cli {
namespace {

std::string joined(const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields)
        line.append(line.empty() ? "" : ",").append(spectral::csv_field(field));
    return line + "\n";
}

void require_unique(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    const auto twin = std::adjacent_find(names.begin(), names.end());
    if (twin != names.end()) {
        throw Error{"column " + *twin + " twice: must be there once in JSON (CSV can hold both)"};
    }
}

std::vector<std::string> json_keys(const std::vector<std::string>& columns) {
    require_unique(columns);
    std::vector<std::string> keys;
    keys.reserve(columns.size());
    for (const std::string& name : columns)
        keys.push_back((keys.empty() ? "" : ", ") + json_string(name) + ": ");
    return keys;
}

bool is_json_number(const std::string& text) {
    if (text.empty() || (text[0] != '-' && (text[0] < '0' || text[0] > '9'))) return false;
    return nlohmann::json::accept(text);
}

}  // namespace

Format format_of(std::string_view path, bool json) {
    return json || path.ends_with(".json") ? Format::json : Format::csv;
}

void append_number(std::string& text, double value) {
    text += brief(value, 17);
}

std::string json_string(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

TableWriter::TableWriter(Output& output, Format format, const std::vector<std::string>& columns)
    : output_{output}, format_{format} {
    if (format == Format::json) {
        keys_ = json_keys(columns);
        output_.write("[");
        return;
    }
    output_.write(joined(columns));
    keys_.assign(columns.size(), ",");
    keys_.front().clear();
}

TableWriter::Row::Row(const TableWriter& table, std::string& text) : table_{table}, text_{text} {
    if (table_.format_ == Format::json) text_ += ",\n  {";
}

void TableWriter::Row::begin_cell() {
    text_ += table_.keys_[cell_++];
}

TableWriter::Row& TableWriter::Row::field(const std::string& text) {
    begin_cell();
    if (table_.format_ == Format::csv) {
        text_ += spectral::csv_field(text);
    } else {
        text_ += is_json_number(text) ? text : json_string(text);
    }
    return *this;
}

TableWriter::Row& TableWriter::Row::word(std::string_view word) {
    begin_cell();
    const std::string_view quote = table_.format_ == Format::json ? "\"" : "";
    text_.append(quote).append(word).append(quote);
    return *this;
}

TableWriter::Row& TableWriter::Row::number(double value) {
    begin_cell();
    if (table_.format_ == Format::json && !std::isfinite(value)) {
        text_ += "null";
    } else {
        append_number(text_, value);
    }
    return *this;
}

void TableWriter::Row::end() {
    text_ += table_.format_ == Format::json ? "}" : "\n";
}

void TableWriter::add(std::string_view rows) {
    if (rows.empty()) return;
    if (format_ == Format::json && empty_) rows.remove_prefix(1);  // the comma before the first row
    empty_ = false;
    output_.write(rows);
}

void TableWriter::finish() {
    if (format_ == Format::json) output_.write(empty_ ? "]\n" : "\n]\n");
}

}  // namespace hts::cli
