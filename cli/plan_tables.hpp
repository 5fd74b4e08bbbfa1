/// `hts plan --tables`: lookup tables as rungs of a plan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spectral/plan.hpp"

namespace hts::cli {

/// Builds a table for each material at the wavelengths of its choice, and puts it in the choice's place where it is quicker as
/// measured, within the tolerance as measured, and within the memory budget. Tables that are taken are written into `folder`
/// as "NAME.htst".
///   result   for each material what came out, with times and errors: "not taken: …"
[[nodiscard]] std::vector<std::string> try_tables(spectral::Plan& plan, const std::filesystem::path& folder);

}  // namespace hts::cli
