#include "tables/formats/points/fred.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::tables {
namespace {

using spectral::same_letters;

struct Line {
    std::size_t number;
    std::vector<std::string_view> words;
};

// Between white space, commas and semicolons.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> result;
    for (const std::string_view word : spectral::words(line)) {
        for (const std::string_view part : spectral::split(word, ';'))
            for (const std::string_view piece : spectral::split(part, ','))
                if (!piece.empty()) result.push_back(piece);
    }
    return result;
}

// Lines that are neither blank nor remarks.
std::vector<Line> lines_of(std::string_view text, std::vector<std::string>& remarks) {
    std::vector<Line> result;
    std::size_t number = 0;
    for (const std::string_view line : spectral::split(text, '\n')) {
        ++number;
        std::string_view content = spectral::trimmed(line);
        if (content.empty()) continue;
        if (content.front() == '#' || content.front() == '!') {
            content.remove_prefix(std::min(content.find_first_not_of("#!"), content.size()));
            content = spectral::trimmed(content);
            if (result.size() < 2 && !content.empty()) remarks.emplace_back(content);
            continue;
        }
        result.push_back({number, words_of(content)});
    }
    return result;
}

// Factors of angles and values that the line "format …" says.
struct Units {
    double degrees = 1, scale = 1;
};

Units units_of(const Line& line, const std::string& place) {
    Units units;
    const auto legal = [&] {
        return Error{
            place +
            R"(: must be "format angles=deg bsdf=value scale=1", angles deg or rad, scale any number)"};
    };
    if (line.words.empty() || !same_letters(line.words.front(), "format")) throw legal();
    for (std::size_t i = 1; i < line.words.size(); ++i) {
        const auto equals = line.words[i].find('=');
        if (equals == std::string_view::npos) throw legal();
        const auto key = line.words[i].substr(0, equals), value = line.words[i].substr(equals + 1);
        if (same_letters(key, "angles") && same_letters(value, "deg")) continue;
        if (same_letters(key, "bsdf") && same_letters(value, "value")) continue;
        if (same_letters(key, "angles") && same_letters(value, "rad")) {
            units.degrees = 180 / std::numbers::pi;
        } else if (same_letters(key, "scale")) {
            units.scale = spectral::located(place, [&] { return spectral::number_in(value, "scale"); });
        } else {
            throw legal();
        }
    }
    return units;
}

}  // namespace

bool is_fred_file(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size();) {
        const auto end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = spectral::trimmed(text.substr(begin, end - begin));
        begin = end + 1;
        if (line.empty() || line.front() == '#' || line.front() == '!') continue;
        const auto words = spectral::words(line.substr(0, 200));
        return words.size() == 2 && same_letters(words[0], "type") && same_letters(words[1], "bsdf_data");
    }
    return false;
}

FredFile fred_file(std::string_view text, const std::string& name) {
    FredFile file;
    const auto lines = lines_of(text, file.remarks);
    const auto place = [&](std::size_t i) {
        return name + ":" + std::to_string(i < lines.size() ? lines[i].number : i + 1);
    };
    const bool typed = !lines.empty() && lines[0].words.size() == 2 &&
                       same_letters(lines[0].words[0], "type") &&
                       same_letters(lines[0].words[1], "bsdf_data");
    if (!typed) throw Error{place(0) + R"(: must be "type bsdf_data")"};
    const Units units = units_of(lines.size() > 1 ? lines[1] : Line{2, {}}, place(1));
    std::optional<std::pair<double, double>> light;
    for (std::size_t i = 2; i < lines.size(); ++i) {
        std::vector<double> numbers;
        spectral::located(place(i), [&] {
            for (const std::string_view word : lines[i].words) numbers.push_back(spectral::number_in(word));
        });
        if (numbers.size() == 2) {
            light = {units.degrees * numbers[0], units.degrees * numbers[1]};
            continue;
        }
        if (numbers.size() != 3)
            throw Error{place(i) + ": " + std::to_string(numbers.size()) +
                        " numbers: must be 2 (theta_i phi_i) or 3 (theta_s phi_s bsdf)"};
        if (!light)
            throw Error{place(i) + R"(: values before the light's direction: must follow "theta_i phi_i")"};
        file.points.push_back({light->first, light->second, units.degrees * numbers[0],
                               units.degrees * numbers[1], units.scale * numbers[2], lines[i].number});
    }
    if (file.points.empty()) throw Error{name + ": no points"};
    return file;
}

}  // namespace hts::tables
