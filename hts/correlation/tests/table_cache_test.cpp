#include "hts/correlation/table_cache.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "temporary_folder.hpp"

namespace hts::correlation_detail {
namespace {

/// Opens once. Waits long, so that a test fails in place of hanging.
class Gate {
  public:
    void open() {
        const std::lock_guard lock{mutex_};
        open_ = true;
        changed_.notify_all();
    }
    [[nodiscard]] bool wait() {
        std::unique_lock lock{mutex_};
        return changed_.wait_for(lock, std::chrono::minutes{10}, [this] { return open_; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = false;
};

/// A shape that says when its table is begun, and waits until it may go on.
class WatchedShape final : public HeightShape {
  public:
    explicit WatchedShape(double nu) : shape_{matern_shape(nu)} {}

    [[nodiscard]] double log_spectrum(double q) const override { return shape_->log_spectrum(q); }
    [[nodiscard]] Heights heights(const LogGrid& grid) const override {
        ++tables;
        begun.open();
        if (!may_go_on.wait()) stuck = true;
        return shape_->heights(grid);
    }
    [[nodiscard]] std::string name() const override { return shape_->name(); }
    [[nodiscard]] std::vector<double> identity() const override { return shape_->identity(); }

    mutable Gate begun, may_go_on;
    mutable std::atomic<int> tables = 0;
    mutable std::atomic<bool> stuck = false;

  private:
    ShapePointer shape_;
};

}  // namespace

TEST_CASE("Correlation tables: while one is made others are found and made, and the same one is made once") {
    TableCache cache;
    const auto slow = std::make_shared<const WatchedShape>(0.7);
    const auto other = matern_shape(0.8), third = matern_shape(0.9);
    const auto there = cache.of(other);
    TableCache::Table first, second, late_one;
    std::thread making{[&] { first = cache.of(slow); }};
    CHECK(slow->begun.wait());
    std::thread waiting{[&] { second = cache.of(slow); }};
    CHECK(cache.of(other) == there);
    CHECK(cache.of(third) == cache.of(third));
    // more than are kept, but what is being made is not forgotten
    for (int k = 0; k < 16; ++k) static_cast<void>(cache.of(matern_shape(1 + 0.1 * k)));
    std::thread late{[&] { late_one = cache.of(slow); }};
    slow->may_go_on.open();
    making.join();
    waiting.join();
    late.join();
    CHECK_FALSE(slow->stuck);
    CHECK(slow->tables == 1);
    CHECK(first != nullptr);
    CHECK(second == first);
    CHECK(late_one == first);
}

TEST_CASE("Correlation tables: one that is not to be kept is left nowhere, and takes what is there") {
    const testing::TemporaryFolder place;
    TableCache cache;
    cache.keep_in(place.path());
    const auto shape = matern_shape(0.8), passing = matern_shape(0.9);
    const auto kept = cache.of(shape);
    CHECK(place.size() == 1);
    CHECK(cache.of(shape, Keep::no) == kept);
    CHECK(cache.of(passing, Keep::no) != cache.of(passing, Keep::no));
    for (int k = 0; k < 16; ++k) static_cast<void>(cache.of(matern_shape(1 + 0.1 * k), Keep::no));
    CHECK(place.size() == 1);
    CHECK(cache.of(shape) == kept);
}

}  // namespace hts::correlation_detail
