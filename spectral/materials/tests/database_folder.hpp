/// Files of refractiveindex.info as the database has them, which a test may use if they are there.
#pragma once

#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

namespace hts::testing {

/// Folder nk/ of the shared data: in HTS_SHARED_DATA, else beside the project's folder.
inline std::filesystem::path database_folder() {
    const char* shared = std::getenv("HTS_SHARED_DATA");
    return std::filesystem::path{shared ? shared : HTS_SOURCE_DIR "/../shared/data"} / "nk";
}

/// Says so if the folder is not there.
inline bool database_is_here() {
    const bool here = std::filesystem::is_directory(database_folder());
    if (!here) WARN("skipped: no folder " << database_folder() << " (set HTS_SHARED_DATA)");
    return here;
}

}  // namespace hts::testing
