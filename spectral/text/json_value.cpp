#include "spectral/text/json_value.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "spectral/text/suggestion.hpp"
#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

using nlohmann::json;

// Watches the parser for a key that stands twice in an object, of which it would keep the last.
class DuplicateKeys {
  public:
    bool operator()(int, json::parse_event_t event, const json& parsed) {
        if (event == json::parse_event_t::object_start) open_.emplace_back();
        if (event == json::parse_event_t::object_end) open_.pop_back();
        if (event == json::parse_event_t::key) note(parsed.get<std::string>());
        return true;
    }

  private:
    void note(const std::string& key) {
        if (!open_.back().insert(key).second) throw Error{"key " + in_quotes(key) + ": stands twice"};
    }
    std::vector<std::set<std::string>> open_;
};

// "[json.exception.parse_error.101] parse error at line 3, column 1: syntax error …" from "syntax error" on.
std::string reason(const json::exception& error) {
    const std::string text = error.what();
    const auto syntax = text.find("syntax error");
    return text.substr(syntax != std::string::npos ? syntax : std::min(text.find("] ") + 2, text.size()));
}

// The line of a byte counted from 1; the last line with text if the byte is beyond it.
std::string line_of(const std::string& text, std::size_t byte) {
    const std::string_view content = trimmed(text);
    if (content.empty()) return "1";
    const std::size_t end = std::min(byte, content.size() + text.find(content.front()));
    return std::to_string(1 +
                          std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
}

std::string with_article(const json& value) {
    std::string type = value.type_name();
    if (type == "null") return type;
    return (type == "object" || type == "array" ? "an " : "a ") + type;
}

JsonValue::Row row_of(const json& value, const std::vector<std::string>& columns, const std::string& place) {
    const bool numbers = value.is_array() &&
                         std::all_of(value.begin(), value.end(), [](const json& x) { return x.is_number(); });
    if (!numbers || value.size() != columns.size()) {
        throw Error{place + ": must be " + std::to_string(columns.size()) + " numbers, [" + joined(columns) +
                    "]"};
    }
    return {value.get<std::vector<double>>(), place};
}

const json& value_of(const std::shared_ptr<const void>& value) {
    return *static_cast<const json*>(value.get());
}

}  // namespace

JsonValue::JsonValue(std::shared_ptr<const void> value, std::string file, std::string key)
    : value_{std::move(value)}, file_{std::move(file)}, key_{std::move(key)} {}

JsonValue JsonValue::read(const std::filesystem::path& path) {
    return parse(read_text_file(path), path.string());
}

JsonValue JsonValue::parse(const std::string& text, std::string file) {
    try {
        auto document = located(file, [&] { return json::parse(text, DuplicateKeys{}); });
        return {std::make_shared<const json>(std::move(document)), std::move(file), ""};
    } catch (const json::parse_error& error) {
        throw Error{file + ":" + line_of(text, error.byte) + ": not valid JSON: " + reason(error)};
    } catch (const json::exception& error) {
        throw Error{file + ": not valid JSON: " + reason(error)};
    }
}

bool JsonValue::is_object() const noexcept {
    return value_of(value_).is_object();
}

bool JsonValue::is_text() const noexcept {
    return value_of(value_).is_string();
}

bool JsonValue::is_list() const noexcept {
    return value_of(value_).is_array();
}

bool JsonValue::is_null() const noexcept {
    return value_of(value_).is_null();
}

double JsonValue::number() const {
    if (!value_of(value_).is_number()) throw error("must be a number, not " + with_article(value_of(value_)));
    return value_of(value_).get<double>();
}

std::string JsonValue::text() const {
    if (!is_text()) throw error("must be a string, not " + with_article(value_of(value_)));
    return value_of(value_).get<std::string>();
}

bool JsonValue::boolean() const {
    if (!value_of(value_).is_boolean())
        throw error("must be true or false, not " + with_article(value_of(value_)));
    return value_of(value_).get<bool>();
}

std::vector<JsonValue> JsonValue::items() const {
    if (!is_list()) throw error("must be an array, not " + with_article(value_of(value_)));
    std::vector<JsonValue> result;
    for (const json& item : value_of(value_)) {
        result.push_back({{value_, &item}, file_, key_ + "[" + std::to_string(result.size() + 1) + "]"});
    }
    return result;
}

std::vector<JsonValue::Row> JsonValue::rows(const std::vector<std::string>& columns) const {
    if (!is_list()) {
        throw error("must be an array of rows [" + joined(columns) + "], not " +
                    with_article(value_of(value_)));
    }
    if (value_of(value_).empty()) throw error("must have at least one row [" + joined(columns) + "]");
    std::vector<Row> result;
    for (const json& row : value_of(value_)) {
        result.push_back(row_of(row, columns, place() + ": row " + std::to_string(result.size() + 1)));
    }
    return result;
}

void JsonValue::require_keys_among(const std::vector<std::string>& known) const {
    require_object();
    for (const auto& item : value_of(value_).items()) {
        if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
        throw member(item.key(), &item.value()).error("not known; " + must_be_one_of(item.key(), known));
    }
}

JsonValue JsonValue::without(const std::vector<std::string>& keys) const {
    require_object();
    const auto there = [&](const std::string& key) { return value_of(value_).contains(key); };
    if (std::none_of(keys.begin(), keys.end(), there)) return *this;
    json rest = value_of(value_);
    for (const std::string& key : keys) rest.erase(key);
    return {std::make_shared<const json>(std::move(rest)), file_, key_};
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
    require_object();
    const auto found = value_of(value_).find(std::string{key});
    if (found == value_of(value_).end()) return std::nullopt;
    return member(key, &*found);
}

JsonValue JsonValue::operator[](std::string_view key) const {
    auto found = find(key);
    if (!found) throw member(key, value_.get()).error("missing");
    return std::move(*found);
}

std::string JsonValue::place() const {
    return key_.empty() ? file_ : file_ + ": key " + in_quotes(key_);
}

Error JsonValue::error(std::string_view message) const {
    return Error{place() + ": " + std::string{message}};
}

void JsonValue::require_object() const {
    if (!is_object()) throw error("must be an object, not " + with_article(value_of(value_)));
}

JsonValue JsonValue::member(std::string_view key, const void* value) const {
    return {{value_, value}, file_, (key_.empty() ? "" : key_ + ".") + std::string{key}};
}

}  // namespace hts::spectral
