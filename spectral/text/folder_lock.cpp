#include "spectral/text/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace hts::spectral {

namespace fs = std::filesystem;

int locked(const std::string& folder, bool surely) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return -1;
    struct stat mine {};
    struct stat named {};
    const bool holds = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || (!surely && errno != EWOULDBLOCK);
    if (holds && ::fstat(descriptor, &mine) == 0 && ::stat(folder.c_str(), &named) == 0 &&
        mine.st_ino == named.st_ino)
        return descriptor;
    ::close(descriptor);
    return -1;
}

void remove_abandoned(const std::string& folder) {
    std::error_code ignored;
    for (fs::directory_iterator entry{folder, ignored}, end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name.size() != 11 || !name.starts_with(".hts-") || !entry->is_directory(ignored)) continue;
        const int lock = locked(entry->path().string(), true);
        if (lock < 0) continue;
        std::error_code failure;
        fs::remove_all(entry->path(), failure);
        ::close(lock);
    }
}

}  // namespace hts::spectral
