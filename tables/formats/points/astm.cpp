#include "tables/formats/points/astm.hpp"

#include <algorithm>
#include <cmath>

#include "hts/error.hpp"
#include "spectral/text/text.hpp"

namespace hts::tables {
namespace {

// Between semicolons or commas if the line has any, so that an empty cell stays one, but for one behind the
// last; otherwise between white space.
std::vector<std::string_view> pieces(std::string_view line) {
    const char separator = line.find(';') != std::string_view::npos ? ';' : ',';
    if (line.find(separator) == std::string_view::npos) return spectral::words(line);
    auto result = spectral::split(line, separator);
    for (std::string_view& piece : result) piece = spectral::trimmed(piece);
    if (result.size() > 1 && result.back().empty()) result.pop_back();
    return result;
}

// A line of the head, "VARS theta_i,phi_i" or "NUM_POINTS 6": its keyword and what follows.
struct HeadLine {
    std::string_view keyword;
    std::vector<std::string_view> values{};
};

HeadLine head_line(std::string_view line) {
    const auto end = line.find_first_of(",; \t");
    if (end == std::string_view::npos) return {line};
    auto rest = spectral::trimmed(line.substr(end));
    if (rest.starts_with(',') || rest.starts_with(';')) rest = spectral::trimmed(rest.substr(1));
    return {line.substr(0, end), rest.empty() ? std::vector<std::string_view>{} : pieces(rest)};
}

std::size_t announced_points(const HeadLine& line, const std::string& place) {
    const std::string text{line.values.empty() ? "" : line.values.front()};
    const auto count = [&] {
        try {
            return spectral::number_in(text);
        } catch (const Error&) {
            return 0.0;
        }
    }();
    if (count >= 1 && count <= 1e8 && count == std::floor(count)) return static_cast<std::size_t>(count);
    throw Error{place + ": NUM_POINTS: " + spectral::in_quotes(text) +
                ": must be a whole number from 1 to 100000000"};
}

void require_names(const std::vector<std::string_view>& names, const std::string& place) {
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (name->empty()) throw Error{place + ": VARS: a name is empty"};
        if (std::find(names.begin(), name, *name) != name)
            throw Error{place + ": VARS: " + spectral::in_quotes(*name) + " stands twice"};
    }
}

AstmFile with_columns(const std::vector<std::string_view>& names, const std::string& place) {
    require_names(names, place);
    AstmFile file;
    std::optional<std::size_t> theta_i, theta_s, phi_s;
    for (const std::string_view name : names) {
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

bool is_astm_file(std::string_view text) {
    for (auto at = text.find("VARS"); at != std::string_view::npos; at = text.find("VARS", at + 1)) {
        const bool begins = at == 0 || text[at - 1] == '\n';
        if (begins && at + 4 < text.size() &&
            std::string_view{" \t,;"}.find(text[at + 4]) != std::string_view::npos)
            return true;
    }
    return false;
}

AstmFile astm_file(std::string_view text, const std::string& name) {
    std::optional<AstmFile> file;
    std::optional<std::size_t> announced;
    std::size_t number = 0;
    for (const std::string_view line : spectral::split(text, '\n')) {
        ++number;
        const std::string_view bare = spectral::trimmed(line);
        if (bare.empty() || bare.starts_with('#')) continue;
        const std::string place = name + ":" + std::to_string(number);
        if (file) {
            append_row(*file, pieces(bare), place);
            file->lines.push_back(number);
            continue;
        }
        const HeadLine head = head_line(bare);
        if (head.keyword == "NUM_POINTS") announced = announced_points(head, place);
        if (head.keyword == "VARS") file = with_columns(head.values, place);
    }
    if (!file) throw Error{name + ": no line VARS, which names the columns"};
    if (announced && *announced != file->lines.size()) {
        throw Error{name + ": " + std::to_string(file->lines.size()) + " points: NUM_POINTS says " +
                    std::to_string(*announced)};
    }
    return *std::move(file);
}

}  // namespace hts::tables
