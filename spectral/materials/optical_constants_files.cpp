#include "spectral/materials/optical_constants_files.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hts/error.hpp"
#include "spectral/materials/index_rows.hpp"
#include "spectral/materials/optical_constants_json.hpp"
#include "spectral/materials/optical_constants_yaml.hpp"
#include "spectral/text/csv.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

struct Columns {
    WavelengthColumn wavelength;
    std::size_t n;
    std::optional<std::size_t> k;
};

Columns columns_of(const CsvTable& table) {
    if (const auto website = table.find_column("wl")) {
        table.require_known_columns({"wl", "n", "k"});
        return {{*website, false}, table.column("n"), table.find_column("k")};
    }
    table.require_known_columns({"wavelength_um", "wavelength_nm", "n", "k"});
    return {table.wavelength(), table.column("n"), table.find_column("k")};
}

void add_row(IndexRows& rows, const CsvTable& table, std::size_t row, const Columns& columns) {
    const double um = columns.wavelength.micrometres(table.number(row, columns.wavelength.place));
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
    return {table.name(), table.name(), rows.n().value(), rows.k(), rows.notes(table.name())};
}

// One of the two tables that the website writes below each other; lines of the other stand
// empty, so that lines count on.
std::string website_part(std::string_view text, char quantity) {
    std::string result;
    char part = 0;
    for (const std::string_view line : split(text, '\n')) {
        const std::string bare{trimmed(line)};
        if (bare.size() == 4 && bare.starts_with("wl")) part = bare[3];
        if (part == quantity || part == 0) result.append(line);
        result += '\n';
    }
    return result;
}

void add_website_rows(IndexRows& rows, std::string_view text, const std::string& file, char quantity) {
    const auto table = CsvTable::parse(website_part(text, quantity), file);
    const std::size_t wavelength = table.column("wl"), value = table.column(std::string(1, quantity));
    for (std::size_t row = 0; row < table.row_count(); ++row) {
        const double um = table.number(row, wavelength), number = table.number(row, value);
        located(file + ":" + std::to_string(table.line(row)),
                [&] { quantity == 'n' ? rows.add_n(um, number) : rows.add_k(um, number); });
    }
}

bool has_line(std::string_view text, std::string_view start, char quantity) {
    return std::ranges::any_of(split(text, '\n'), [&](std::string_view line) {
        const auto bare = trimmed(line);
        return bare.size() == 4 && bare.starts_with(start) && bare[3] == quantity;
    });
}

// The database's website: "wl,n" and rows, then perhaps "wl,k" and rows; its .txt has tabs.
OpticalConstants material_from_website(std::string_view text, const std::string& file) {
    IndexRows rows;
    add_website_rows(rows, text, file, 'n');
    if (!rows.n()) throw Error{file + ": table without a row: must have at least one"};
    if (has_line(text, "wl", 'k')) add_website_rows(rows, text, file, 'k');
    return {file, file, rows.n().value(), rows.k(), rows.notes(file)};
}

// A line and its numbers, which white space, commas or brackets part.
struct NumberedLine {
    std::size_t number;
    std::vector<double> values;
};

std::vector<NumberedLine> lines_of_numbers(std::string_view text, const std::string& file) {
    std::vector<NumberedLine> result;
    std::size_t number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        std::string bare{trimmed(line.substr(0, line.find('#')))};
        std::ranges::replace_if(
            bare, [](char c) { return c == '(' || c == ')' || c == ',' || c == ';'; }, ' ');
        if (words(bare).empty()) continue;
        NumberedLine numbers{number, {}};
        located(file + ":" + std::to_string(number), [&] {
            for (const auto word : words(bare)) numbers.values.push_back(number_in(word));
        });
        result.push_back(std::move(numbers));
    }
    return result;
}

// Rows without a header.
OpticalConstants material_from_rows(std::string_view text, const std::string& file) {
    constexpr double longest_um = 100;  // nanometres are larger
    IndexRows rows;
    std::size_t columns = 0;
    for (const auto& [line, values] : lines_of_numbers(text, file)) {
        if (columns == 0) columns = values.size();
        located(file + ":" + std::to_string(line), [&, &values = values] {
            if (values.size() != columns || columns < 2 || columns > 3) {
                throw Error{std::to_string(values.size()) + " numbers: must be " +
                            (columns == 2 || columns == 3 ? std::to_string(columns) + " as above"
                                                          : "2 or 3, wavelength in um, n and k")};
            }
            if (values[0] > longest_um) {
                throw out_of_range("wavelength without a unit", values[0], "",
                                   "at most 100 um; a header \"wavelength_nm n k\" says that they are nm");
            }
            rows.add_n(values[0], values[1]);
            if (columns == 3) rows.add_k(values[0], values[2]);
        });
    }
    if (!rows.n()) throw Error{file + ": table without a row: must have at least one"};
    return {file, file, rows.n().value(), rows.k(), rows.notes(file)};
}

bool begins_with_number(std::string_view text) {
    for (const std::string_view line : split(text, '\n')) {
        const auto bare = trimmed(line);
        if (bare.empty() || bare.front() == '#') continue;
        return (bare.front() >= '0' && bare.front() <= '9') || bare.front() == '.' || bare.front() == '+';
    }
    return false;
}

OpticalConstants material_from_table(std::string_view text, const std::string& file, bool may_lack_header) {
    if (has_line(text, "wl", 'n')) return material_from_website(text, file);
    if (may_lack_header && begins_with_number(text)) return material_from_rows(text, file);
    return material_from_csv(CsvTable::parse(text, file));
}

std::vector<PiecewiseLinear::Point> spd_points(std::string_view text, const std::string& file) {
    std::vector<PiecewiseLinear::Point> points;
    std::vector<double> numbers;
    for (const auto& [line, values] : lines_of_numbers(text, file)) {
        for (const double value : values) {
            numbers.push_back(value);
            if (numbers.size() % 2 != 0) continue;
            const double um = numbers[numbers.size() - 2] / 1000;
            if (!points.empty() && !(um > points.back().um)) {
                throw Error{file + ":" + std::to_string(line) + ": " +
                            out_of_range("wavelength", 1000 * um, "nm", "> the one before it").what()};
            }
            points.push_back({um, value});
        }
    }
    if (numbers.size() % 2 != 0)
        throw Error{file + ": a wavelength without a value at the end: must be pairs"};
    if (points.empty()) throw Error{file + ": table without a row: must have at least one"};
    return points;
}

// Au.eta.spd -> Au.k.spd, metal-Au-eta.spd -> metal-Au-k.spd; none for other names.
std::optional<std::filesystem::path> k_beside(const std::filesystem::path& path) {
    const std::string stem = path.stem().string();
    for (const char* end : {".eta", "-eta", "_eta", ".n", "-n", "_n"}) {
        const std::string_view ending{end};
        if (!stem.ends_with(ending)) continue;
        const std::string other =
            stem.substr(0, stem.size() - ending.size() + 1) + "k" + path.extension().string();
        return path.parent_path() / other;
    }
    return std::nullopt;
}

OpticalConstants material_from_spd(std::string_view text, const std::filesystem::path& path) {
    const std::string file = path.string();
    if (const std::string stem = path.stem().string();
        stem.ends_with(".k") || stem.ends_with("-k") || stem.ends_with("_k"))
        throw Error{file +
                    ": holds k alone, by its name: must be the file of n (eta), beside which k is found"};
    IndexRows rows;
    const auto n = spd_points(text, file);
    located(file, [&] {
        for (const auto& point : n) rows.add_n(point.um, point.value);
    });
    const auto other = k_beside(path);
    if (!other || !std::filesystem::exists(*other)) {
        return {file,
                file,
                rows.n().value(),
                std::nullopt,
                {file + ": holds n alone" + (other ? ", and there is no " + other->string() : "") +
                 ": k is taken as 0"}};
    }
    const auto k = spd_points(read_text_file(*other), other->string());
    located(other->string(), [&] {
        for (const auto& point : k) rows.add_k(point.um, point.value);
    });
    return {file, file, rows.n().value(), rows.k()};
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
    if (ending == ".csv") return material_from_table(text, file, false);
    if (ending == ".txt" || ending == ".tsv") return material_from_table(text, file, true);
    if (ending == ".spd") return material_from_spd(text, path);
    if (ending == ".json") return optical_constants_from_json(JsonValue::parse(text, file), file);
    throw Error{file + ": ending " + in_quotes(ending) + ": must be .yml, .yaml, .csv, .txt, .spd or .json"};
}

}  // namespace hts::spectral
