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

}  // namespace hts::cli
