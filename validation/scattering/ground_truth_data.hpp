/// The files of validation/scattering/data/ as they are embedded in the library. Private to `ground_truth`.
#pragma once

#include <span>
#include <string_view>

namespace hts::validation {

struct KeptFile {
    std::string_view stem;
    std::string_view text;
};

/// Defined in a source that spectral/embed_data.cmake writes.
[[nodiscard]] std::span<const KeptFile> kept_files() noexcept;

}  // namespace hts::validation
