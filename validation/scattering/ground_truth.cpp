#include "validation/scattering/ground_truth.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"
#include "validation/scattering/ground_truth_data.hpp"

namespace hts::validation {
namespace {

std::string in_digits(const char* format, int digits, double value) {
    std::array<char, 64> text{};
    const int length = std::snprintf(text.data(), text.size(), format, digits, value);
    return {text.data(), static_cast<std::size_t>(length)};
}

std::string_view kept_text(std::string_view stem) {
    if (const auto* file = spectral::find_embedded(kept_files(), stem)) return file->text;
    throw Error{std::string{"ground truth "}.append(stem) + ": no such table is kept"};
}

}  // namespace

std::string table_csv(const FigureTable& table, const std::string& provenance) {
    std::string text;
    for (const std::string_view line : spectral::split(provenance, '\n'))
        text.append("# ").append(line) += '\n';
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        text.append(i == 0 ? "" : ",").append(table.columns[i]);
    for (const auto& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            text.append(i == 0 ? "\n" : ",").append(in_digits("%.*g", 5, row[i]));
    }
    return text + '\n';
}

FigureTable kept_table(std::string_view stem) {
    const auto csv = spectral::CsvTable::parse(kept_text(stem), std::string{stem} + ".csv");
    FigureTable table{std::string{stem}, csv.columns(), {}};
    for (std::size_t row = 0; row < csv.row_count(); ++row) {
        table.rows.emplace_back();
        for (std::size_t column = 0; column < csv.columns().size(); ++column)
            table.rows.back().push_back(csv.number(row, column));
    }
    return table;
}

std::string kept_provenance(std::string_view stem) {
    std::string text;
    for (const std::string_view line : spectral::split(kept_text(stem), '\n')) {
        if (!line.starts_with("# ")) break;
        text.append(text.empty() ? "" : "\n").append(line.substr(2));
    }
    return text;
}

std::string regenerating(const std::string& study, Effort effort) {
    return "\nhts truth " + study + (effort == Effort::quick ? " --quick" : "") + " --output FOLDER";
}

GroundTruth ground_truth(std::string provenance, std::vector<FigureTable> tables, Section empty,
                         AddResults add_results) {
    GroundTruth truth{std::move(provenance), std::move(tables), std::move(empty)};
    add_results(truth.section, truth.tables, truth.provenance);
    return truth;
}

Section section_of(GroundTruth computed, Effort effort, AddResults add_results) {
    Section section = std::move(computed.section);
    if (effort == Effort::full) return section;
    mark_as_quick(section.checks);
    section.figures.clear();
    std::vector<FigureTable> kept;
    for (const FigureTable& table : computed.tables) kept.push_back(kept_table(table.stem));
    const std::string provenance = kept_provenance(kept[0].stem);
    section.text +=
        "\n\nThe full result, kept: " + provenance + "\n\nComputed for this report: " + computed.provenance;
    add_results(section, kept, provenance);
    return section;
}

std::size_t column_of(const FigureTable& table, std::string_view name) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    if (found == table.columns.end()) throw Error{table.stem + ": column " + std::string{name} + " missing"};
    return static_cast<std::size_t>(found - table.columns.begin());
}

std::vector<double> different(const FigureTable& table, std::size_t column) {
    std::vector<double> values;
    for (const auto& row : table.rows) {
        if (std::find(values.begin(), values.end(), row[column]) == values.end())
            values.push_back(row[column]);
    }
    return values;
}

std::string rounded(double value, int digits) {
    return in_digits("%.*f", digits, value);
}

}  // namespace hts::validation
