// Tables of scattering integrals that a process has made lately. Not installed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "hts/correlation/lobe_table.hpp"

namespace hts::correlation_detail {

/// Whether a table is left where the next that asks for the same numbers finds it.
enum class Keep { yes, no };

/// Tables by the numbers of their shapes. Any thread may ask; one makes a table, those that want the same one
/// wait for it, and those that want another one do not.
class TableCache {
  public:
    using Table = std::shared_ptr<const LobeTable>;

    /// What is here, or else is read from the folder or made.
    ///   keep   no: what is not here is made, and left neither here nor in the folder
    [[nodiscard]] Table of(const ShapePointer& shape, Keep keep = Keep::yes);
    /// From now on.
    ///   folder   empty: nowhere
    void keep_in(const std::filesystem::path& folder);

  private:
    struct Entry {
        std::once_flag once;
        Table table;
        std::filesystem::path folder;  // where it is kept; empty: nowhere
    };
    static constexpr std::size_t most = 16;
    std::mutex mutex_;  // nothing is made while it is held
    std::filesystem::path folder_;
    std::map<std::vector<double>, std::shared_ptr<Entry>> entries_;
};

}  // namespace hts::correlation_detail
