#include "spectral/text/html.hpp"

namespace hts::spectral {
namespace {

constexpr std::string_view common_style = R"(
:root { color-scheme: light dark; --ink: #1b1f24; --paper: #fff; --rule: #d0d7de; --soft: #57606a;
        --good: #116329; --bad: #a40e26; --model: #7d4e00; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --paper: #0d1117; --rule: #30363d; --soft: #9da7b3;
          --good: #56d364; --bad: #ff7b72; --model: #e3b341; } }
body { font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--paper);
       max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.1rem; margin: 2rem 0 .4rem; }
table { border-collapse: collapse; width: 100%; }
td, th { text-align: left; vertical-align: top; padding: .35rem .6rem; border-top: 1px solid var(--rule); }
th { color: var(--soft); font-weight: 600; }
.good { color: var(--good); } .bad { color: var(--bad); } .model { color: var(--model); }
.soft { color: var(--soft); }
)";

std::string_view entity(char c) {
    switch (c) {
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '&':
            return "&amp;";
        case '"':
            return "&quot;";
        default:
            return {};
    }
}

}  // namespace

std::string html_escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (const std::string_view name = entity(c); name.empty()) {
            result += c;
        } else {
            result += name;
        }
    }
    return result;
}

std::string html_head(std::string_view title, std::string_view heading, std::string_view style) {
    std::string head =
        "<!DOCTYPE html>\n<html lang=\"en-GB\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>";
    head.append(html_escaped(title)).append("</title>\n<style>").append(common_style).append(style);
    head.append("</style></head><body>\n<h1>").append(html_escaped(heading)).append("</h1>\n");
    return head;
}

}  // namespace hts::spectral
