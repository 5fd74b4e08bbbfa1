/// The curve set that an argument names, and the instrument that options know better.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
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

/// --source-solid-angle and --detector-solid-angle, in place of what a set states.
struct InstrumentOptions {
    std::optional<double> source, detector;

    void add_to(CLI::App& verb) {
        verb.add_option("--source-solid-angle", source, "in place of the set's [sr]");
        verb.add_option("--detector-solid-angle", detector, "in place of the set's [sr]");
    }
    /// UsageError that names the options for what is not 0 ... 2 pi sr.
    [[nodiscard]] validation::CurveSet of(validation::CurveSet set) const {
        if (source) set.source_solid_angle = source;
        if (detector) set.detector_solid_angle = detector;
        if (!source && !detector) return set;
        return from_option("--source-solid-angle, --detector-solid-angle",
                           [&] { return validation::checked(std::move(set), "curves"); });
    }
};

}  // namespace hts::cli
