#include "bench/charts/chart_timing.hpp"

#include <array>

#include "spectral/processor_time.hpp"
#include "spectral/statistics.hpp"

namespace hts::bench {
namespace {

constexpr std::size_t passes = 7;

/// Walks through the inputs, from the start again at their end.
class Walk {
  public:
    Walk(const ChartMethod& method, const PhiInputs& inputs)
        : method_{method}, inputs_{inputs}, result_(inputs.size()) {}

    /// Seconds for the next `count` values.
    double seconds(std::size_t count) {
        if (next_ + count > inputs_.size()) next_ = 0;
        const auto g = std::span{inputs_.g}.subspan(next_, count);
        const auto t = std::span{inputs_.t}.subspan(next_, count);
        const double start = spectral::thread_seconds();
        method_.values(g, t, std::span{result_}.first(count));
        const double stop = spectral::thread_seconds();
        next_ += count;
        return stop - start;
    }

  private:
    const ChartMethod& method_;
    const PhiInputs& inputs_;
    std::vector<double> result_;
    std::size_t next_ = 0;
};

}  // namespace

double nanoseconds(const ChartMethod& method, const PhiInputs& inputs, double seconds) {
    Walk walk{method, inputs};
    const double share = seconds / (passes + 2);
    std::size_t count = 1;
    double taken = walk.seconds(count);
    while (taken < share / 2 && 2 * count <= inputs.size()) taken = walk.seconds(count *= 2);
    if (taken > seconds) return taken * 1e9 / static_cast<double>(count);
    std::array<double, passes> times{};
    for (double& time : times) time = walk.seconds(count);
    return spectral::median({times.begin(), times.end()}) * 1e9 / static_cast<double>(count);
}

}  // namespace hts::bench
