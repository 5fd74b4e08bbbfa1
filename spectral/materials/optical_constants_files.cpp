#include "spectral/materials/optical_constants_files.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include "hts/error.hpp"
#include "spectral/materials/index_rows.hpp"
#include "spectral/materials/optical_constants_json.hpp"
#include "spectral/materials/optical_constants_yaml.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

struct Columns {
    std::size_t wavelength, n;
    std::optional<std::size_t> k;
    bool nanometres;
};

Columns columns_of(const CsvTable& table) {
    table.require_known_columns({"wavelength_um", "wavelength_nm", "n", "k"});
    const auto nanometres = table.find_column("wavelength_nm");
    if (nanometres && table.find_column("wavelength_um")) {
        throw Error{table.name() +
                    R"(: columns "wavelength_um" and "wavelength_nm": must be one of the two)"};
    }
    const auto wavelength = nanometres ? *nanometres : table.column("wavelength_um");
    return {wavelength, table.column("n"), table.find_column("k"), nanometres.has_value()};
}

void add_row(IndexRows& rows, const CsvTable& table, std::size_t row, const Columns& columns) {
    const double wavelength = table.number(row, columns.wavelength);
    const double um = columns.nanometres ? wavelength / 1000 : wavelength;
    const double n = table.number(row, columns.n);
    const double k = columns.k ? table.number(row, *columns.k) : 0;
    located(table.name() + ":" + std::to_string(table.line(row)), [&] {
        rows.add_n(um, n);
        rows.add_k(um, k);
    });
}

OpticalConstants material_from_csv(const CsvTable& table) {
    const Columns columns = columns_of(table);
    if (table.row_count() == 0) throw Error{table.name() + ": table without a row: must have at least one"};
    IndexRows rows;
    for (std::size_t row = 0; row < table.row_count(); ++row) add_row(rows, table, row, columns);
    return {table.name(), table.name(), rows.n().value(), rows.k()};
}

std::string lower_case(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

}  // namespace

OpticalConstants read_optical_constants(const std::filesystem::path& path) {
    const std::string file = path.string();
    const std::string text = read_text_file(path);
    const std::string ending = lower_case(path.extension().string());
    if (ending == ".yml" || ending == ".yaml") return material_from_yaml(text, file, file);
    if (ending == ".csv") return material_from_csv(CsvTable::parse(text, file));
    if (ending == ".json") return optical_constants_from_json(JsonValue::parse(text, file), file);
    throw Error{file + ": ending " + in_quotes(ending) + ": must be .yml, .yaml, .csv or .json"};
}

}  // namespace hts::spectral
