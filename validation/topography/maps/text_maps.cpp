#include "validation/topography/maps/text_maps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "spectral/text/text.hpp"

namespace hts::validation {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

double one_of_both(const std::optional<double>& stated, const std::optional<double>& given,
                   const std::string& quantity, const std::string& option) {
    if (stated && given) throw Error{option + ": must not be given, since the file states " + quantity};
    if (stated) return *stated;
    if (given) return *given;
    throw Error{"states no " + quantity + ": must be given by " + option};
}

Error at_line(std::size_t line, const std::string& message) {
    return Error{"line " + std::to_string(line) + ": " + message};
}

/// A field as a height or coordinate; NaN where it says that there is none.
double value_in(std::string_view field, std::size_t line) {
    if (field.empty() || spectral::same_letters(field, "nan")) return no_value;
    if (field.front() == '+') field.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error == std::errc{} && end == field.data() + field.size() && std::isfinite(value)) return value;
    throw at_line(line, spectral::in_quotes(field.substr(0, 40)) + " is not a number");
}

/// Lines with something on them, counted from 1.
class Lines {
  public:
    explicit Lines(std::string_view text) : rest_{text} {}

    /// False at the end.
    bool next() {
        while (!rest_.empty()) {
            const auto end = std::min(rest_.find('\n'), rest_.size());
            line_ = rest_.substr(0, end);
            if (line_.ends_with('\r')) line_.remove_suffix(1);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            ++number_;
            if (!spectral::trimmed(line_).empty()) return true;
        }
        return false;
    }
    [[nodiscard]] std::string_view text() const noexcept { return line_; }
    [[nodiscard]] std::size_t number() const noexcept { return number_; }

  private:
    std::string_view rest_, line_;
    std::size_t number_ = 0;
};

/// What stands between the fields of a line: ',', ';' or a tab where the line has one, else white space.
char separator_of(std::string_view line) {
    for (const char c : {';', '\t', ','}) {
        if (line.find(c) != std::string_view::npos) return c;
    }
    return ' ';
}

void append_values(std::string_view line, char separator, std::size_t number, std::vector<double>& values) {
    if (separator == ' ') {
        for (const std::string_view word : spectral::words(line)) values.push_back(value_in(word, number));
        return;
    }
    // a separator at the end closes the last field
    line = line.substr(0, line.find_last_not_of(" \r") + 1);
    if (line.ends_with(separator)) line.remove_suffix(1);
    for (const std::string_view field : spectral::split(line, separator))
        values.push_back(value_in(spectral::trimmed(field), number));
}

struct Matrix {
    std::size_t columns = 0, rows = 0;
    std::vector<double> values;
};

/// Rows of equally many numbers, from the present line to the end.
Matrix matrix_from(Lines& lines) {
    Matrix matrix;
    const char separator = separator_of(lines.text());
    do {
        if (lines.text().starts_with('#')) continue;
        const std::size_t before = matrix.values.size();
        append_values(lines.text(), separator, lines.number(), matrix.values);
        const std::size_t count = matrix.values.size() - before;
        if (matrix.rows == 0) matrix.columns = count;
        if (count != matrix.columns) {
            throw at_line(lines.number(), std::to_string(count) + " numbers: must be " +
                                              std::to_string(matrix.columns) + ", as in the first row");
        }
        ++matrix.rows;
        if (matrix.columns > HeightMap::most || matrix.values.size() > 3 * HeightMap::most_points)
            HeightMap::require_size(static_cast<double>(matrix.columns), static_cast<double>(matrix.rows));
    } while (lines.next());
    return matrix;
}

HeightMap scaled_map(const std::string& name, Matrix matrix, double step_x, double step_y, double height) {
    for (double& z : matrix.values) z *= height;
    return {name, matrix.columns, matrix.rows, step_x, step_y, std::move(matrix.values)};
}

// ---- points

/// Places along an axis, all a multiple of one step from the first.
struct Axis {
    double first = 0, step = 0;
    std::size_t count = 0;

    [[nodiscard]] std::size_t index(double x) const {
        return static_cast<std::size_t>(std::lround((x - first) / step));
    }
};

Axis axis_of(std::vector<double> places, const char* name) {
    std::ranges::sort(places);
    const double range = places.back() - places.front();
    std::vector<double> gaps;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (const double gap = places[i] - places[i - 1]; gap > 1e-5 * range) gaps.push_back(gap);
    }
    if (gaps.empty()) throw Error{std::string{"all points have one "} + name + ": must be a grid"};
    Axis axis{places.front(), *std::ranges::min_element(gaps), 0};
    axis.step = range / std::max(1.0, std::round(range / axis.step));
    axis.count = axis.index(places.back()) + 1;
    for (const double place : places) {
        const double steps = (place - axis.first) / axis.step;
        if (std::fabs(steps - std::round(steps)) > 0.02) {
            throw Error{std::string{name} + " = " + shortest(place) + ": must be on a grid, here with step " +
                        spectral::brief(axis.step)};
        }
    }
    return axis;
}

HeightMap map_from_points(const Matrix& points, const std::string& name, const StatedUnits& units) {
    units.refuse_step();
    std::vector<double> x, y;
    for (std::size_t i = 0; i < points.rows; ++i) {
        x.push_back(points.values[3 * i]);
        y.push_back(points.values[3 * i + 1]);
        if (std::isnan(x.back() + y.back()))
            throw Error{"point " + std::to_string(i + 1) + ": must have x and y"};
    }
    const Axis across = axis_of(x, "x"), upwards = axis_of(y, "y");
    HeightMap::require_size(static_cast<double>(across.count), static_cast<double>(upwards.count));
    Matrix grid{across.count, upwards.count, std::vector<double>(across.count * upwards.count, no_value)};
    std::vector<bool> taken(grid.values.size());
    for (std::size_t i = 0; i < points.rows; ++i) {
        const std::size_t row = upwards.count - 1 - upwards.index(y[i]);
        const std::size_t place = row * across.count + across.index(x[i]);
        if (taken[place]) {
            throw Error{"point " + std::to_string(i + 1) + ", x = " + shortest(x[i]) +
                        ", y = " + shortest(y[i]) + ": stands twice"};
        }
        taken[place] = true;
        grid.values[place] = points.values[3 * i + 2];
    }
    const double unit = units.length();
    return scaled_map(name, std::move(grid), unit * across.step, unit * upwards.step, units.height());
}

// ---- ESRI

HeightMap map_from_esri(Lines& lines, const std::string& name, const StatedUnits& units) {
    units.refuse_step();
    std::map<std::string, double> head;
    bool more = true;
    for (; more; more = lines.next()) {
        const auto words = spectral::words(lines.text());
        if (words.size() != 2 || std::isalpha(static_cast<unsigned char>(words[0].front())) == 0 ||
            spectral::same_letters(words[0], "nan"))
            break;
        std::string key{words[0]};
        std::ranges::transform(key, key.begin(), [](unsigned char c) { return std::tolower(c); });
        static const std::vector<std::string> known{"ncols",     "nrows",       "xllcorner", "yllcorner",
                                                    "xllcenter", "yllcenter",   "cellsize",  "dx",
                                                    "dy",        "nodata_value"};
        if (std::ranges::find(known, key) == known.end())
            throw at_line(lines.number(), spectral::in_quotes(words[0]) + ": no key of an ESRI grid");
        if (!head.emplace(key, value_in(words[1], lines.number())).second)
            throw at_line(lines.number(), key + ": stands twice");
    }
    const auto number = [&](const std::string& key, const std::string& other) {
        const auto found = head.contains(key) ? head.find(key) : head.find(other);
        if (found == head.end()) throw Error{"ESRI grid without " + key};
        return found->second;
    };
    const double columns = number("ncols", ""), rows = number("nrows", "");
    HeightMap::require_size(columns, rows);
    Matrix matrix{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), {}};
    for (; more; more = lines.next()) append_values(lines.text(), ' ', lines.number(), matrix.values);
    if (matrix.values.size() != matrix.columns * matrix.rows) {
        throw Error{std::to_string(matrix.values.size()) + " heights: must be " + shortest(columns) +
                    " times " + shortest(rows) + ", as ncols and nrows say"};
    }
    if (const auto none = head.find("nodata_value"); none != head.end())
        std::ranges::replace(matrix.values, none->second, no_value);
    const double unit = units.length();
    return scaled_map(name, std::move(matrix), unit * number("dx", "cellsize"),
                      unit * number("dy", "cellsize"), units.height());
}

// ---- Gwyddion

/// "10.0 µm" in um.
double stated_length(std::string_view text, std::size_t line) {
    const auto words = spectral::words(text);
    if (words.size() != 2) throw at_line(line, "must be a number and a unit");
    const double value = value_in(words[0], line);
    return spectral::located("line " + std::to_string(line), [&] { return value * length_unit(words[1]); });
}

/// What the lines with # in front say, if they say it as Gwyddion does.
struct MatrixHead {
    std::optional<double> width, height, unit;

    void read(std::string_view line, std::size_t number) {
        line.remove_prefix(1);
        const auto colon = line.find(':');
        if (colon == std::string_view::npos) return;
        const std::string_view key = spectral::trimmed(line.substr(0, colon));
        const std::string_view value = spectral::trimmed(line.substr(colon + 1));
        if (key == "Width") width = stated_length(value, number);
        if (key == "Height") height = stated_length(value, number);
        if (key == "Value units") {
            unit = spectral::located("line " + std::to_string(number), [&] { return length_unit(value); });
        }
    }
};

}  // namespace

double StatedUnits::step_x() const {
    return one_of_both(stated_.step_x, given_.step_x, "distance of its points", "--step");
}
double StatedUnits::step_y() const {
    return one_of_both(stated_.step_y, given_.step_y, "distance of its points", "--step");
}
double StatedUnits::length() const {
    return one_of_both(stated_.length, given_.length, "unit of lengths in the plane", "--length-unit");
}
double StatedUnits::height() const {
    return one_of_both(stated_.height, given_.height, "unit of heights", "--height-unit");
}
void StatedUnits::refuse_step() const {
    if (given_.step_x) throw Error{"--step: must not be given, since the file states places of its points"};
}
void StatedUnits::refuse_length() const {
    if (given_.length)
        throw Error{"--length-unit: must not be given, since the file states no lengths in the plane"};
}

HeightMap map_from_text(std::string_view text, const std::string& name, const MapUnits& given) {
    Lines lines{text};
    StatedUnits units{given};
    MatrixHead head;
    bool more = lines.next();
    for (; more && lines.text().starts_with('#'); more = lines.next())
        head.read(lines.text(), lines.number());
    if (!more) throw Error{"no heights"};
    const auto first = spectral::words(lines.text());
    if (first.size() == 2 && spectral::same_letters(first[0], "ncols"))
        return map_from_esri(lines, name, units);
    if (spectral::same_letters(first[0].substr(0, 1), "x")) {  // a line of names above points
        if (!lines.next()) throw Error{"no points"};
    }
    Matrix matrix = matrix_from(lines);
    if (head.unit) units.state_height(*head.unit);
    if (matrix.columns == 3) return map_from_points(matrix, name, units);
    units.refuse_length();
    HeightMap::require_size(static_cast<double>(matrix.columns), static_cast<double>(matrix.rows));
    if (head.width && head.height) {
        units.state_step(*head.width / static_cast<double>(matrix.columns),
                         *head.height / static_cast<double>(matrix.rows));
    }
    return scaled_map(name, std::move(matrix), units.step_x(), units.step_y(), units.height());
}

}  // namespace hts::validation
