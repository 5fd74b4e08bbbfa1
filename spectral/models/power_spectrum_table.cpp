#include "spectral/models/power_spectrum_table.hpp"

#include <cmath>
#include <functional>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

/// Adds a row.
///   wrong   hts::Error that names the row and column 0, 1 or 2
void append(PowerSpectrumTable& table, const std::vector<double>& row,
            const std::function<Error(std::size_t, const std::string&)>& wrong) {
    const double at = row[0], value = row[1];
    if (!(at > 0)) throw wrong(0, shortest(at) + " must be > 0");
    if (!table.frequency.empty() && !(at > table.frequency.back()))
        throw wrong(0, shortest(at) + " must be above " + shortest(table.frequency.back()) + " before it");
    if (!(value > 0)) throw wrong(1, shortest(value) + " must be > 0");
    table.frequency.push_back(at);
    table.density.push_back(value);
    if (row.size() < 3) return;
    if (!(row[2] >= 0)) throw wrong(2, shortest(row[2]) + " must be >= 0");
    table.error.push_back(row[2]);
}

PowerSpectrumTable from_csv(const CsvTable& table, const std::vector<std::string>& names, bool of_profile) {
    std::vector<std::size_t> columns;
    columns.reserve(names.size());
    for (const std::string& name : names) columns.push_back(table.column(name));
    PowerSpectrumTable result{{}, {}, {}, of_profile, ""};
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        std::vector<double> values;
        values.reserve(columns.size());
        for (const std::size_t column : columns) values.push_back(table.number(row, column));
        append(result, values, [&](std::size_t which, const std::string& message) {
            return table.error(row, columns[which], message);
        });
    }
    return result;
}

/// FRED's layout: two head lines, then frequency [1/mm] and power [mm^4, of a profile mm^3].
PowerSpectrumTable from_fred(const std::filesystem::path& path, bool of_profile) {
    const std::string text = read_text_file(path);
    const std::size_t first = text.find('\n'),
                      second = text.find('\n', first == std::string::npos ? first : first + 1);
    if (second == std::string::npos)
        throw Error{path.string() + ": must be two head lines and rows of two numbers"};
    // names of columns and a comment in place of the head, so that lines keep their numbers
    PowerSpectrumTable result =
        from_csv(CsvTable::parse("frequency_per_mm psd\n#" + text.substr(second), path.string()),
                 {"frequency_per_mm", "psd"}, of_profile);
    for (double& f : result.frequency) f *= 1e-3;
    for (double& s : result.density) s *= of_profile ? 1e9 : 1e12;
    return result;
}

PowerSpectrumTable from_file(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::read(path);
    table.require_known_columns({"frequency_per_um", "psd_um4", "psd_um3", "psd_um4_error", "psd_um3_error"});
    const bool of_profile = table.find_column("psd_um3").has_value();
    if (of_profile && table.find_column("psd_um4"))
        throw Error{table.where_header() + "columns psd_um3 and psd_um4: must be one of the two"};
    const std::string density = of_profile ? "psd_um3" : "psd_um4", error = density + "_error";
    const std::string other = of_profile ? "psd_um4_error" : "psd_um3_error";
    if (table.find_column(other))
        throw Error{table.where_header() + "column " + other + ": must be " + error};
    std::vector<std::string> names{"frequency_per_um", density};
    if (table.find_column(error)) names.push_back(error);
    return from_csv(table, names, of_profile);
}

PowerSpectrumTable from_rows(const JsonValue& key, bool of_profile) {
    const auto items = key.items();
    const bool with_error = !items.empty() && items.front().is_list() && items.front().items().size() == 3;
    std::vector<std::string> names{"frequency 1/um", of_profile ? "power um^3" : "power um^4"};
    if (with_error) names.emplace_back("its error");
    PowerSpectrumTable result{{}, {}, {}, of_profile, ""};
    for (const JsonValue::Row& row : key.rows(names))
        append(result, row.values, [&](std::size_t which, const std::string& message) {
            return Error{row.place + ": " + names[which] + " " + message};
        });
    return result;
}

}  // namespace

bool is_of_profile(const JsonValue& psd) {
    const std::string convention = psd.text();
    if (convention == "1d one-sided") return true;
    if (convention == "2d") return false;
    throw psd.error(in_quotes(convention) + R"( is not known; must be "1d one-sided" or "2d")");
}

PowerSpectrumTable power_spectrum_table(const JsonValue& correlation, const std::filesystem::path& folder) {
    correlation.require_keys_among({"type", "file", "table", "psd", "outside"});
    const auto psd = correlation.find("psd"), rows = correlation.find("table");
    PowerSpectrumTable result;
    if (rows) {
        if (const auto file = correlation.find("file")) throw file->error("must be left out beside a table");
        result = from_rows(*rows, is_of_profile(correlation["psd"]));
        result.place = rows->place();
        return result;
    }
    const std::filesystem::path path = folder / correlation["file"].text();
    if (!same_letters(path.extension().string(), ".csv")) {
        result = from_fred(path, is_of_profile(correlation["psd"]));
    } else {
        if (psd) throw psd->error("must be left out beside a CSV file, whose columns say it");
        result = from_file(path);
    }
    result.place = path.string();
    return result;
}

}  // namespace hts::spectral
