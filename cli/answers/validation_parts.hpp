/// What `hts validate` does, part by part.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/report/report.hpp"

namespace hts::cli {

struct ValidationPart {
    std::string name;  ///< as --only takes it
    ///   curves   folder of curve sets that the user brings
    std::vector<validation::Section> (*make)(validation::Effort effort, const std::filesystem::path& curves);
};

/// In the order of the report.
[[nodiscard]] const std::vector<ValidationPart>& validation_parts();

/// Says every result that is not the recorded one on standard error, and throws CheckFailed if there is one.
void require_as_recorded(const std::vector<std::string>& contradictions, const std::string& verb);

}  // namespace hts::cli
