#include "tables/formats/glsl/wgsl.hpp"

#include <regex>
#include <sstream>
#include <string>

namespace hts::tables {
namespace {

std::string replaced(const std::string& text, const char* pattern, const char* by) {
    return std::regex_replace(text, std::regex{pattern}, by);
}

// Without its comment.
std::string translated(std::string code, bool in_struct) {
    code = replaced(code, R"(\bvec3\b)", "vec3<f32>");
    code = replaced(code, R"(\bfloat\b)", "f32");
    code = replaced(code, R"(\bint\b)", "i32");
    if (in_struct) return replaced(code, R"(^(\s+)(\S+) (\w+);)", "$1$3 : $2,");
    std::smatch head;
    if (std::regex_match(code, head, std::regex{R"((\S+) (hts_\w+)\((.*)\) \{)"})) {
        const std::string parameters = replaced(head[3].str(), R"(([^\s,]+) (\w+))", "$2 : $1");
        return "fn " + head[2].str() + "(" + parameters + ") -> " + head[1].str() + " {";
    }
    code = replaced(code, R"(^const (\S+) (\w+)\[(\d+)\] = \S+\[\d+\]\()", "const $2 = array<$1, $3>(");
    code = replaced(code, R"(^const (\S+) (\w+) = )", "const $2 : $1 = ");
    code = replaced(code, R"(^(\s+)(f32|vec3<f32>|Hts\w+) (\w+)( =|;))", "$1var $3 : $2$4");
    code =
        replaced(code, R"(for \(i32 (\w+) = (\w+); ([^;]+); \+\+\w+\))", "for (var $1 : i32 = $2; $3; $1++)");
    return replaced(code, R"(^(\s+if \(.*\)) ((?:return|break|[\w.]+ =)[^{}]*;)$)", "$1 { $2 }");
}

}  // namespace

std::string wgsl_of(const std::string& glsl) {
    std::istringstream lines{glsl};
    std::string text;
    bool in_struct = false;
    for (std::string line; std::getline(lines, line);) {
        const std::string code = line.substr(0, line.find("//")), comment = line.substr(code.size());
        if (code == "};") {
            in_struct = false;
            text += "}\n";
        } else {
            text += translated(code, in_struct) + comment + "\n";
            in_struct = in_struct || code.starts_with("struct ");
        }
    }
    return text;
}

}  // namespace hts::tables
