#include "validation/report/recorded.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "hts/error.hpp"
#include "spectral/text/json_value.hpp"
#include "spectral/text/text.hpp"
#include "validation/report/recorded_data.hpp"

namespace hts::validation {
namespace {

constexpr double rounding = 1e-9;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// The number at the begin of a text, which is cut off; none if there is none.
std::optional<double> take_number(std::string_view& text) {
    std::size_t end = !text.empty() && text[0] == '-' ? 1 : 0;
    const std::size_t digits = end;
    while (end < text.size() && (is_digit(text[end]) || (text[end] == '.' && end > digits))) ++end;
    if (end == digits) return std::nullopt;
    if (text[end - 1] == '.') --end;  // of the sentence
    if (end + 2 < text.size() && text[end] == 'e' && (text[end + 1] == '-' || text[end + 1] == '+') &&
        is_digit(text[end + 2])) {
        for (end += 2; end < text.size() && is_digit(text[end]);) ++end;
    }
    const double value = spectral::number_in(text.substr(0, end));
    text.remove_prefix(end);
    return value;
}

bool near(double a, double b, double tolerance) {
    const double larger = std::max(std::abs(a), std::abs(b));
    return larger < rounding || std::abs(a - b) <= tolerance * larger;
}

/// Whether a claim is one of those that a computation of this effort makes.
bool is_of(Effort effort, std::string_view claim) {
    return claim.starts_with(quick_mark) == (effort == Effort::quick);
}

}  // namespace

void mark_as_quick(std::vector<Check>& checks) {
    for (Check& check : checks) check.claim.insert(0, quick_mark);
}

bool agree(std::string_view recorded, std::string_view found, double tolerance) {
    while (!recorded.empty() && !found.empty()) {
        const auto a = take_number(recorded), b = take_number(found);
        if (a.has_value() != b.has_value()) return false;
        if (a && !near(*a, *b, tolerance)) return false;
        if (a) continue;
        if (recorded.front() != found.front()) return false;
        recorded.remove_prefix(1);
        found.remove_prefix(1);
    }
    return recorded.empty() && found.empty();
}

const Record& Record::kept() {
    static const Record record = parse(std::string{spectral::embedded_text(recorded_files(), "recorded")},
                                       "validation/report/data/recorded.json");
    return record;
}

Record Record::parse(const std::string& text, std::string file) {
    Record record;
    for (const auto& entry : spectral::JsonValue::parse(text, std::move(file))["results"].items()) {
        entry.require_keys_among({"section", "claim", "verdict", "measured", "tolerance"});
        const std::string verdict = entry["verdict"].text();
        if (verdict != spectral::verdict(true) && verdict != spectral::verdict(false))
            throw entry["verdict"].error(spectral::in_quotes(verdict) + ": must be met or missed");
        const double tolerance = entry["tolerance"].number();
        if (!(tolerance >= 0)) throw entry["tolerance"].error("must be >= 0");
        record.entries_.push_back({entry["section"].text(),
                                   {entry["claim"].text(), entry["measured"].text(),
                                    verdict == spectral::verdict(true), "", tolerance}});
    }
    return record;
}

const Record::Entry* Record::find(std::string_view section, std::string_view claim) const {
    const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
        return entry.section == section && entry.result.claim == claim;
    });
    return found == entries_.end() ? nullptr : &*found;
}

std::vector<std::string> Record::contradictions(const std::vector<Section>& sections, Effort effort) const {
    std::vector<std::string> lines;
    for (const Section& section : sections) {
        const auto add = [&](const Check& check, const std::string& what) {
            lines.push_back(section.stem + ": " + check.claim + ": " + what);
        };
        for (const Check& check : section.checks) {
            const Entry* entry = find(section.stem, check.claim);
            if (entry == nullptr) {
                add(check, check.measured + ", of which nothing is recorded");
            } else if (const Check& known = entry->result;
                       known.passed != check.passed ||
                       !agree(known.measured, check.measured, known.tolerance)) {
                add(check, std::string{check.verdict()} + " with " + check.measured + ", recorded " +
                               known.verdict() + " with " + known.measured);
            }
        }
        for (const Entry& entry : entries_) {
            if (entry.section != section.stem || !is_of(effort, entry.result.claim)) continue;
            if (std::ranges::find(section.checks, entry.result.claim, &Check::claim) == section.checks.end())
                add(entry.result, "recorded, and not computed");
        }
    }
    return lines;
}

Record Record::with(const std::vector<Section>& sections, Effort effort) const {
    Record fresh;
    const auto section_of = [&](std::string_view stem) {
        return std::ranges::find(sections, stem, &Section::stem);
    };
    for (const Entry& entry : entries_) {
        const auto section = section_of(entry.section);
        const bool replaced =
            section != sections.end() &&
            (is_of(effort, entry.result.claim) ||
             std::ranges::find(section->checks, entry.result.claim, &Check::claim) != section->checks.end());
        if (!replaced) fresh.entries_.push_back(entry);
    }
    for (const Section& section : sections) {
        for (Check check : section.checks) {
            check.remark.clear();
            fresh.entries_.push_back({section.stem, std::move(check)});
        }
    }
    std::ranges::stable_sort(fresh.entries_, {}, &Entry::section);
    return fresh;
}

std::string Record::text() const {
    nlohmann::ordered_json json{
        {"about",
         "What hts validate is known to find. Rewritten by hts validate --record, with and without --quick; "
         "tolerance is the relative change of the numbers that is still the same result."}};
    json["results"] = nlohmann::ordered_json::array();
    for (const Entry& entry : entries_) {
        json["results"].push_back({{"section", entry.section},
                                   {"claim", entry.result.claim},
                                   {"verdict", entry.result.verdict()},
                                   {"measured", entry.result.measured},
                                   {"tolerance", entry.result.tolerance}});
    }
    return json.dump(1) + "\n";
}

}  // namespace hts::validation
