#include "validation/report/prose.hpp"

#include "spectral/text/text.hpp"

namespace hts::validation {

std::string prose(std::string_view stem) {
    std::string text;
    for (const std::string_view line : spectral::split(spectral::embedded_text(prose_files(), stem), '\n')) {
        if (line.empty()) {
            text += "\n\n";
        } else {
            text.append(text.empty() || text.back() == '\n' ? "" : " ").append(line);
        }
    }
    return std::string{spectral::trimmed(text)};
}

}  // namespace hts::validation
