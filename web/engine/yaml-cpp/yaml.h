// As much of yaml-cpp's interface as the reader of refractiveindex.info files uses, over nodes that the page's YAML library has
// parsed: [position, line, value], value being text, a list of nodes, {"map": [[key, value], …]} or null.
#pragma once

#include <emscripten.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace YAML {

struct Mark {
    int pos = 0, line = 0;
};

struct Exception : std::runtime_error {
    Exception(const Mark& at, const std::string& what) : std::runtime_error{what}, mark{at}, msg{what} {}
    Mark mark;
    std::string msg;
};

struct NodeType {
    enum value { Undefined };
};

class Node {
  public:
    struct Item;

    Node() = default;
    explicit Node(NodeType::value) {}
    explicit Node(const nlohmann::json& node) : defined_{true}, mark_{node[0], node[1]}, value_{node[2]} {}

    explicit operator bool() const { return defined_; }
    [[nodiscard]] const YAML::Mark& Mark() const { return mark_; }
    [[nodiscard]] bool IsScalar() const { return value_.is_string(); }
    [[nodiscard]] bool IsSequence() const { return value_.is_array(); }
    [[nodiscard]] bool IsMap() const { return value_.is_object(); }
    [[nodiscard]] std::string Scalar() const { return IsScalar() ? value_.get<std::string>() : ""; }
    [[nodiscard]] Node operator[](const std::string& key) const {
        if (IsMap())
            for (const auto& pair : value_["map"])
                if (pair[0][2] == key) return Node{pair[1]};
        return {};
    }
    [[nodiscard]] auto begin() const { return items().begin(); }
    [[nodiscard]] auto end() const { return items().end(); }

  private:
    [[nodiscard]] const std::vector<Item>& items() const;

    bool defined_ = false;
    YAML::Mark mark_{};
    nlohmann::json value_{};
    mutable std::shared_ptr<std::vector<Item>> items_{};
};

/// An item of a list; of a map a key with its value.
struct Node::Item : Node {
    Item(const nlohmann::json& key, const nlohmann::json& value) : first{key}, second{value} {}
    explicit Item(const nlohmann::json& node) : Node{node} {}
    Node first{}, second{};
};

inline const std::vector<Node::Item>& Node::items() const {
    if (!items_) {
        items_ = std::make_shared<std::vector<Item>>();
        if (IsMap())
            for (const auto& pair : value_["map"]) items_->emplace_back(pair[0], pair[1]);
        if (IsSequence())
            for (const auto& node : value_) items_->emplace_back(node);
    }
    return *items_;
}

// Module.parseYaml gives {"error", "line"} or {"node"} as text.
// clang-format off
EM_JS(char*, hts_parse_yaml, (const char* yaml), {
    const text = Module["parseYaml"](UTF8ToString(yaml));
    const size = lengthBytesUTF8(text) + 1;
    const memory = _malloc(size);
    stringToUTF8(text, memory, size);
    return memory;
});
// clang-format on

inline Node Load(const std::string& text) {
    char* answer = hts_parse_yaml(text.c_str());
    const auto parsed = nlohmann::json::parse(answer);
    std::free(answer);
    if (parsed.contains("error")) throw Exception{{0, parsed["line"]}, parsed["error"]};
    return Node{parsed["node"]};
}

}  // namespace YAML
