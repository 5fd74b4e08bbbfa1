#include "bench/charts/chart_tables.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace hts::bench {
namespace {

std::string text(double value) {
    std::array<char, 32> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6);
    return {buffer.data(), end.ptr};
}

std::string text(std::size_t value) {
    return std::to_string(value);
}

nlohmann::ordered_json json_cell(const std::string& cell) {
    if (cell == "inf" || cell == "nan" || cell == "-nan") return nullptr;
    double value = 0;
    const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (end.ec != std::errc{} || end.ptr != cell.data() + cell.size()) return cell;
    return value;
}

std::string joined(const std::vector<std::string>& cells) {
    std::string line;
    for (const std::string& cell : cells)
        line.append(&cell == &cells.front() ? "" : ",").append(spectral::csv_field(cell));
    return line.append("\n");
}

}  // namespace

ChartTable::ChartTable(const ChartData& data, std::string what, std::vector<std::string> columns)
    : what_{std::move(what)},
      facts_{{"processor", data.machine.processor},
             {"compiler", data.machine.compiler},
             {"flags", data.machine.flags},
             {"commit", data.machine.commit},
             {"seed", std::to_string(data.settings.seed)}},
      columns_{std::move(columns)} {}

std::string ChartTable::csv() const {
    std::string result;
    result.append("# ").append(what_).append("\n");
    for (const auto& [name, value] : facts_) {
        result.append("# ").append(name).append(": ").append(value).append("\n");
    }
    result += joined(columns_);
    for (const auto& row : rows_) result += joined(row);
    return result;
}

std::string ChartTable::json() const {
    nlohmann::ordered_json document{{"what", what_}};
    for (const auto& [name, value] : facts_) document[name] = value;
    auto& rows = document["rows"] = nlohmann::ordered_json::array();
    for (const auto& row : rows_) {
        nlohmann::ordered_json object;
        for (std::size_t i = 0; i < columns_.size(); ++i) object[columns_[i]] = json_cell(row[i]);
        rows.push_back(std::move(object));
    }
    return document.dump(1) + '\n';
}

ChartTable accuracy_table(const ChartData& data) {
    ChartTable table{data,
                     "relative errors of Phi(g, t) against 50 digits, and time per value on one core",
                     {"regime", "method", "setting", "ours", "batch", "table_bytes", "nanoseconds", "points",
                      "failures", "worst_error", "error_99_9_percent", "energy_weighted_error", "worst_at_g",
                      "worst_at_t", "promised_error"}};
    for (const AccuracyPoint& point : data.accuracy) {
        const ChartMethod& method = *point.method;
        const ErrorSummary& errors = point.errors;
        table.add({key(point.regime), method.name, method.setting, method.ours ? "yes" : "no",
                   method.batch ? "yes" : "no", text(method.bytes), text(point.nanoseconds),
                   text(errors.points), text(errors.failures), text(errors.worst), text(errors.quantile),
                   text(errors.energy), text(errors.worst_g), text(errors.worst_t),
                   method.ours ? text(method.error) : "nan"});
    }
    return table;
}

ChartTable map_table(const ChartData& data) {
    ChartTable table{
        data,
        "relative error of Phi(g, t) at the middle of each cell; inf: no value; nan: Phi below 1e-300",
        {"method", "setting", "g", "t_over_g", "error"}};
    const PlaneGrid& grid = data.settings.grid;
    for (const ErrorMap& map : data.maps) {
        for (std::size_t i = 0; i < map.errors.size(); ++i) {
            table.add({map.method->name, map.method->setting, text(grid.g(i % grid.columns)),
                       text(grid.ratio(i / grid.columns)), text(map.errors[i])});
        }
    }
    return table;
}

ChartTable cost_table(const ChartData& data) {
    ChartTable table{data,
                     "time per value of Phi(g, t) on one core, t/g uniform in 0 ... 10",
                     {"method", "setting", "ours", "batch", "g", "nanoseconds", "fails"}};
    for (const CostPoint& point : data.cost) {
        const ChartMethod& method = *point.method;
        table.add({method.name, method.setting, method.ours ? "yes" : "no", method.batch ? "yes" : "no",
                   text(point.g), text(point.nanoseconds), point.fails ? "yes" : "no"});
    }
    return table;
}

}  // namespace hts::bench
