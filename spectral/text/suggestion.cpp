#include "spectral/text/suggestion.hpp"

#include <algorithm>
#include <cctype>

#include "spectral/text/text.hpp"

namespace hts::spectral {
namespace {

std::string plain(std::string_view name) {
    std::string text;
    for (const char c : name)
        text += c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string letters_of(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return letters;
}

/// Letters put in, left out, replaced or swapped with their neighbour [Damerau 1964, one edit a letter].
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
    constexpr std::size_t longest = 64;  // no name is that long, and a file may be given for one
    if (word.empty() || word.size() > longest) return "";
    const std::string wanted = plain(word);
    std::string best, beginning;
    const std::size_t length = wanted.size();
    // a letter or two say nothing but in another case
    std::size_t least = length < 3 ? 1 : std::max(length / 3, std::min<std::size_t>(2, length / 2)) + 1;
    std::size_t begin_so = 0;
    for (const std::string& name : names) {
        const std::string own = plain(name);
        if (const std::size_t apart = distance(wanted, own); apart < least) {
            least = apart;
            best = name;
        }
        if (!own.starts_with(wanted)) continue;
        ++begin_so;
        beginning = name;
    }
    return least > 1 && begin_so == 1 ? beginning : best;
}

std::string similar_name(std::string_view name, const std::vector<std::string>& known) {
    const std::string wanted = letters_of(name);
    std::string best;
    std::size_t least = std::min<std::size_t>(2, wanted.size() / 4) + 1;
    for (const std::string& each : known) {
        const std::size_t apart = distance(wanted, letters_of(each));
        if (apart >= least) continue;
        least = apart;
        best = each;
    }
    return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
    const std::string name = nearest(word, names);
    return name.empty() ? "" : "; did you mean " + in_quotes(name) + "?";
}

std::string must_be_one_of(std::string_view word, const std::vector<std::string>& names) {
    return "must be one of " + joined(names) + did_you_mean(word, names);
}

}  // namespace hts::spectral
