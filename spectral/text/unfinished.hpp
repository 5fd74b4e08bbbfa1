/// What remove_partial_files (spectral/text/output.hpp) ends and removes. Not installed.
#pragma once

#include <sys/types.h>

#include <string>

namespace hts::spectral {

/// A path that remove_partial_files removes for as long as this lives; nothing else is done to it.
class Unfinished {
  public:
    enum class Kind { file, folder };
    Unfinished(const std::string& path, Kind kind) noexcept;
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

  private:
    int slot_;  // -1 if the path is too long or all slots are taken
};

/// A program that is run beside this one; remove_partial_files ends it first, so that it writes no more.
/// 0 for none.
void set_helper_process(pid_t process) noexcept;

}  // namespace hts::spectral
