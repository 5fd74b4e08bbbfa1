/// The curve set that an argument names.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "cli/io/usage.hpp"
#include "validation/curves/built_in_curves.hpp"

namespace hts::cli {

/// A file, or a set that comes with the program; UsageError that lists those if it is a bare word and
/// neither.
[[nodiscard]] inline validation::CurveSet curves_from_argument(const std::string& argument) {
    std::error_code ignored;
    if (argument.find_first_of("./") != std::string::npos || std::filesystem::exists(argument, ignored))
        return validation::curves_named(argument);
    return from_option("curves", [&] { return validation::built_in_curves(argument); });
}

}  // namespace hts::cli
