/// The numbers behind the charts, for spreadsheets and scripts.
#pragma once

#include <string>
#include <vector>

#include "bench/charts/chart.hpp"

namespace hts::bench {

/// A table with the machine and the settings it was made with.
class ChartTable {
  public:
    ChartTable(const ChartData& data, std::string what, std::vector<std::string> columns);

    /// A cell is a number where it reads as one; "inf" and "nan" are null in JSON.
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

    /// Comment lines with #, a header, the rows.
    [[nodiscard]] std::string csv() const;
    /// {"what", "machine", …, "rows": [{column: cell, …}, …]}
    [[nodiscard]] std::string json() const;

  private:
    std::string what_;
    std::vector<std::pair<std::string, std::string>> facts_;
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Errors and time of each method in each regime.
[[nodiscard]] ChartTable accuracy_table(const ChartData& data);
/// Error of each method in each cell of the plane.
[[nodiscard]] ChartTable map_table(const ChartData& data);
/// Time of each method at each g.
[[nodiscard]] ChartTable cost_table(const ChartData& data);

}  // namespace hts::bench
