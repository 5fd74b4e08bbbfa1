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

std::string link_to(const std::string& stem, const std::string& text) {
    return "<a href=\"#" + html_escaped(stem) + "\">" + html_escaped(text) + "</a>";
}

///   section   that the claim leads to; null: the claim stands there
std::string check_row(const Check& check, const Section* section = nullptr) {
    std::string html = "<tr><td class=\"verdict ";
    html.append(check.passed ? "good\">&#10003; " : "bad\">&#10007; ").append(check.verdict());
    html.append("</td><td>").append(html_escaped(check.claim));
    if (section != nullptr) html.append("<br>").append(link_to(section->stem, section->title));
    html.append("</td><td>").append(html_escaped(check.measured));
    html.append("</td><td class=\"soft\">").append(html_escaped(check.remark)).append("</td></tr>\n");
    return html;
}

std::string checks_table(const std::string& rows) {
    if (rows.empty()) return "";
    return "<div class=\"wide checks\"><table><tr><th>verdict</th><th>criterion</th><th>measured</th>"
           "<th>remark</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string checks_table(const std::vector<Check>& checks) {
    std::string rows;
    for (const Check& check : checks) rows += check_row(check);
    return checks_table(rows);
}

std::string list(const std::vector<std::string>& items) {
    std::string html = "<ul>\n";
    for (const std::string& item : items) html += "<li>" + item + "</li>\n";
    return html + "</ul>\n";
}

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
    return std::to_string(count) + " " + (count == 1 ? one : several);
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

/// "7 of 12", in the colour of what it says; "" without checks.
std::string score(const Section& section) {
    const Tally own = tally({section});
    if (own.all == 0) return "";
    return " <span class=\"" + std::string{own.passed == own.all ? "good" : "bad"} + "\">" +
           std::to_string(own.passed) + " of " + std::to_string(own.all) + " met</span>";
}

/// A part of the page that folds, closed at first.
std::string folded(const std::string& id, const std::string& title, const std::string& beside,
                   const std::string& content) {
    return "<details id=\"" + html_escaped(id) + "\"><summary><h2>" + html_escaped(title) + "</h2>" + beside +
           "</summary>\n" + content +
           "<p class=\"soft\"><a href=\"#contents\">Back to the contents</a></p>\n" + "</details>\n";
}

std::string section_html(const Section& section,
                         const std::function<std::string(const Figure& figure)>& svg) {
    std::string html = paragraphs(section.text) + checks_table(section.checks);
    for (const Figure& figure : section.figures) {
        html += "<figure class=\"chart\"><div class=\"wide\">" + inline_svg(svg(figure), figure.stem) +
                "</div><figcaption>" + html_escaped(figure.caption) + "</figcaption></figure>\n";
    }
    html += images(section.images);
    for (const ReportTable& numbers : section.tables) html += table(numbers);
    for (const std::string& missing : section.not_available) {
        html += "<p class=\"model\">Not available: " + html_escaped(missing) + "</p>\n";
    }
    return folded(section.stem, section.title, score(section), html);
}

/// Links to all sections.
std::string contents(const std::vector<Section>& sections) {
    std::string html = "<h2 id=\"contents\">Contents</h2>\n<ol>\n";
    for (const Section& section : sections)
        html += "<li>" + link_to(section.stem, section.title) + score(section) + "</li>\n";
    return html + "</ol>\n";
}

/// What is learned of a section whose checks alone say it.
std::string learned_of_checks(const Section& section) {
    const auto missed = std::ranges::find(section.checks, false, &Check::passed);
    std::string text = score(section);
    if (missed != section.checks.end())
        text += ", not: " + html_escaped(missed->claim + " (" + missed->measured + ")");
    return text + ".";
}

/// A line for each section that has something to say; those of measured surfaces are summed up in one.
std::string learned(const std::vector<Section>& sections) {
    std::vector<std::string> lines;
    for (const Section& section : sections) {
        const std::string head = link_to(section.stem, section.title) + ": ";
        if (!section.learned.empty()) {
            lines.push_back(head + html_escaped(section.learned));
        } else if (!section.checks.empty() && !section.part_of_another) {
            lines.push_back(head + learned_of_checks(section));
        }
    }
    return lines.empty() ? "" : "<h2>What was learned</h2>\n" + list(lines);
}

/// What failed, of all sections.
std::string misses(const std::vector<Section>& sections) {
    std::string rows;
    for (const Section& section : sections) {
        for (const Check& check : section.checks) {
            if (!check.passed) rows += check_row(check, &section);
        }
    }
    return rows.empty() ? "" : folded("missed", "What was missed", "", checks_table(rows));
}

/// Whether the program still does what it is known to do.
std::string regressions(const std::vector<std::string>& contradictions) {
    if (contradictions.empty())
        return "<p>Every result is the one recorded: the program does what it is known to do. A criterion "
               "that is missed is a finding on the model.</p>\n";
    std::vector<std::string> lines;
    lines.reserve(contradictions.size());
    for (const std::string& line : contradictions) lines.push_back(html_escaped(line));
    return "<h2 class=\"bad\">" + counted(contradictions.size(), "result contradicts", "results contradict") +
           " what is recorded</h2>\n" + list(lines);
}

// A link to what is folded opens it.
constexpr auto unfolding =
    "<script>const open = () => { const part = "
    "document.getElementById(decodeURIComponent(location.hash.slice(1)));"
    " if (part?.tagName === 'DETAILS') { part.open = true; part.scrollIntoView(); } };"
    " addEventListener('hashchange', open); open();</script>\n";

nlohmann::ordered_json json_of(const ReportTable& numbers) {
    return {{"stem", numbers.stem},
            {"caption", numbers.caption},
            {"columns", numbers.columns},
            {"rows", numbers.rows}};
}

nlohmann::ordered_json json_of(const Check& check) {
    return {{"claim", check.claim},
            {"measured", check.measured},
            {"verdict", check.verdict()},
            {"passed", check.passed},
            {"remark", check.remark}};
}

nlohmann::ordered_json json_of(const Section& section) {
    nlohmann::ordered_json json{
        {"stem", section.stem}, {"title", section.title}, {"learned", section.learned}};
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

std::string report_page(const Validation& findings, const std::string& provenance,
                        const std::function<std::string(const Figure& figure)>& svg) {
    const auto& [sections, contradictions] = findings;
    const Tally all = tally(sections);
    std::string page = output::html_head(
        "Validation of the He-Torrance model",
        "The He-Torrance model against measurements, exact scattering and its paper", "report");
    page += "<p><strong>" + std::to_string(all.passed) + " of " + std::to_string(all.all) +
            " criteria are met.</strong> <span class=\"soft\">" + html_escaped(provenance) + "</span></p>\n";
    page += regressions(contradictions) + learned(sections) + contents(sections) + misses(sections);
    for (const Section& section : sections) page += section_html(section, svg);
    return page.append(unfolding).append(output::html_foot);
}

std::string report_json(const Validation& findings, const std::string& provenance) {
    const Tally all = tally(findings.sections);
    nlohmann::ordered_json json{{"provenance", provenance},
                                {"passed", all.passed},
                                {"checks", all.all},
                                {"contradictions", findings.contradictions}};
    json["sections"] = nlohmann::ordered_json::array();
    for (const Section& section : findings.sections) json["sections"].push_back(json_of(section));
    return json.dump(2) + "\n";
}

}  // namespace hts::validation
