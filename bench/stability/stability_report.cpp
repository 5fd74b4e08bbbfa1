#include "bench/stability/stability_report.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "bench/stability/stability_row.hpp"
#include "hts/error.hpp"
#include "spectral/output/html.hpp"
#include "spectral/text/csv.hpp"

namespace hts::bench {
namespace {

using output::html_escaped;
using output::html_foot;
using output::html_head;
using spectral::csv_field;

/// The verdict in words; those of a model's failure and of plain errors say more than the verdict's name.
std::string spoken(const StabilityResult& result) {
    return result.verdict == Verdict::ok && !result.engine ? "ok, " + result.detail : result.detail;
}

std::string padded(std::string text, std::size_t width) {
    if (text.size() > width) text = text.substr(0, width - 3) + "...";
    return text.append(width - text.size() + 2, ' ');
}

std::string summary(const std::vector<StabilityResult>& results) {
    const auto rivals =
        std::count_if(results.begin(), results.end(), [](const auto& r) { return !r.engine; });
    return "engine: " + std::string{engine_passes(results) ? "passes every row" : "FAILS"} +
           "; naive methods: " + std::to_string(rival_failures(results)) + " of " + std::to_string(rivals) +
           " fail";
}

/// "5 of 30 cases fail"; a single case needs no count.
std::string tally(const StabilityResult& r) {
    return std::to_string(r.failures) + " of " + std::to_string(r.cases) + " cases fail";
}

const char* css_class(const StabilityResult& result) {
    if (result.verdict == Verdict::model) return "model";
    return is_failure(result.verdict) ? "bad" : "good";
}

void write_html_row(std::ostream& out, const StabilityResult& r) {
    out << "<tr" << (r.engine ? " class=\"engine\"" : "") << "><td>" << html_escaped(r.method)
        << "</td><td class=\"" << css_class(r) << "\">" << name(r.verdict)
        << (is_failure(r.verdict) ? "" : " &#10003;") << "<br><span class=\"soft\">" << html_escaped(r.detail)
        << "</span></td><td>" << html_escaped(r.where) << "<br><span class=\"soft\">" << tally(r)
        << (r.bound > 0 ? ", bound " + brief(r.bound) : std::string{}) << "</span></td><td>"
        << html_escaped(r.why) << "</td></tr>\n";
}

}  // namespace

void write_stability_text(std::ostream& out, const std::vector<StabilityResult>& results) {
    int row = 0;
    for (const StabilityResult& r : results) {
        if (r.row != row) out << (row > 0 ? "\n" : "") << r.row << "  " << r.problem << '\n';
        row = r.row;
        out << (r.engine ? "  * " : "    ") << padded(r.method, 50) << padded(name(r.verdict), 14)
            << padded(spoken(r), 46) << padded(std::to_string(r.failures) + "/" + std::to_string(r.cases), 5)
            << r.where << '\n';
    }
    out << "\n* engine; each line: worst case of the method, cases failed/tried, inputs of the worst\n"
        << summary(results) << '\n';
}

void write_stability_csv(std::ostream& out, const std::vector<StabilityResult>& results) {
    out << "row,problem,method,engine,verdict,error,bound,cases,failures,detail,where,why\n";
    for (const StabilityResult& r : results) {
        out << r.row << ',' << csv_field(r.problem) << ',' << csv_field(r.method) << ',' << (r.engine ? 1 : 0)
            << ',' << name(r.verdict) << ',' << shortest(r.error) << ',' << shortest(r.bound) << ','
            << r.cases << ',' << r.failures << ',' << csv_field(r.detail) << ',' << csv_field(r.where) << ','
            << csv_field(r.why) << '\n';
    }
}

void write_stability_html(std::ostream& out, const std::vector<StabilityResult>& results) {
    out << html_head("Stability of the He-Torrance model",
                     "Where methods for the He-Torrance model fail, and what the engine does instead",
                     "stability")
        << "<p>" << html_escaped(summary(results))
        << ". Each line is the worst case of its method, against 80 digits or an exact limit.</p>\n";
    int row = 0;
    for (const StabilityResult& r : results) {
        if (r.row != row) {
            out << (row > 0 ? "</table>\n" : "") << "<h2>" << r.row << ". " << html_escaped(r.problem)
                << "</h2>\n<table><tr><th>method</th><th>verdict</th><th>where</th><th>why</th></tr>\n";
        }
        row = r.row;
        write_html_row(out, r);
    }
    out << (row > 0 ? "</table>\n" : "") << html_foot;
}

}  // namespace hts::bench
