/// `hts plan --tables`: lookup tables as rungs of a plan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spectral/plans/plan.hpp"
#include "spectral/text/output.hpp"

namespace hts::tables {

/// What came of the tables of a plan.
struct TriedTables {
    std::vector<std::string> verdicts;      ///< for each material, with times and errors: "not taken: …"
    std::vector<spectral::TextFile> files;  ///< those that were taken, to be written together with the plan
};

/// Builds a table for each material at the wavelengths of its choice, and puts it in the choice's place where
/// it is quicker as measured, within the tolerance as measured, and within the memory budget.
///   plan_file   beside which the tables are to stand, as "<its stem>-<number>-<material>.htst"
[[nodiscard]] TriedTables try_tables(spectral::Plan& plan, const std::filesystem::path& plan_file);

}  // namespace hts::tables
