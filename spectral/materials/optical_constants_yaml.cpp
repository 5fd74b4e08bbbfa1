#include "spectral/materials/optical_constants_yaml.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "hts/error.hpp"
#include "spectral/materials/index_rows.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

// What a reader of an item of DATA needs to know of the file.
struct Source {
    const std::string& text;
    const std::string& file;

    [[nodiscard]] std::string place(int line) const { return file + ":" + std::to_string(line); }
    [[nodiscard]] std::string place(const YAML::Node& node) const { return place(node.Mark().line + 1); }
};

struct Curves {
    std::optional<Dispersion> n, k;
    std::vector<std::string> notes{};
};

YAML::Node parsed(const Source& source) {
    try {
        return YAML::Load(source.text);
    } catch (const YAML::Exception& error) {
        throw Error{source.place(error.mark.line + 1) + ": not valid YAML: " + error.msg};
    }
}

std::string scalar(const Source& source, const YAML::Node& item, const std::string& key) {
    const YAML::Node value = item[key];
    if (!value) throw Error{source.place(item) + ": key " + in_quotes(key) + ": missing"};
    if (!value.IsScalar())
        throw Error{source.place(value) + ": key " + in_quotes(key) + ": must be text or numbers"};
    return value.Scalar();
}

std::vector<double> numbers(std::string_view text) {
    std::vector<double> values;
    for (const auto word : words(text)) values.push_back(number_in(word));
    return values;
}

std::vector<double> numbers_of(const Source& source, const YAML::Node& item, const std::string& key) {
    const std::string text = scalar(source, item, key);
    return located(source.place(item[key]) + ": key " + in_quotes(key), [&] { return numbers(text); });
}

// First line of a scalar's text; that of a block scalar begins below its `|`.
int first_line(const Source& source, const YAML::Node& value) {
    const auto position = static_cast<std::size_t>(value.Mark().pos);
    const bool block =
        position < source.text.size() && (source.text[position] == '|' || source.text[position] == '>');
    return value.Mark().line + (block ? 2 : 1);
}

void add_row(IndexRows& rows, std::string_view quantities, std::string_view line, const std::string& place) {
    const auto row = numbers(line);
    if (row.empty()) return;
    if (row.size() != 1 + quantities.size()) {
        throw Error{std::to_string(row.size()) + " numbers in a row of a table of " +
                    std::string{quantities} + ": must be " + std::to_string(1 + quantities.size())};
    }
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        rows.add_if_physical(quantities[i], row[0], row[i + 1], place);
    }
}

//   quantities   "nk", "n" or "k": what stands behind the wavelength in a row
Curves tabulated(const Source& source, const YAML::Node& item, std::string_view quantities) {
    const std::string table = scalar(source, item, "data");
    int line_number = first_line(source, item["data"]);
    IndexRows rows;
    for (const auto line : split(table, '\n')) {
        const std::string place = source.place(line_number);
        located(place, [&] { add_row(rows, quantities, line, place); });
        ++line_number;
    }
    if (!rows.n() && !rows.k())
        throw Error{source.place(item) + ": table without a row: must have at least one"};
    rows.require_physical();
    return {rows.n(), rows.k(), rows.notes(source.place(item))};
}

int formula_number(std::string_view type) {
    const auto digits = type.substr(std::string_view{"formula "}.size());
    int number = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure != std::errc{} || end != digits.data() + digits.size()) {
        throw Error{in_quotes(type) + ": must be formula 1 to formula 9"};
    }
    return number;
}

Curves formula(const Source& source, const YAML::Node& item, std::string_view type) {
    // Files written before 2018 say "range".
    const std::string range_key = item["range"] ? "range" : "wavelength_range";
    const auto range = numbers_of(source, item, range_key);
    if (range.size() != 2) {
        throw Error{source.place(item[range_key]) + ": key " + in_quotes(range_key) +
                    ": must be two wavelengths"};
    }
    auto coefficients = numbers_of(source, item, "coefficients");
    return located(source.place(item), [&]() -> Curves {
        const WavelengthRange both{range[0], range[1]};
        return {DispersionFormula{formula_number(type), std::move(coefficients), both}, std::nullopt, {}};
    });
}

// YAML takes one of two keys that are the same, and does not say which.
void require_unique_keys(const Source& source, const YAML::Node& map) {
    std::set<std::string> keys;
    for (const auto& pair : map) {
        if (!pair.first.IsScalar() || keys.insert(pair.first.Scalar()).second) continue;
        throw Error{source.place(pair.first) + ": key " + in_quotes(pair.first.Scalar()) + ": stands twice"};
    }
}

Curves curves_of(const Source& source, const YAML::Node& item) {
    if (!item.IsMap()) throw Error{source.place(item) + ": item of DATA: must be a mapping with a type"};
    require_unique_keys(source, item);
    const std::string type = scalar(source, item, "type");
    if (type.starts_with("formula ")) return formula(source, item, type);
    if (type == "tabulated nk") return tabulated(source, item, "nk");
    if (type == "tabulated n") return tabulated(source, item, "n");
    if (type == "tabulated k") return tabulated(source, item, "k");
    if (type == "tabulated n2") return {};  // the index of intense light, which nobody asks for here
    throw Error{source.place(item["type"]) + ": type " + in_quotes(type) +
                ": not known; must be formula 1 to formula 9, tabulated nk, tabulated n, tabulated k or "
                "tabulated n2"};
}

// n from the first item that gives n, k from the first that gives k.
Curves all_curves(const Source& source, const YAML::Node& data) {
    Curves result;
    std::vector<std::string> again;
    for (const auto& item : data) {
        Curves curves = curves_of(source, item);
        for (const auto& [curve, earlier, name] :
             {std::tuple{&curves.n, &result.n, "n"}, std::tuple{&curves.k, &result.k, "k"}})
            if (*curve && *earlier)
                again.push_back(source.place(item) + ": " + name +
                                " stands in an item before: that one counts");
        if (!result.n) result.n = std::move(curves.n);
        if (!result.k) result.k = std::move(curves.k);
        result.notes.insert(result.notes.end(), curves.notes.begin(), curves.notes.end());
    }
    result.notes.insert(result.notes.end(), again.begin(), again.end());
    return result;
}

YAML::Node data_of(const Source& source, const YAML::Node& root) {
    if (root.IsMap()) require_unique_keys(source, root);
    const YAML::Node data = root.IsMap() ? root["DATA"] : YAML::Node{YAML::NodeType::Undefined};
    if (!data) throw Error{source.file + ": key \"DATA\": missing; must be a file of refractiveindex.info"};
    if (!data.IsSequence()) throw Error{source.place(data) + ": key \"DATA\": must be a list"};
    return data;
}

std::string references(const Source& source, const YAML::Node& root) {
    const YAML::Node text = root["REFERENCES"];
    return text && text.IsScalar() ? plain_line(text.Scalar()) : source.file;
}

bool is_tag(std::string_view text) noexcept {
    if (text.size() < 2) return false;
    const char next = text[1];
    return next == '/' || (next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z');
}

std::string without_tags(std::string_view html) {
    std::string text;
    while (!html.empty()) {
        const auto end = html.find('>');
        if (html.front() == '<' && is_tag(html) && end != std::string_view::npos) {
            if (html.starts_with("<br")) text += ' ';
            html.remove_prefix(end + 1);
        } else {
            text += html.front();
            html.remove_prefix(1);
        }
    }
    return text;
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
        text.replace(at, what.size(), by);
    }
}

}  // namespace

std::string plain_line(std::string_view html) {
    using Entity = std::pair<std::string_view, std::string_view>;
    static constexpr std::array entities{Entity{"&nbsp;", " "},       Entity{"&ndash;", "\u2013"},
                                         Entity{"&mdash;", "\u2014"}, Entity{"&quot;", "\""},
                                         Entity{"&#39;", "'"},        Entity{"&lt;", "<"},
                                         Entity{"&gt;", ">"},         Entity{"&amp;", "&"}};
    std::string text = without_tags(html);
    for (const auto& [entity, character] : entities) replace_all(text, entity, character);
    std::string line;
    for (const auto word : words(text)) line.append(line.empty() ? "" : " ").append(word);
    return line;
}

OpticalConstants material_from_yaml(const std::string& text, std::string name, const std::string& file) {
    const Source source{text, file};
    const YAML::Node root = parsed(source);
    Curves curves = all_curves(source, data_of(source, root));
    if (!curves.n)
        throw Error{file + ": key \"DATA\": no refractive index n: must have a formula or a table"};
    return located(file, [&] {
        return OpticalConstants{std::move(name), references(source, root), std::move(*curves.n),
                                std::move(curves.k), std::move(curves.notes)};
    });
}

}  // namespace hts::spectral
