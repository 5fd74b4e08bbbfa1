/// Damaged and hostile files by the million: whatever a file holds, reading it gives a named error or
/// something sound, and takes little memory. HTS_EXHAUSTIVE=1 tries the large numbers, for a build with
/// sanitizers: cmake --preset sanitize.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hts/sampling/random.hpp"

namespace hts::tables::testing {

/// In a reader of a damaged file: that what was read is as it must be.
void require_sound(bool sound);

/// What the calling thread may ask of operator new while it lives, in all; beyond it std::bad_alloc.
class MemoryBudget {
  public:
    explicit MemoryBudget(std::size_t bytes);
    ~MemoryBudget();
    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

    [[nodiscard]] bool exceeded() const noexcept;
};

/// A file, and how it is damaged and read.
struct DamagedFile {
    std::string name;
    std::string good;
    std::size_t head;                ///< three changes of four fall into the first so many bytes
    std::vector<std::string> nasty;  ///< what may take the place of its bytes
    /// Must throw hts::Error or find it sound.
    std::function<void(const std::string& bytes)> read;
    /// Applied to what was damaged, for instance new checksums.
    std::function<std::string(std::string bytes, Random& random)> mended = {};
    std::size_t quick = 1000, exhaustive = 200'000;  ///< cases
};

/// One to three changes: bytes changed, bits turned, cut out, doubled, replaced by something
/// nasty, or the end cut off.
[[nodiscard]] std::string damaged(const DamagedFile& file, Random& random);

/// Damages the file so many times and reads each; every case has its own seed, and one that fails is kept as
/// a file. At least one case must be refused, and one be read.
void check_damaged(const DamagedFile& file);

}  // namespace hts::tables::testing
