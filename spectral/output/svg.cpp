#include "spectral/output/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::output {
namespace {

constexpr std::string_view dark_style =
    "<style>@media (prefers-color-scheme: dark) { svg { filter: invert(0.93) hue-rotate(180deg); } "
    "}</style>\n";

/// The number at the begin of a text.
double leading_number(std::string_view text) {
    return std::strtod(std::string{text.substr(0, 16)}.c_str(), nullptr);
}

/// Text of markup without its elements.
std::string without_tags(std::string_view markup) {
    std::string text;
    bool inside = false;
    for (const char c : markup) {
        if (c == '<') inside = true;
        if (!inside) text += c;
        if (c == '>') inside = false;
    }
    return text;
}

/// What stands first in the largest letters of all; those of a text are its group's.
std::string largest_text(std::string_view svg) {
    std::string found;
    double largest = 0;
    constexpr std::string_view open = "<text>", close = "</text>", group = "<g transform",
                               size = "font-size=\"";
    for (std::size_t at = svg.find(open); at != std::string_view::npos; at = svg.find(open, at + 1)) {
        const std::size_t begin = svg.rfind(group, at);
        const std::size_t place = begin == std::string_view::npos ? begin : svg.find(size, begin);
        if (place == std::string_view::npos || place > at) continue;
        const double height = leading_number(svg.substr(place + size.size()));
        if (height <= largest) continue;
        const std::string text = without_tags(svg.substr(at, svg.find(close, at) - at));
        if (spectral::trimmed(text).empty()) continue;
        largest = height;
        found = spectral::trimmed(text);
    }
    return found;
}

/// Titles that name no line: "gnuplot_plot_3", or the columns of the data.
bool names_nothing(std::string_view title) {
    return title.starts_with("gnuplot_plot_") || title.find(" using ") != std::string_view::npos;
}

void replace_all(std::string& text, std::string_view old, std::string_view fresh) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + fresh.size()))
        text.replace(at, old.size(), fresh);
}

/// The picture's own title, its dark form, and titles of those lines that have a name.
std::string titled(std::string_view drawn) {
    constexpr std::string_view open = "<title>", close = "</title>", describe = "<desc>",
                               described = "</desc>\n";
    std::string svg;
    svg.reserve(drawn.size() + 512);
    const std::string own = largest_text(drawn);
    bool of_picture = true;
    for (std::size_t at = drawn.find(open); at != std::string_view::npos; at = drawn.find(open)) {
        const std::size_t end = std::min(drawn.find(close, at), drawn.size() - close.size());
        const std::string_view title = drawn.substr(at + open.size(), end - at - open.size());
        svg += drawn.substr(0, at);
        drawn.remove_prefix(end + close.size());
        if (std::exchange(of_picture, false)) {
            svg.append(open).append(own).append(close).append("\n").append(dark_style);
            const std::size_t from = drawn.find(describe), past = drawn.find(described);
            if (from < past && past != std::string_view::npos) drawn.remove_prefix(past + described.size());
        } else if (!names_nothing(title)) {
            svg.append(open).append(title).append(close);
        }
    }
    return svg.append(drawn);
}

/// Filled circles of one size and colour after each other, as one path of points with round ends.
class Dots {
  public:
    /// Takes a line "<use xlink:href='#gpPt6' transform='translate(1,2) scale(3)' color='red'/>"; false for
    /// others.
    bool take(std::string_view line, std::string& svg) {
        constexpr std::string_view begin = "<use xlink:href='#gpPt6' transform='translate(",
                                   size = ") scale(", colour = ")' color='";
        const std::size_t at = line.find(begin), middle = line.find(size), last = line.find(colour);
        if (at == std::string_view::npos || middle == std::string_view::npos ||
            last == std::string_view::npos)
            return false;
        const std::size_t end = line.find('\'', last + colour.size());
        const std::string_view style = line.substr(middle + size.size(), end - middle - size.size());
        if (style != style_) flush(svg);
        if (style_.empty()) {
            style_ = style;
            width_ = 2 * leading_number(style);
            colour_ = line.substr(last + colour.size(), end - last - colour.size());
        }
        path_.append("M").append(line.substr(at + begin.size(), middle - at - begin.size())).append("h0 ");
        return true;
    }
    void flush(std::string& svg) {
        if (!path_.empty())
            svg.append("<path stroke-linecap='round' stroke='")
                .append(colour_)
                .append("' stroke-width='")
                .append(shortest(width_))
                .append("' d='")
                .append(path_)
                .append("'/>\n");
        path_.clear();
        style_.clear();
    }

  private:
    std::string style_, colour_, path_;
    double width_ = 0;
};

/// A tenth of a pixel is enough: "12.3457" becomes "12.3".
void append_rounded(std::string& svg, std::string_view number) {
    if (number.find('.') == std::string_view::npos) {
        svg += number;
    } else {
        svg += shortest(std::round(10 * leading_number(number)) / 10);
    }
}

/// Coordinates of paths and polygons behind the definitions, rounded.
std::string with_rounded_coordinates(std::string_view svg) {
    const auto is_part_of_number = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
    std::string result;
    result.reserve(svg.size());
    const std::size_t from = std::min(svg.find("</defs>"), svg.size());
    result += svg.substr(0, from);
    svg.remove_prefix(from);
    while (true) {
        const std::size_t begin = std::min({svg.find(" d='"), svg.find("points = '"), svg.size()});
        const std::size_t open = std::min(svg.find('\'', begin), svg.size());
        const std::size_t close = std::min(svg.find('\'', std::min(open + 1, svg.size())), svg.size());
        result += svg.substr(0, open);
        for (std::size_t at = open; at < close;) {
            std::size_t end = at;
            while (end < close && is_part_of_number(svg[end])) ++end;
            if (end > at) append_rounded(result, svg.substr(at, end - at));
            if (end < close) result += svg[end++];
            at = end;
        }
        svg.remove_prefix(close);
        if (svg.empty()) return result;
    }
}

/// Without groups that hold nothing, and dots as paths.
std::string without_empty_groups(std::string_view svg) {
    std::string result;
    result.reserve(svg.size());
    Dots dots;
    std::string_view group;  // not written yet
    while (!svg.empty()) {
        const std::size_t end = std::min(svg.find('\n'), svg.size() - 1) + 1;
        const std::string_view line = svg.substr(0, end), content = spectral::trimmed(line);
        svg.remove_prefix(end);
        if (content.empty()) continue;
        if (content == "</g>" && !group.empty()) {
            group = {};
            continue;
        }
        result += std::exchange(group, {});
        if (dots.take(content, result)) continue;
        dots.flush(result);
        if (content.starts_with("<g fill=\"none\" color=") && content.find('>') + 1 == content.size()) {
            group = line;
        } else {
            result.append(content).append("\n");
        }
    }
    return result;
}

/// "rgb(228, 228, 228)" as "#e4e4e4".
std::string with_short_colours(std::string_view svg) {
    constexpr std::string_view open = "rgb(";
    std::string result;
    result.reserve(svg.size());
    for (std::size_t at = svg.find(open); at != std::string_view::npos; at = svg.find(open)) {
        result += svg.substr(0, at);
        std::array<unsigned, 3> parts{};
        const std::string text{svg.substr(at, std::string_view{"rgb(255, 255, 255)"}.size())};
        std::array<char, 8> colour{};
        if (std::sscanf(text.c_str(), "rgb(%u,%u,%u)", &parts[0], &parts[1], &parts[2]) == 3 &&
            text.find(')') != std::string::npos) {
            std::snprintf(colour.data(), colour.size(), "#%02x%02x%02x", parts[0] & 255U, parts[1] & 255U,
                          parts[2] & 255U);
            result += colour.data();
            at += text.find(')') + 1;
        } else {
            result += open;
            at += open.size();
        }
        svg.remove_prefix(at);
    }
    return result.append(svg);
}

/// The same picture in fewer bytes.
std::string shortened(std::string_view svg) {
    std::string result = with_short_colours(with_rounded_coordinates(without_empty_groups(svg)));
    replace_all(result, " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"", "");  // as it is anyway
    replace_all(result, " class=\"gridline\" ", "");
    replace_all(result, " font-family=\"Helvetica\"", "");  // as the whole picture's
    replace_all(result, "<g id=\"gnuplot_canvas\">", "<g font-family=\"Helvetica, Arial, sans-serif\">");
    return result;
}

}  // namespace

std::string finished_svg(std::string_view drawn) {
    return shortened(titled(drawn));
}

}  // namespace hts::output
