/// Runs the built command `hts` as a user would and keeps what it says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace hts::cli::testing {

struct Result {
    int exit_code;
    std::string output;  ///< standard output
    std::string errors;  ///< standard error
};

/// A folder of its own for one test, gone at its end; commands run inside it.
class Workplace {
  public:
    Workplace();

    /// `hts ARGUMENTS`, by a shell, so that < and quotes work; `environment` stands in front
    /// ("OMP_NUM_THREADS=1").
    [[nodiscard]] Result hts(const std::string& arguments, const std::string& environment = "") const;
    /// Writes a file and returns its name.
    std::string file(const std::string& name, const std::string& text) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    /// Where the commands run.
    [[nodiscard]] std::filesystem::path folder() const { return folder_ / "work"; }
    /// Names of the files and folders in it, sorted.
    [[nodiscard]] std::vector<std::string> names() const;

  private:
    hts::testing::TemporaryFolder folder_;
};

/// Checks this exit code, and nothing but one line on standard error, which holds every one of `parts`.
void check_complaint(const Result& result, int exit_code, const std::vector<std::string>& parts);

/// Cells of a CSV text, the header first.
[[nodiscard]] std::vector<std::vector<std::string>> cells(const std::string& csv);

}  // namespace hts::cli::testing
