#include "validation/report/report_page.hpp"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "spectral/output/html.hpp"

namespace hts::validation {
namespace {

using output::html_escaped;

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::string_view group = bytes.substr(i, 3);
        unsigned word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8U | (k < group.size() ? static_cast<unsigned char>(group[k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= group.size() ? digits[word >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

void replace_all(std::string& text, std::string_view old, std::string_view fresh) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + fresh.size())) {
        text.replace(at, old.size(), fresh);
    }
}

/// The element <svg> alone, its names made its own, since all pictures of a page share one space of names.
std::string inline_svg(const std::string& file, const std::string& stem) {
    const std::size_t begin = file.find("<svg");
    std::string text = begin == std::string::npos ? "" : file.substr(begin);
    for (const std::string_view mark : {"id=\"", "id='", "href='#", "href=\"#", "url(#"}) {
        replace_all(text, mark, std::string{mark} + stem + "-");
    }
    return text;
}

std::string paragraphs(const std::string& text) {
    std::string html;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find("\n\n", begin), text.size());
        html += "<p>" + html_escaped(text.substr(begin, end - begin)) + "</p>\n";
        begin = end + 2;
    }
    return html;
}

/// A row of cells, `cell` being "td" or "th".
std::string row(const std::vector<std::string>& cells, const std::string& cell) {
    std::string html = "<tr>";
    for (const std::string& text : cells) {
        html.append("<").append(cell).append(">").append(html_escaped(text));
        html.append("</").append(cell).append(">");
    }
    return html + "</tr>\n";
}

std::string check_row(const Check& check) {
    std::string html = check.passed ? "<tr><td class=\"verdict good\">&#10003; met</td><td>"
                                    : "<tr><td class=\"verdict bad\">&#10007; missed</td><td>";
    html.append(html_escaped(check.claim)).append("</td><td>").append(html_escaped(check.measured));
    html.append("</td><td class=\"soft\">").append(html_escaped(check.remark)).append("</td></tr>\n");
    return html;
}

constexpr auto checks_head =
    "<table><tr><th>verdict</th><th>criterion</th><th>measured</th><th>remark</th></tr>\n";

std::string checks_table(const std::vector<Check>& checks) {
    if (checks.empty()) return "";
    std::string html = checks_head;
    for (const Check& check : checks) html += check_row(check);
    return html + "</table>\n";
}

std::string table(const ReportTable& numbers) {
    std::string html = "<div class=\"wide\"><table><caption>" + html_escaped(numbers.caption) +
                       "</caption>\n" + row(numbers.columns, "th");
    for (const auto& cells : numbers.rows) html += row(cells, "td");
    return html + "</table></div>\n";
}

std::string image(const Image& picture) {
    return "<figure><img alt=\"" + html_escaped(picture.caption) + "\" src=\"data:image/png;base64," +
           base64(picture.png) + "\"><figcaption>" + html_escaped(picture.caption) +
           "</figcaption></figure>\n";
}

std::string images(const std::vector<Image>& pictures) {
    if (pictures.empty()) return "";
    std::string html = "<div class=\"images\">\n";
    for (const Image& picture : pictures) html += image(picture);
    return html + "</div>\n";
}

std::string section_html(const Section& section,
                         const std::function<std::string(const Figure& figure)>& svg) {
    std::string html = "<h2 id=\"" + html_escaped(section.stem) + "\">" + html_escaped(section.title) +
                       "</h2>\n" + paragraphs(section.text) + checks_table(section.checks);
    for (const Figure& figure : section.figures) {
        html += "<figure>" + inline_svg(svg(figure), figure.stem) + "<figcaption>" +
                html_escaped(figure.caption) + "</figcaption></figure>\n";
    }
    html += images(section.images);
    for (const ReportTable& numbers : section.tables) html += table(numbers);
    for (const std::string& missing : section.not_available) {
        html += "<p class=\"model\">Not available: " + html_escaped(missing) + "</p>\n";
    }
    return html;
}

std::string link(const Section& section) {
    const Tally own = tally({section});
    std::string html =
        "<li><a href=\"#" + html_escaped(section.stem) + "\">" + html_escaped(section.title) + "</a>";
    if (own.all > 0) {
        html.append(" <span class=\"").append(own.passed == own.all ? "good" : "bad").append("\">");
        html.append(std::to_string(own.passed))
            .append(" of ")
            .append(std::to_string(own.all))
            .append("</span>");
    }
    return html + "</li>\n";
}

/// What failed, of all sections.
std::string misses(const std::vector<Section>& sections) {
    std::string html;
    for (const Section& section : sections) {
        for (const Check& check : section.checks) {
            if (!check.passed) html += check_row(check);
        }
    }
    return html.empty() ? "" : "<h2>What was missed</h2>\n" + std::string{checks_head} + html + "</table>\n";
}

nlohmann::ordered_json json_of(const ReportTable& numbers) {
    return {{"stem", numbers.stem},
            {"caption", numbers.caption},
            {"columns", numbers.columns},
            {"rows", numbers.rows}};
}

nlohmann::ordered_json json_of(const Check& check) {
    return {{"claim", check.claim},
            {"measured", check.measured},
            {"passed", check.passed},
            {"remark", check.remark}};
}

nlohmann::ordered_json json_of(const Section& section) {
    nlohmann::ordered_json json{{"stem", section.stem}, {"title", section.title}};
    json["checks"] = nlohmann::ordered_json::array();
    for (const Check& check : section.checks) json["checks"].push_back(json_of(check));
    json["tables"] = nlohmann::ordered_json::array();
    for (const ReportTable& numbers : section.tables) json["tables"].push_back(json_of(numbers));
    json["not_available"] = section.not_available;
    return json;
}

}  // namespace

Tally tally(const std::vector<Section>& sections) {
    Tally result{0, 0};
    for (const Section& section : sections) {
        result.all += section.checks.size();
        result.passed += static_cast<std::size_t>(std::ranges::count_if(section.checks, &Check::passed));
    }
    return result;
}

std::string report_page(const std::vector<Section>& sections, const std::string& provenance,
                        const std::function<std::string(const Figure& figure)>& svg) {
    const Tally all = tally(sections);
    std::string page = output::html_head(
        "Validation of the He-Torrance model",
        "The He-Torrance model against measurements, exact scattering and its paper", "report");
    page += "<p>" + std::to_string(all.passed) + " of " + std::to_string(all.all) +
            " criteria are met. <span class=\"soft\">" + html_escaped(provenance) + "</span></p>\n<ol>\n";
    for (const Section& section : sections) page += link(section);
    page += "</ol>\n" + misses(sections);
    for (const Section& section : sections) page += section_html(section, svg);
    return page.append(output::html_foot);
}

std::string report_json(const std::vector<Section>& sections, const std::string& provenance) {
    const Tally all = tally(sections);
    nlohmann::ordered_json json{{"provenance", provenance}, {"passed", all.passed}, {"checks", all.all}};
    json["sections"] = nlohmann::ordered_json::array();
    for (const Section& section : sections) json["sections"].push_back(json_of(section));
    return json.dump(2) + "\n";
}

}  // namespace hts::validation
