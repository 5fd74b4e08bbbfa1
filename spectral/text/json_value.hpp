/// JSON that knows where it stands, so that every error names file and key.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hts/error.hpp"

namespace hts::spectral {

class JsonValue {
  public:
    /// A row of a table of numbers.
    struct Row {
        std::vector<double> values;
        std::string place;  // "path: key "table": row 2"
    };

    /// Content of a file. hts::Error "path:line: not valid JSON: …"; a key that stands twice is an error too.
    [[nodiscard]] static JsonValue read(const std::filesystem::path& path);
    ///   file   path for messages
    [[nodiscard]] static JsonValue parse(const std::string& text, std::string file);

    [[nodiscard]] bool is_object() const noexcept;
    [[nodiscard]] bool is_text() const noexcept;
    [[nodiscard]] bool is_list() const noexcept;
    [[nodiscard]] bool is_null() const noexcept;

    /// The value as what it must be; hts::Error that says what it is otherwise.
    [[nodiscard]] double number() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool boolean() const;
    /// The elements of a list, which know their places: "path: key "materials[2]"".
    [[nodiscard]] std::vector<JsonValue> items() const;
    /// A list of at least one list of as many numbers as there are column names.
    [[nodiscard]] std::vector<Row> rows(const std::vector<std::string>& columns) const;

    /// hts::Error if this is no object or has keys that are not listed.
    void require_keys_among(const std::vector<std::string>& known) const;
    /// The same object less some of its members.
    [[nodiscard]] JsonValue without(const std::vector<std::string>& keys) const;
    /// Member of an object, none if it is not there.
    [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const;
    /// Member of an object, hts::Error if it is not there.
    [[nodiscard]] JsonValue operator[](std::string_view key) const;

    /// "path: key "index.n"", or "path" for the whole file.
    [[nodiscard]] std::string place() const;
    /// hts::Error "path: key "index.n": message".
    [[nodiscard]] Error error(std::string_view message) const;

  private:
    JsonValue(std::shared_ptr<const void> value, std::string file, std::string key);
    void require_object() const;
    [[nodiscard]] JsonValue member(std::string_view key, const void* value) const;

    std::shared_ptr<const void> value_;  // a JSON value, which shares ownership of the whole document
    std::string file_;
    std::string key_;
};

}  // namespace hts::spectral
