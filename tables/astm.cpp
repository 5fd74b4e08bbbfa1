#include "tables/astm.hpp"

#include <cmath>

#include "hts/error.hpp"
#include "spectral/text.hpp"

namespace hts::tables {
namespace {

std::vector<std::string_view> pieces(std::string_view line) {
    std::vector<std::string_view> result;
    for (const std::string_view part : spectral::split(line, ','))
        for (const std::string_view word : spectral::words(part)) result.push_back(word);
    return result;
}

std::size_t announced_points(const std::vector<std::string_view>& words, const std::string& place) {
    const std::string text{words.size() > 1 ? words[1] : ""};
    const double count = spectral::located(place, [&] { return spectral::number_in(text); });
    if (count >= 1 && count <= 1e8 && count == std::floor(count)) return static_cast<std::size_t>(count);
    throw Error{place + ": NUM_POINTS " + text + ": must be a whole number from 1"};
}

// `words` are VARS and the names.
AstmFile with_columns(const std::vector<std::string_view>& words, const std::string& place) {
    AstmFile file;
    std::optional<std::size_t> theta_i, theta_s, phi_s;
    for (const std::string_view name : std::span{words}.subspan(1)) {
        const std::size_t column = file.columns++;
        auto* angle = name == "theta_i"   ? &theta_i
                      : name == "phi_i"   ? &file.phi_i
                      : name == "theta_s" ? &theta_s
                      : name == "phi_s"   ? &phi_s
                                          : nullptr;
        if (angle != nullptr) {
            *angle = column;
        } else {
            file.channels.push_back(column);
            file.channel_names.emplace_back(name);
        }
    }
    if (!theta_i || !theta_s || !phi_s || file.channels.empty())
        throw Error{place + ": VARS: must name theta_i, phi_i, theta_s, phi_s and a channel"};
    file.theta_i = *theta_i;
    file.theta_s = *theta_s;
    file.phi_s = *phi_s;
    return file;
}

void append_row(AstmFile& file, const std::vector<std::string_view>& words, const std::string& place) {
    if (words.size() != file.columns) {
        throw Error{place + ": " + std::to_string(words.size()) + " numbers: must be " +
                    std::to_string(file.columns) + " as in VARS"};
    }
    spectral::located(place, [&] {
        for (const std::string_view word : words) file.numbers.push_back(spectral::number_in(word));
    });
}

}  // namespace

AstmFile astm_file(std::string_view text, const std::string& name) {
    std::optional<AstmFile> file;
    std::optional<std::size_t> announced;
    std::size_t number = 0;
    for (const std::string_view line : spectral::split(text, '\n')) {
        ++number;
        const auto words = pieces(line);
        if (words.empty() || words[0].starts_with('#')) continue;
        const std::string place = name + ":" + std::to_string(number);
        if (file) {
            append_row(*file, words, place);
            file->lines.push_back(number);
        } else if (words[0] == "NUM_POINTS") {
            announced = announced_points(words, place);
        } else if (words[0] == "VARS") {
            file = with_columns(words, place);
        }
    }
    if (!file) throw Error{name + ": no line VARS, which names the columns"};
    if (announced && *announced != file->lines.size()) {
        throw Error{name + ": " + std::to_string(file->lines.size()) + " points: NUM_POINTS says " +
                    std::to_string(*announced)};
    }
    return *std::move(file);
}

}  // namespace hts::tables
