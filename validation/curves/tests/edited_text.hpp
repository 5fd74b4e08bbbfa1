/// Texts of files with one part changed.
#pragma once

#include <string>

namespace hts::validation::testing {

/// `text` with the first `part` replaced; the part must be there.
inline std::string with(std::string text, const std::string& part, const std::string& instead) {
    return text.replace(text.find(part), part.size(), instead);
}

}  // namespace hts::validation::testing
