/// A folder where the tables of correlations outlive the process, so that the next one need not make them.
///
///     hts::keep_correlation_tables_in(hts::user_cache_folder());
///
/// A library keeps none unless it is asked to; the command `hts` and the Python package keep them in the
/// user's folder. A table is written under another name first, so that it is there whole or not at all; it is
/// read only if its shape, the way it was computed, its size and its checksum are right, and made anew
/// otherwise. A folder that cannot be read or written is no error: then tables are made each time.
#pragma once

#include <cstddef>
#include <filesystem>

namespace hts {

/// More tables than these are not kept: those that were not read for longest go.
inline constexpr std::size_t most_kept_tables = 32;  // of 3.5 MB each

/// From now on, in this process.
///   folder   made where it is missing; empty: nowhere
void keep_correlation_tables_in(const std::filesystem::path& folder);

/// What the environment says: HTS_CACHE, a folder or "off"; else hts in XDG_CACHE_HOME; else .cache/hts in
/// HOME.
/// Empty for "off", and where there is none of them.
[[nodiscard]] std::filesystem::path user_cache_folder();

}  // namespace hts
