/// What the studies of the ground truth share: tables that are kept as data, and the data kept.
///
/// `hts truth STUDY --output validation/scattering/data` writes them anew; they are embedded in this library,
/// so that a quick report can show the full result beside the few cases it computes itself.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "validation/report/report.hpp"

namespace hts::validation {

/// A table as CSV, numbers to five significant digits, provenance as comments in front.
///   provenance   lines
[[nodiscard]] std::string table_csv(const FigureTable& table, const std::string& provenance);

/// A table that is kept, "moment-method-map"; hts::Error if there is none of the name.
[[nodiscard]] FigureTable kept_table(std::string_view stem);
/// The comments in front of it: how, when and with what command it was computed.
[[nodiscard]] std::string kept_provenance(std::string_view stem);

/// Everything a study gives: tables to keep and the section of a report.
struct GroundTruth {
    std::string provenance;
    std::vector<FigureTable> tables;
    Section section;
};

/// "\nhts truth moments --quick --output FOLDER": the last line of a provenance.
[[nodiscard]] std::string regenerating(const std::string& study, Effort effort);

/// Adds checks and figures made of a study's tables.
using AddResults = void (*)(Section& section, const std::vector<FigureTable>& tables,
                            const std::string& provenance);

/// What a study found, with its checks and figures.
///   empty   the section without results
[[nodiscard]] GroundTruth ground_truth(std::string provenance, std::vector<FigureTable> tables, Section empty,
                                       AddResults add_results);

/// The section of a study as computed now; of a quick one the checks are said to be of few realisations, and
/// the full result that is kept stands beside, with its own checks and in the figures' place.
[[nodiscard]] Section section_of(GroundTruth computed, Effort effort, AddResults add_results);

/// Position of a column; it must be there.
[[nodiscard]] std::size_t column_of(const FigureTable& table, std::string_view name);

/// Values of a column, each once, as they come.
[[nodiscard]] std::vector<double> different(const FigureTable& table, std::size_t column);

/// Digits for a reader: "0.43".
[[nodiscard]] std::string rounded(double value, int digits);

}  // namespace hts::validation
