/// Locks on the folders in which a run writes its files, and those that killed processes left. Not installed.
#pragma once

#include <string>

namespace hts::spectral {

/// A lock on a folder, which lasts until it is closed or the process ends; -1 where another process has
/// one, or the folder is gone.
///   surely   -1 also where the medium knows no locks
[[nodiscard]] int locked(const std::string& folder, bool surely);

/// Removes the folders .hts-XXXXXX in a folder that nobody has locked.
void remove_abandoned(const std::string& folder);

}  // namespace hts::spectral
