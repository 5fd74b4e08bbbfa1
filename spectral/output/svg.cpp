#include "spectral/output/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

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

/// A place in tenths of a pixel, cut off the begin of a path's text; none where there is none.
std::optional<std::array<long, 2>> take_place(std::string_view& text) {
    constexpr std::string_view of_numbers = "0123456789.-";
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::size_t end = std::min(text.find_first_not_of(of_numbers, comma + 1), text.size());
    if (comma == text.size() || text.find_first_not_of(of_numbers) != comma || end == comma + 1)
        return std::nullopt;
    const std::array<long, 2> place{std::lround(10 * leading_number(text)),
                                    std::lround(10 * leading_number(text.substr(comma + 1)))};
    text.remove_prefix(end);
    return place;
}

/// A place or step in tenths of a pixel, as short as paths may say it: {5, -20} is ".5-2".
std::string tenths(std::array<long, 2> counts) {
    std::string text;
    for (const long count : counts) {
        std::string number = shortest(static_cast<double>(count) / 10);
        if (const std::size_t zero = number.find("0."); zero < 2 && std::abs(count) < 10)
            number.erase(zero, 1);
        if (!text.empty() && count >= 0) text += ',';
        text += number;
    }
    return text;
}

/// A path of straight lines, "M1.04,2 L3,4 Z", in steps of tenths of a pixel, "M1,2l2,2Z"; none for others.
std::optional<std::string> in_steps(std::string_view text) {
    std::string path;
    std::array<long, 2> at{};
    bool stepping = false;
    while (!(text = spectral::trimmed(text)).empty()) {
        const char what = text.front();
        text.remove_prefix(1);
        if (what == 'Z') {
            path += what;
            stepping = false;
            continue;
        }
        const auto next = what == 'M' || what == 'L' ? take_place(text) : std::nullopt;
        if (!next) return std::nullopt;
        const std::array<long, 2> from = what == 'M' ? std::array<long, 2>{} : at;
        const std::string step = tenths({(*next)[0] - from[0], (*next)[1] - from[1]});
        path += what == 'M' ? "M" : !stepping ? "l" : step.front() == '-' ? "" : " ";
        path += step;
        stepping = what == 'L';
        at = *next;
    }
    return path;
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
        const auto steps = begin < svg.size() && svg[begin] == ' ' && open + 1 < close
                               ? in_steps(svg.substr(open + 1, close - open - 1))
                               : std::nullopt;
        if (steps) result.append("'").append(*steps);
        for (std::size_t at = open; at < close && !steps;) {
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

/// What gnuplot says of nearly every group, and the whole picture therefore once.
constexpr std::string_view usual_style = " fill=\"none\" color=\"black\" stroke=\"currentColor\"",
                           grid_style = " fill=\"none\" color=\"gray\" stroke=\"currentColor\"";

/// A group's tag without the usual style and the name "gnuplot_plot_3", to which nothing refers.
std::string short_tag(std::string_view tag) {
    std::string text{tag};
    for (const std::string_view style : {usual_style, grid_style}) replace_all(text, style, "");
    return text.starts_with("<g id=\"gnuplot_plot_") ? "<g>" : text;
}

/// Without groups that say nothing of their own. A group with a title stays.
std::string without_plain_groups(std::string_view svg) {
    constexpr std::string_view title = "<title>", close = "</g>";
    std::string result;
    result.reserve(svg.size());
    std::vector<bool> written;  // of each open group
    for (std::size_t at = svg.find('<'); at != std::string_view::npos; at = svg.find('<')) {
        result += svg.substr(0, at);
        svg.remove_prefix(at);
        const std::size_t length = std::min(svg.find('>'), svg.size() - 1) + 1;
        const std::string_view tag = svg.substr(0, length);
        svg.remove_prefix(length);
        if (tag.starts_with("<g ") || tag == "<g>") {
            const std::string fresh = short_tag(tag);
            written.push_back(fresh != "<g>" || svg.starts_with(title));
            if (written.back()) result += fresh;
        } else if (tag != close || written.empty()) {
            result += tag;
        } else {
            if (written.back()) result += close;
            written.pop_back();
        }
    }
    return result.append(svg);
}

bool refers_to(std::string_view svg, std::string_view name) {
    constexpr std::array<std::string_view, 3> ends{"'", "\"", ")"};
    return std::ranges::any_of(ends, [&](std::string_view end) {
        return svg.find(std::string{"#"}.append(name).append(end)) != std::string_view::npos;
    });
}

/// The shapes among the definitions to which the picture refers. A shape refers to earlier ones alone.
std::string without_unused_shapes(std::string_view svg) {
    constexpr std::string_view open = "<defs>", close = "</defs>", named = "id='";
    const std::size_t begin = svg.find(open), end = svg.find(close, std::min(begin, svg.size()));
    if (end == std::string_view::npos) return std::string{svg};
    std::vector<std::string_view> shapes;
    std::string_view rest = svg.substr(begin + open.size(), end - begin - open.size());
    for (std::size_t at = rest.find('<'); at != std::string_view::npos; at = rest.find('<')) {
        rest.remove_prefix(at);
        const std::string_view tag = rest.substr(0, rest.find('>'));
        const std::string closing = "</" + std::string{tag.substr(1, tag.find_first_of(" \n") - 1)};
        const std::size_t last = tag.ends_with('/') ? tag.size() : rest.find('>', rest.find(closing));
        shapes.push_back(rest.substr(0, std::min(last, rest.size() - 1) + 1));
        rest.remove_prefix(shapes.back().size());
    }
    std::string used, picture{svg.substr(end + close.size())};
    for (std::size_t i = shapes.size(); i-- > 0;) {
        const std::size_t at = std::min(shapes[i].find(named), shapes[i].size() - 1);
        const std::string_view from = shapes[i].substr(std::min(at + named.size(), shapes[i].size()));
        const std::string_view of = from.substr(0, from.find('\''));
        if (refers_to(picture, of) || refers_to(used, of)) used.insert(0, std::string{shapes[i]} + "\n");
    }
    if (!used.empty()) used = std::string{open}.append("\n").append(used).append(close);
    return std::string{svg.substr(0, begin)}.append(used).append(picture);
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
        // NOLINTNEXTLINE(cert-err34-c): gnuplot writes no number too large
        if (std::sscanf(text.c_str(), "rgb(%u,%u,%u)", parts.data(), &parts[1], &parts[2]) == 3 &&
            text.find(')') != std::string::npos) {
            static_cast<void>(std::snprintf(colour.data(), colour.size(), "#%02x%02x%02x", parts[0] & 255U,
                                            parts[1] & 255U, parts[2] & 255U));
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
    replace_all(result, " stroke-width=\"1.00\"", "");  // as it is anyway
    replace_all(result, ".00\"", "\"");
    replace_all(result, " font-family=\"Helvetica\"", "");  // as the whole picture's
    replace_all(result, "\" fill=\"#ffffff\"/>", "\" fill=\"#ffffff\" stroke=\"none\"/>");  // the background
    result = without_unused_shapes(without_plain_groups(result));
    replace_all(result, "<g id=\"gnuplot_canvas\">",
                "<g font-family=\"Helvetica, Arial, sans-serif\"" + std::string{usual_style} + ">");
    return result;
}

}  // namespace

std::string finished_svg(std::string_view drawn) {
    return shortened(titled(drawn));
}

}  // namespace hts::output
