/// Files of refractiveindex.info as the database has them. Tests that need them have the tag [.database] and
/// are run where they are.
#pragma once

#include <filesystem>

namespace hts::testing {

/// Folder nk/ of the shared data: in CMake's variable HTS_SHARED_DATA, beside the
/// project's folder unless told.
inline std::filesystem::path database_folder() {
    return std::filesystem::path{HTS_SHARED_DATA} / "nk";
}

}  // namespace hts::testing
