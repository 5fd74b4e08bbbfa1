#include "hts/correlation/table_cache.hpp"

#include "hts/correlation/table_file.hpp"

namespace hts::correlation_detail {

TableCache::Table TableCache::of(const ShapePointer& shape, Keep keep) {
    const std::vector<double> identity = shape->identity();
    auto entry = std::make_shared<Entry>();
    {
        const std::lock_guard lock{mutex_};
        if (const auto found = entries_.find(identity); found != entries_.end()) {
            entry = found->second;
        } else if (keep == Keep::yes) {
            // what is being made now is held by those who wait for it
            if (entries_.size() >= most)
                std::erase_if(entries_, [](const auto& each) { return each.second.use_count() == 1; });
            entry->folder = folder_;
            entries_.emplace(identity, entry);
        }
    }
    std::call_once(entry->once, [&] { entry->table = kept_table(entry->folder, shape); });
    return entry->table;
}

void TableCache::keep_in(const std::filesystem::path& folder) {
    const std::lock_guard lock{mutex_};
    folder_ = folder;
}

}  // namespace hts::correlation_detail
