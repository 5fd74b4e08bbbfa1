#include "tables/table/table_probes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hts/error.hpp"
#include "spectral/parallel.hpp"
#include "spectral/statistics.hpp"
#include "tables/table/build_table.hpp"

namespace hts::tables {
namespace {

const double lowest_cosine = std::cos(steepest_theta);
constexpr int whole_degrees = 88;
constexpr double degree = std::numbers::pi / 180;

}  // namespace

std::vector<DirectionPair> RandomPairs::next(std::size_t count) {
    std::vector<DirectionPair> pairs;
    pairs.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        pairs.push_back(about_lobe_ ? lobe_pair() : uniform_pair());
        about_lobe_ = !about_lobe_;
    }
    return pairs;
}

DirectionPair RandomPairs::uniform_pair() {
    const Direction in = random_.direction(lowest_cosine);
    return {in, random_.direction(lowest_cosine)};
}

DirectionPair RandomPairs::lobe_pair() {
    for (;;) {
        const Direction in = Direction::from_angles(steepest_theta * random_.uniform(), 0);
        const double slope = std::pow(10, -2.5 + 3 * random_.uniform());
        const double azimuth = 2 * std::numbers::pi * random_.uniform();
        const double up = 1 / std::sqrt(1 + slope * slope);
        const Vector3 half{up * slope * std::cos(azimuth), up * slope * std::sin(azimuth), up};
        const Vector3 out = 2 * dot(in.vector(), half) * half - in.vector();
        if (out.z >= lowest_cosine) return {in, Direction::from_vector(out)};
    }
}

LobePeaks::LobePeaks(const spectral::Reflectance& exact)
    : wavelengths_{exact.wavelengths().size()}, peaks_((whole_degrees + 1) * wavelengths_) {
    spectral::parallel_for(whole_degrees + 1, [&](std::size_t i) {
        const Direction in = Direction::from_degrees(static_cast<double>(i), 0);
        std::vector<double> values(wavelengths_);
        double* const peaks = peaks_.data() + i * wavelengths_;
        for (int half = -2 * whole_degrees; half <= 2 * whole_degrees; ++half) {
            exact.directional_diffuse({in, Direction::from_degrees(std::abs(half) / 2.0, half < 0 ? 0 : 180)},
                                      values);
            for (std::size_t w = 0; w < wavelengths_; ++w) peaks[w] = std::max(peaks[w], values[w]);
        }
    });
}

double LobePeaks::operator()(const Direction& in, std::size_t wavelength) const noexcept {
    const double degrees = std::atan2(in.sin_theta(), in.cos_theta()) / degree;
    const int below = std::min(static_cast<int>(degrees), whole_degrees - 1);
    const double share = degrees - below;
    const double* const peaks = peaks_.data() + static_cast<std::size_t>(below) * wavelengths_ + wavelength;
    return (1 - share) * peaks[0] + share * peaks[wavelengths_];
}

double LobePeaks::least(std::size_t wavelength) const noexcept {
    double least = peaks_[wavelength];
    for (std::size_t i = wavelength; i < peaks_.size(); i += wavelengths_) least = std::min(least, peaks_[i]);
    return least;
}

double error_scale(double exact, double peak) noexcept {
    constexpr double nothing = 1e-30;  // where there is no lobe at all
    return exact + 1e-3 * peak + nothing;
}

namespace {

/// Errors of one pair at all wavelengths.
class PairErrors {
  public:
    PairErrors(const spectral::Reflectance& table, const spectral::Reflectance& exact, const LobePeaks& peaks)
        : table_{table},
          exact_{exact},
          peaks_{peaks},
          lobe_(exact.wavelengths().size()),
          tabulated_(lobe_.size()),
          matrices_(table.properties().polarised ? lobe_.size() : 0),
          tabulated_matrices_(matrices_.size()) {}

    void write(const DirectionPair& pair, float* errors) {
        exact_.directional_diffuse(pair, lobe_);
        table_.directional_diffuse(pair, tabulated_);
        if (!matrices_.empty()) {
            exact_.mueller(pair, matrices_);
            table_.mueller(pair, tabulated_matrices_);
        }
        for (std::size_t w = 0; w < lobe_.size(); ++w) {
            double difference = std::abs(tabulated_[w] - lobe_[w]);
            if (!matrices_.empty()) difference = std::max(difference, largest_difference(w));
            errors[w] = static_cast<float>(difference / error_scale(lobe_[w], peaks_(pair.in, w)));
        }
    }

  private:
    [[nodiscard]] double largest_difference(std::size_t w) const {
        double largest = 0;
        for (std::size_t i = 0; i < 16; ++i) {
            largest = std::max(largest,
                               std::abs(matrices_[w].elements()[i] - tabulated_matrices_[w].elements()[i]));
        }
        return largest;
    }

    const spectral::Reflectance& table_;
    const spectral::Reflectance& exact_;
    const LobePeaks& peaks_;
    std::vector<double> lobe_, tabulated_;
    std::vector<Mueller> matrices_, tabulated_matrices_;
};

}  // namespace

TableError table_error(const spectral::Reflectance& table, const spectral::Reflectance& exact,
                       std::uint64_t pairs, std::uint64_t seed) {
    const auto a = table.wavelengths().micrometres(), b = exact.wavelengths().micrometres();
    if (!std::ranges::equal(a, b))
        throw Error{"the table and the exact model must have the same wavelengths"};
    const LobePeaks peaks{exact};
    RandomPairs random{seed};
    const std::vector<DirectionPair> all = random.next(pairs);
    const std::size_t width = a.size();
    std::vector<float> errors(all.size() * width);
    spectral::parallel_blocks(all.size(), 256, [&](std::size_t first, std::size_t count) {
        PairErrors of_pair{table, exact, peaks};
        for (std::size_t i = first; i < first + count; ++i) of_pair.write(all[i], errors.data() + i * width);
    });
    TableError result{0, 0, 0, pairs, seed};
    if (!errors.empty()) result.largest = static_cast<double>(*std::ranges::max_element(errors));
    result.percentile_99 = static_cast<double>(spectral::quantile(errors, 0.99));
    result.median = static_cast<double>(spectral::quantile(std::move(errors), 0.5));
    return result;
}

}  // namespace hts::tables
