#include "spectral/output/html.hpp"

#include "spectral/output/embedded.hpp"

namespace hts::output {
namespace {

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
    head.append(html_escaped(title)).append("</title>\n<style>\n");
    head.append(spectral::embedded_text(page_files(), "page")).append("\n");
    head.append(spectral::embedded_text(page_files(), style));
    head.append("</style></head><body>\n<h1>").append(html_escaped(heading)).append("</h1>\n");
    return head;
}

}  // namespace hts::output
