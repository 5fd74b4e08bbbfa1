/// What a validation is known to find, kept as data in validation/report/data/. A criterion that the model
/// misses is a finding. A result other than the recorded one is a regression of the program, whether the
/// criterion is met or missed.
///
///     for (const std::string& line : Record::kept().contradictions(sections, Effort::quick))
///         std::cerr << line << '\n';
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "validation/report/report.hpp"

namespace hts::validation {

/// Whether two texts are the same but for their numbers, and those agree to a relative tolerance; numbers
/// below 1e-9 are rounding and agree.
[[nodiscard]] bool agree(std::string_view recorded, std::string_view found, double tolerance);

class Record {
  public:
    /// The one that comes with the program.
    [[nodiscard]] static const Record& kept();
    /// hts::Error "file: …" for what is no record.
    [[nodiscard]] static Record parse(const std::string& text, std::string file);

    /// A line for each check whose verdict or numbers are not those recorded, that is not recorded, or that
    /// is recorded and was not made: "SECTION: CLAIM: 0.31, recorded 0.27". Of the sections given only.
    ///   effort   of the computation: what is recorded of the other one is not missed
    [[nodiscard]] std::vector<std::string> contradictions(const std::vector<Section>& sections,
                                                          Effort effort) const;

    /// This record with the checks of the sections in place of those recorded of the same effort.
    [[nodiscard]] Record with(const std::vector<Section>& sections, Effort effort) const;

    /// JSON, as `parse` reads it.
    [[nodiscard]] std::string text() const;

  private:
    struct Entry {
        std::string section;  ///< its stem
        Check result;         ///< without remark
    };
    [[nodiscard]] const Entry* find(std::string_view section, std::string_view claim) const;

    std::vector<Entry> entries_;  // sections together
};

}  // namespace hts::validation
