/// The curve sets of validation/curves/data/, which come with the program.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/text/embedded_file.hpp"
#include "validation/curves/curve.hpp"

namespace hts::validation {

/// Names, sorted: "mwir-brass", …
[[nodiscard]] std::vector<std::string> built_in_curve_names();

/// One of them; hts::Error that lists the names otherwise.
[[nodiscard]] CurveSet built_in_curves(std::string_view name);

/// One of them, or the file of that path, which wins.
[[nodiscard]] CurveSet curves_named(const std::string& name_or_path);

/// Defined in a source that embed.cmake writes.
[[nodiscard]] std::span<const spectral::EmbeddedFile> embedded_curves() noexcept;

}  // namespace hts::validation
