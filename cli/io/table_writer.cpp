#include "cli/io/table_writer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/decimal.hpp"
#include "spectral/text/npy.hpp"

namespace hts::cli {
namespace {

std::string joined(const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields)
        line.append(line.empty() ? "" : ",").append(spectral::csv_field(field));
    return line + "\n";
}

void require_unique(std::vector<std::string> names, const std::string& format) {
    std::sort(names.begin(), names.end());
    const auto twin = std::adjacent_find(names.begin(), names.end());
    if (twin != names.end()) {
        throw Error{"column " + *twin + " twice: must be there once in " + format + " (CSV can hold both)"};
    }
}

std::vector<std::string> json_keys(const std::vector<std::string>& columns) {
    require_unique(columns, "JSON");
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
    if (json || path.ends_with(".json")) return Format::json;
    return path.ends_with(".npy") ? Format::npy : Format::csv;
}

void append_number(std::string& text, double value) {
    spectral::append_17_digits(text, value);
}

std::string json_string(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

TableWriter::TableWriter(Output& output, Format format, const std::vector<std::string>& columns)
    : output_{output}, format_{format}, columns_{columns} {
    if (format == Format::npy) {
        require_unique(columns, ".npy");
        keys_.resize(columns.size());
        output_.write(spectral::npy_header(columns, 0));
        return;
    }
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
    if (table_.format_ == Format::npy) {
        append_bytes(spectral::number_in(text, table_.columns_[cell_]));
        return *this;
    }
    begin_cell();
    if (table_.format_ == Format::csv) {
        spectral::append_csv_field(text_, text);
    } else {
        text_ += is_json_number(text) ? text : json_string(text);
    }
    return *this;
}

TableWriter::Row& TableWriter::Row::word(std::string_view word) {
    if (table_.format_ == Format::npy) {
        throw Error{"column " + table_.columns_[cell_] + ": " + spectral::in_quotes(word) +
                    " is not a number: must be written to a .csv or .json file"};
    }
    begin_cell();
    const std::string_view quote = table_.format_ == Format::json ? "\"" : "";
    text_.append(quote).append(word).append(quote);
    return *this;
}

TableWriter::Row& TableWriter::Row::number(double value) {
    if (table_.format_ == Format::npy) {
        append_bytes(value);
        return *this;
    }
    begin_cell();
    if (table_.format_ == Format::json && !std::isfinite(value)) {
        text_ += "null";
    } else {
        append_number(text_, value);
    }
    return *this;
}

TableWriter::Row& TableWriter::Row::short_number(double value) {
    if (table_.format_ == Format::npy || !std::isfinite(value)) return number(value);
    begin_cell();
    text_ += shortest(value);
    return *this;
}

void TableWriter::Row::append_bytes(double value) {
    ++cell_;
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void TableWriter::Row::end() {
    if (table_.format_ == Format::npy) return;
    text_ += table_.format_ == Format::json ? "}" : "\n";
}

void TableWriter::add(std::string_view rows) {
    if (rows.empty()) return;
    if (format_ == Format::json && empty_) rows.remove_prefix(1);  // the comma before the first row
    empty_ = false;
    if (format_ == Format::npy) npy_bytes_ += rows.size();
    output_.write(rows);
}

void TableWriter::finish() {
    if (format_ == Format::npy)
        output_.write_at_start(
            spectral::npy_header(columns_, npy_bytes_ / (sizeof(double) * columns_.size())));
    if (format_ == Format::json) output_.write(empty_ ? "]\n" : "\n]\n");
}

}  // namespace hts::cli
